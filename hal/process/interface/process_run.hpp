#pragma once

#include <array>

#include "hal/driver/byte_ring.hpp"
#include "hal/process/interface/process.hpp"
#include "hal/process/interface/process_host.hpp"
#include "hal/process/interface/process_lines.hpp"
#include "types/process_restart.hpp"

namespace flexrf {

struct ProcessSettings {
  bool start = true;
  ProcessRestart restart = ProcessRestart::never;
  Duration restart_shortest{};
  Duration restart_longest{};
  Duration start_timeout{};
  Duration stop_timeout{};
};

/// A program's life: when it is started, asked to end, killed and started again, and what it is fed and
/// prints. begin, stop: lifecycle thread. All else: the device's thread.
class ProcessRun {
 public:
  /// Starts it, if that is set, and waits until its own code begins. `name`: the device's; both outlive this.
  Status begin(const char* name, ProcessHost& host, const ProcessSettings& settings);
  /// Returns when the program has ended, or cannot be ended [process-run-1].
  void stop() noexcept;

  void receive(Time now) noexcept;
  void send(Time now) noexcept;

  const ProcessState& state() const noexcept { return state_; }
  void request_start() noexcept { wanted_ = true; }
  void request_stop() noexcept { wanted_ = false; }
  bool write(std::string_view bytes, bool as_line) noexcept;
  void close_input() noexcept { input_ends_ = true; }
  bool read_line(ProcessLine& line) noexcept { return lines_.take(line); }
  void fill(ProcessFeedback& feedback) const noexcept;
  /// No program can be started any more, for the reason that trouble() gives.
  bool is_lost() const noexcept { return lost_; }
  std::string_view trouble() const noexcept { return text_view(trouble_); }

 private:
  bool is_alive() const noexcept;
  void enter(ProcessPhase phase, Time now) noexcept;
  void start(Time now) noexcept;
  void take_events(Time now) noexcept;
  void take_end(const ProcessEvent& event, Time now) noexcept;
  bool drain(Time now) noexcept;
  void finish_run(Time now) noexcept;
  void watch_time(Time now) noexcept;
  void feed() noexcept;
  [[gnu::format(printf, 2, 3)]] void note_trouble(const char* format, ...) noexcept;

  const char* name_ = "";
  ProcessHost* host_ = nullptr;
  ProcessSettings settings_;
  ProcessState state_;
  ProcessLines lines_;
  std::array<char, Process::input_capacity> input_memory_{};
  ByteRing input_;
  bool wanted_ = false;      // it should run
  bool lost_ = false;        // nothing can be started any more
  bool ended_ = false;       // the run has, and its last lines are still to be read
  bool killed_ = false;      // in this run
  bool input_ends_ = false;  // after what is in input_
  bool input_closed_ = false;
  std::array<bool, 2> source_ended_{};
  Time ended_at_{};
  Time began_at_{};
  Time restart_at_{};
  Duration pause_{};
  std::uint64_t kills_ = 0;
  std::uint64_t refused_writes_ = 0;
  std::array<char, sizeof(ProcessFeedback::trouble)> trouble_{};
};

}  // namespace flexrf
