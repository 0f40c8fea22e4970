// Starting, stopping and initialising single components of a running application.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/executive/lifecycle.hpp"
#include "runtime/executive/reconfiguration.hpp"

namespace flexrf {

enum class ComponentAction : std::uint8_t {
  start,       ///< a component that does not run: with what it stands on (its devices, their buses)
  stop,        ///< with what stands on it (units that own it, devices that it carries), these first
  initialise,  ///< stop, and start again whatever ran: everything begins anew; after a fault, too
};
const char* name_of(ComponentAction action) noexcept;

/// All on the lifecycle thread. Whatever is started or initialised is inhibited until a person gives Start,
/// as is everything after a unit that owns an actuator, or an actuator, was stopped.
class ComponentActions {
 public:
  ComponentActions(Cell& cell, Lifecycle& lifecycle) noexcept
      : cell_(&cell), lifecycle_(&lifecycle), host_(cell, lifecycle) {}

  /// not_found: no such component. not_permitted: the application is not running, or it runs already. Others:
  /// what initialise() or stop() said; the component is then in fault.
  Status run(ComponentAction action, ComponentIndex component);

 private:
  Status start(ComponentIndex component);
  Status stop(ComponentIndex component);
  Status initialise(ComponentIndex component);
  Status stop_one(ComponentIndex component);
  Status start_one(ComponentIndex component);
  std::vector<ComponentIndex> stands_on(ComponentIndex component) const;
  Life life(ComponentIndex component) const noexcept {
    return cell_->application().component_state(component).life.load(std::memory_order_acquire);
  }

  Cell* cell_;
  Lifecycle* lifecycle_;
  Reconfiguration host_;
};

/// What may move now or is not yet at rest: devices that actuate and are not inhibited, or not yet safe after
/// a fault; and units that own an actuator and say that they are not idle. Any non-real-time thread.
std::vector<ComponentIndex> moving_components(const Cell& cell);

}  // namespace flexrf
