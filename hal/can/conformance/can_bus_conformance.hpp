// What every driver of CanBus must do. A driver's test makes a world, which is the driver and another node at
// the far end of its wire, and runs the cases in it.
#pragma once

#include <memory>
#include <optional>

#include "hal/can/interface/can_bus.hpp"

namespace flexrf {

class CanBusWorld {
 public:
  virtual ~CanBusWorld() = default;

  /// Initialised and usable.
  virtual CanBus& bus() = 0;
  /// The thread's cycle: receive, then what the devices do, then send. About a millisecond lies between two.
  virtual void receive() = 0;
  virtual void send() = 0;
  /// The clock of the cycles, after all that has happened: virtual, or one that counts.
  virtual Time now() const = 0;

  /// The far end says this, as soon as the wire lets it.
  virtual void say(const CanFrame& frame) = 0;
  /// The oldest frame that the far end heard and nobody took.
  virtual std::optional<CanFrame> hear() = 0;

  // What can be made to happen to the driver's end, and undone. False: not with this driver.
  virtual bool set_down() { return false; }
  virtual bool set_up() { return false; }
  virtual bool take_away() { return false; }
  virtual bool put_back() { return false; }
  /// It comes back on the bus by itself, or by end_bus_off().
  virtual bool cause_bus_off() { return false; }
  virtual void end_bus_off() {}
  virtual bool cause_error_passive() { return false; }
};

using MakeCanBusWorld = std::unique_ptr<CanBusWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_can_bus_conformance(const char* driver, MakeCanBusWorld make);

}  // namespace flexrf
