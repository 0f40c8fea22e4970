// A simulated drive that is told by lines of text what shall go wrong: for tests, and for people at a
// terminal.
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "hal/can/interface/can_node.hpp"
#include "hal/servo_drive/canopen/simulator/simulated_cia402_drive.hpp"

namespace flexrf {

/// The drive with its plug: what goes over it can be cut off, delayed, and mixed with garbage. For one thread
/// that is not real-time.
class DriveConsole final : public CanNode {
 public:
  /// Its supply is on from `now` on.
  DriveConsole(const SimulatedCia402Drive::Options& options, Time now);

  /// Does what the line says (see `help`); "ok", what was asked for, or what is wrong with the line.
  std::string obey(std::string_view line);
  /// A line for each command.
  static const char* const help;

  std::uint8_t node() const { return node_; }
  SimulatedCia402Drive& drive() { return drive_; }

  void on_frame(const CanFrame& frame, CanPort& port) noexcept override;
  Time next_event() const noexcept override { return now_ + step; }
  void on_time(Time now, CanPort& port) noexcept override;

 private:
  static constexpr Duration step = std::chrono::milliseconds(1);

  struct Waiting {
    Time due{};
    CanFrame frame{};
  };

  std::string change(std::string_view word, std::string_view rest);
  std::string change_object(std::string_view word, std::string_view rest);
  std::string describe() const;
  void talk_garbage();
  void say(std::uint32_t identifier, std::string_view data, bool extended = false, bool remote = false);
  void collect();
  void flush(CanPort& port);

  std::uint8_t node_;
  SimulatedCia402Drive drive_;
  canopen::Outbox said_;
  std::deque<Waiting> waiting_;  // on its way to the plug
  Duration delay_{};
  bool plugged_ = true;
  Time now_;
};

}  // namespace flexrf
