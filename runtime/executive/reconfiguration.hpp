// Reconfiguration: the executive's side of changing configuration parameters while the application runs.
#pragma once

#include "runtime/executive/cell.hpp"
#include "runtime/executive/lifecycle.hpp"
#include "runtime/parameters/configuration_file.hpp"
#include "runtime/parameters/reconfigure.hpp"

namespace flexrf {

/// Stops and initialises owners through the lifecycle. All on the lifecycle thread.
class Reconfiguration final : public ReconfigureHost {
 public:
  Reconfiguration(Cell& cell, Lifecycle& lifecycle) noexcept : cell_(&cell), lifecycle_(&lifecycle) {}

  Component* component(std::uint16_t index) override;
  bool is_initialised(std::uint16_t index) const override;
  /// The changed components; with a device also the unit that owns it, with a bus also what it carries. Units
  /// that own an actuator stop first, then other units, then devices, buses last.
  std::vector<std::uint16_t> owners_of(std::span<const std::uint16_t> changed) override;
  Status stop(std::uint16_t owner) override;
  Status initialise(std::uint16_t owner) override;
  void fault(std::uint16_t owner, const Status& cause) override;

 private:
  Cell* cell_;
  Lifecycle* lifecycle_;
};

/// What these changes gave counts as set from now on, and belongs into the configuration file. After they are
/// done, on the lifecycle thread.
void note_set(Cell& cell, std::span<const ConfigurationChange> changes);

/// All components of the cell, as the configuration file sees them, without their values. Any thread.
std::vector<ConfigurationComponent> configuration_components(Cell& cell);
ConfigurationIdentity configuration_identity(const Cell& cell);

}  // namespace flexrf
