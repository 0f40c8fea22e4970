#include "config-gen/model/ports.hpp"

#include <algorithm>

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {

PortSet ports_of(const Model& model, const PortOwner& owner) {
  if (owner.kind == PortOwner::Kind::unit) {
    const Unit& unit = model.units[owner.component];
    const UnitType& type = model.unit_types[unit.type];
    return {unit.name, unit.position, unit.thread, type.inputs, type.outputs, unit.inputs, unit.outputs};
  }
  const Device& device = model.devices[owner.component];
  if (owner.kind == PortOwner::Kind::driver) {
    const DriverChoice& choice = device.drivers[owner.choice];
    const Driver& driver = model.drivers[choice.driver];
    return {device.name,    device.position, device.thread, driver.inputs,
            driver.outputs, choice.inputs,   choice.outputs};
  }
  // An interface reads nothing.
  static const std::vector<InputPort> no_inputs;
  static const std::vector<InputConnection> from_nowhere;
  return {device.name,  device.position, device.thread, no_inputs, model.interfaces[device.interface].outputs,
          from_nowhere, device.outputs};
}

std::vector<InputConnection>& inputs_of(Model& model, const PortOwner& owner) {
  return owner.kind == PortOwner::Kind::unit ? model.units[owner.component].inputs
                                             : model.devices[owner.component].drivers[owner.choice].inputs;
}

std::vector<OutputConnection>& outputs_of(Model& model, const PortOwner& owner) {
  switch (owner.kind) {
    case PortOwner::Kind::unit:
      return model.units[owner.component].outputs;
    case PortOwner::Kind::driver:
      return model.devices[owner.component].drivers[owner.choice].outputs;
    case PortOwner::Kind::device:
      break;
  }
  return model.devices[owner.component].outputs;
}

std::vector<PortOwner> owners_in_device(const Model& model, Index device) {
  std::vector<PortOwner> owners{{PortOwner::Kind::device, device, 0}};
  for (Index choice = 0; choice < model.devices[device].drivers.size(); ++choice)
    owners.push_back({PortOwner::Kind::driver, device, choice});
  return owners;
}

std::vector<PortOwner> port_owners(const Model& model) {
  std::vector<PortOwner> owners;
  for (Index device = 0; device < model.devices.size(); ++device)
    for (const PortOwner& owner : owners_in_device(model, device)) owners.push_back(owner);
  for (Index unit = 0; unit < model.units.size(); ++unit) owners.push_back({PortOwner::Kind::unit, unit, 0});
  return owners;
}

std::vector<PortOwner> owners_in_thread(const Model& model, const Thread& thread) {
  std::vector<PortOwner> owners;
  for (const Index unit : thread.units) owners.push_back({PortOwner::Kind::unit, unit, 0});
  for (const Index device : thread.devices)
    for (const PortOwner& owner : owners_in_device(model, device)) owners.push_back(owner);
  return owners;
}

std::string describe(const Model& model, const PortOwner& owner) {
  if (owner.kind == PortOwner::Kind::unit) return "unit " + quote(model.units[owner.component].name);
  const Device& device = model.devices[owner.component];
  const std::string name = "device " + quote(device.name);
  if (owner.kind == PortOwner::Kind::device) return name;
  return "driver " + quote(model.drivers[device.drivers[owner.choice].driver].name) + " of " + name;
}

std::vector<Writer> writers_of(const Model& model, Index slot) {
  const Writer& first = model.slots[slot].writer;
  std::vector<Writer> writers{first};
  if (first.kind != Writer::Kind::output || first.owner.kind != PortOwner::Kind::driver) return writers;
  for (const PortOwner& owner : owners_in_device(model, first.owner.component)) {
    if (!owner.excludes(first.owner)) continue;
    const std::vector<OutputConnection>& to = ports_of(model, owner).to;
    for (Index port = 0; port < to.size(); ++port)
      if (to[port].slot == slot) writers.push_back({Writer::Kind::output, owner, port, to[port].position});
  }
  return writers;
}

std::vector<std::vector<InputReference>> readers_at_work(const Queue& queue) {
  std::vector<std::vector<InputReference>> groups;
  for (const InputReference& reader : queue.readers) {
    const auto stands_in = [&reader](const std::vector<InputReference>& group) {
      return std::all_of(group.begin(), group.end(), [&reader](const InputReference& other) {
        return reader.owner.excludes(other.owner);
      });
    };
    const auto group = std::find_if(groups.begin(), groups.end(), stands_in);
    if (group != groups.end())
      group->push_back(reader);
    else
      groups.push_back({reader});
  }
  return groups;
}

}  // namespace flexrf::config_gen
