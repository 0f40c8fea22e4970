// The simulated module as a node of a CAN bus, with its plug.
#pragma once

#include "hal/can/interface/can_node.hpp"
#include "hal/canopen/can_message.hpp"
#include "hal/gpio/chip/canopen/simulator/simulated_cia401_module.hpp"

namespace flexrf {

class ModuleOnCan final : public CanNode {
 public:
  /// Its supply is on from `now` on.
  ModuleOnCan(const SimulatedCia401Module::Options& options, Time now) : module_{options}, now_{now} {
    module_.power_on(now);
  }

  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    if (!plugged_ || frame.extended) return;
    module_.receive(canopen::to_message(frame), frame.time, said_);
    say(port);
  }
  Time next_event() const noexcept override { return now_ + step; }
  void on_time(Time now, CanPort& port) noexcept override {
    now_ = now;
    module_.advance(now, said_);
    say(port);
  }

  // ---- for tests, between the bus's cycles; what is said by it goes out with the next step

  SimulatedCia401Module& module() { return module_; }
  void power_on() { module_.power_on(now_); }
  void reset_itself() { module_.reset_itself(now_); }
  void trip(std::uint16_t error_code) { module_.trip(error_code, said_); }
  /// One input, from 0; the others stay as they are.
  void drive(unsigned input, bool high) {
    const std::uint64_t bit = std::uint64_t{1} << input;
    module_.drive(high ? module_.inputs() | bit : module_.inputs() & ~bit, now_, said_);
  }
  bool sees_high(unsigned output) const { return (module_.outputs() >> output & 1U) != 0; }
  /// Its cable: out, it hears nobody and nobody hears it; what it says meanwhile is lost.
  void set_plugged(bool on) { plugged_ = on; }
  /// Any message, as if it had said it.
  void say_instead(const canopen::Message& message) { said_.push(message); }

 private:
  static constexpr Duration step = std::chrono::milliseconds(1);

  void say(CanPort& port) noexcept {
    for (; !said_.is_empty(); said_.pop()) {
      if (plugged_ && !port.send(canopen::to_frame(said_.front()))) return;  // later
    }
  }

  SimulatedCia401Module module_;
  canopen::Outbox said_;
  bool plugged_ = true;
  Time now_;
};

}  // namespace flexrf
