// NewInterface: something that is switched on and off.
#pragma once

#include "hal/driver/actuator.hpp"
#include "new_interface_interface.hpp"

namespace flexrf {

/// What a unit can ask of it, with any driver. In the thread of its owner; never waits.
class NewInterface : public Actuator<NewInterfaceInterface> {
 public:
  using Actuator::Actuator;

  /// Leaves with the end of the cycle. Without effect while is_inhibited(), and not remembered: it is off
  /// then.
  void command(bool on) noexcept {
    if (may_act()) set(on);
  }

 private:
  /// A command that is taken.
  virtual void set(bool on) noexcept = 0;
};

}  // namespace flexrf
