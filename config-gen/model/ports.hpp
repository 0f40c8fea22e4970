// The ports of whoever has some, in one shape: of a unit, of a device by its interface, of a device by a
// driver.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

// Refers to the model; valid while nothing is added to it.
struct PortSet {
  const std::string& name;      // of the unit or device
  const Position& row;          // likewise
  std::optional<Index> thread;  // in which they are read and written
  const std::vector<InputPort>& inputs;
  const std::vector<OutputPort>& outputs;
  const std::vector<InputConnection>& from;  // per input
  const std::vector<OutputConnection>& to;   // per output
};
PortSet ports_of(const Model& model, const PortOwner& owner);

std::vector<InputConnection>& inputs_of(Model& model, const PortOwner& owner);  // not of an interface
std::vector<OutputConnection>& outputs_of(Model& model, const PortOwner& owner);

// Of a device: its interface, then its drivers in the order of its row.
std::vector<PortOwner> owners_in_device(const Model& model, Index device);
// All, in table order: devices, then units.
std::vector<PortOwner> port_owners(const Model& model);
// Those whose ports are used in this thread: of its units in step order, then of its devices.
std::vector<PortOwner> owners_in_thread(const Model& model, const Thread& thread);

// "unit 'jog'", "device 'keyboard'", "driver 'simulated' of device 'arm'"
std::string describe(const Model& model, const PortOwner& owner);

// All that write this slot. Several are drivers of one device.
std::vector<Writer> writers_of(const Model& model, Index slot);

// The readers of a queue that take items at the same time, each with those that stand in for it: one driver
// of a device is chosen.
std::vector<std::vector<InputReference>> readers_at_work(const Queue& queue);

}  // namespace flexrf::config_gen
