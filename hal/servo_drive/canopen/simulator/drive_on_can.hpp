// The simulated drive as a node of a CAN bus.
#pragma once

#include "hal/can/interface/can_node.hpp"
#include "hal/canopen/can_message.hpp"
#include "hal/servo_drive/canopen/simulator/simulated_cia402_drive.hpp"

namespace flexrf {

class DriveOnCan final : public CanNode {
 public:
  /// Its supply is on from `now` on.
  DriveOnCan(const SimulatedCia402Drive::Options& options, Time now) : drive_{options}, now_{now} {
    drive_.power_on(now);
  }

  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    if (frame.extended) return;
    drive_.receive(canopen::to_message(frame), frame.time, said_);
    say(port);
  }
  Time next_event() const noexcept override { return now_ + step; }
  void on_time(Time now, CanPort& port) noexcept override {
    now_ = now;
    drive_.advance(now, said_);
    say(port);
  }

  /// For tests: between the bus's cycles.
  SimulatedCia402Drive& drive() { return drive_; }
  /// For tests: what a fault on purpose says goes out with the next step.
  canopen::Outbox& said() { return said_; }

 private:
  static constexpr Duration step = std::chrono::milliseconds(1);

  void say(CanPort& port) noexcept {
    for (; !said_.is_empty(); said_.pop()) {
      if (!port.send(canopen::to_frame(said_.front()))) return;  // later
    }
  }

  SimulatedCia402Drive drive_;
  canopen::Outbox said_;
  Time now_;
};

}  // namespace flexrf
