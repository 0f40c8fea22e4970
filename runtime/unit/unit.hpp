// Unit: a processing unit. The executive decides when it runs; it never sleeps or waits inside step().
#pragma once

#include <span>

#include "runtime/unit/component.hpp"
#include "runtime/unit/tick.hpp"

namespace flexrf {

class CellAccess;
class Device;

/// How the generated application connects a unit, in the order of the unit's table.
struct UnitBinding : PortBinding {
  std::span<Device* const* const> devices;  ///< where the constructed driver is found
};

/// initialise, stop: the lifecycle thread, while the unit does not run. step, reset, is_idle, accept: its
/// thread.
class Unit : public Component {
 public:
  /// One step to completion: read inputs, compute, publish. No waiting, no allocation.
  virtual void step(const Tick& tick) = 0;
  /// Back to the state after initialise(), without allocating: members of a population are activated with it.
  virtual void reset() noexcept {}
  /// Nothing begun that should be completed before the application finishes or stops.
  virtual bool is_idle() const noexcept { return true; }

  // ---- for the executive; the generated base implements it

  virtual void connect(const UnitBinding& binding) noexcept = 0;
  /// Of a unit whose table says access = "cell"; null: of others.
  virtual CellAccess* cell_access() noexcept { return nullptr; }
};

}  // namespace flexrf
