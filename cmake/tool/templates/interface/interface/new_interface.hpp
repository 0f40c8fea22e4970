// NewInterface: something that is switched on and off.
#pragma once

#include "new_interface_interface.hpp"

namespace flexrf {

/// What a unit can ask of it, with any driver. In the thread of its owner; never waits.
class NewInterface : public NewInterfaceInterface {
 public:
  /// Leaves with the end of the cycle. Without effect while is_inhibited(), and not remembered: it is off
  /// then.
  virtual void command(bool on) noexcept = 0;
};

}  // namespace flexrf
