// InProcessCanBus: a simulated CAN bus; the application is one node on its wire, simulated devices the
// others.
#pragma once

#include "hal/can/in_process/can_wire.hpp"
#include "hal/can/interface/can_bus.hpp"
#include "hal/can/interface/can_node.hpp"
#include "in_process_can_bus_driver.hpp"

namespace flexrf {

/// A simulated device attaches its node to `bus->wire()` in initialise() and detaches it in stop(). What its
/// nodes do happens while the bus receives and sends, in the bus's thread.
class InProcessCanBus final : public InProcessCanBusDriver {
 public:
  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;
  void send(const Tick& tick) noexcept override;
  Time next_event() const noexcept override { return wire_.next_event(); }

  CanWire* wire() noexcept override { return &wire_; }

  // ---- faults: the bus's thread, or a test between cycles

  /// Of the application's own end: its plug and its transmissions. After initialise().
  CanStation& station() noexcept { return *station_; }
  /// As if the interface were set down, or were gone; and, with error_active, back again.
  void pretend(CanBusState state) noexcept;

 private:
  /// The application's end of the wire.
  struct End final : CanNode {
    explicit End(InProcessCanBus& owner) : bus(&owner) {}
    void on_frame(const CanFrame& frame, CanPort& port) noexcept override;
    Time next_event() const noexcept override { return Time::max(); }
    void on_time(Time /*now*/, CanPort& /*port*/) noexcept override {}
    InProcessCanBus* bus;
  };

  bool advance(Time now) noexcept;
  void tell_state() noexcept;

  End end_{*this};
  CanWire wire_;
  CanStation* station_ = nullptr;
  CanBusState pretended_ = CanBusState::error_active;
};

}  // namespace flexrf
