// Slots and queues come to be by being named: by outputs first, then by inputs that hope for a writer.
#include <algorithm>

#include "config-gen/model/ports.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {
namespace {

// A connection as written: in the row itself, or by a port of the group around it.
struct Connection {
  std::string name;  // full; empty when what is written is wrong, and was reported
  Position position;
};

// What a row connects: the ports of a unit, of a population's members alike, of a device, of one of its
// drivers.
struct Connected {
  const FlatRow* row = nullptr;
  PortOwner owner;  // the first
  std::size_t count = 1;
  bool population = false;
  const Node* node = nullptr;  // with the sections `in` and `out`; null: none
  std::string key;             // of that node within the row: "", "simulated."
  std::string target;          // as the group's table calls it: "jog", "arm.simulated"
  std::string declared;        // by what: "the unit type 'jog'"

  PortOwner member(std::size_t number) const {
    PortOwner one = owner;
    one.component += number;
    return one;
  }
};

// All `in` or `out` connections by port, with unknown ports reported.
std::map<std::string, Connection> connections_of(Assembly& assembly, const Connected& connected, bool input,
                                                 const std::vector<std::string>& ports) {
  std::map<std::string, Connection> found;
  const Scope& scope = *connected.row->scope;
  const std::string kind = input ? "input" : "output";
  const auto known = [&](const std::string& port) {
    return std::find(ports.begin(), ports.end(), port) != ports.end();
  };
  // What was meant is taken as connected, and what it names as written and read: one mistake, one message.
  const auto wrong = [&](const std::string& port, const std::string& slot, const Position& position) {
    const std::string meant = known(port) ? port : nearest(port, ports);
    if (!meant.empty()) found.emplace(meant, Connection{"", position});
    assembly.broken_places.insert(array_base(slot));
  };
  const auto unknown = [&](const std::string& port, const std::string& slot, const Position& position) {
    wrong(port, slot, position);
    assembly.diagnostics.error(position, "unknown " + kind + " " + quote(port) + " of " + connected.declared,
                               suggest(port, ports, kind + "s", "it has none: remove this connection"));
  };
  // An interface reads nothing: that a device's row has no key `in` is said where the row is read.
  const bool is_key = !input || connected.owner.kind != PortOwner::Kind::device;
  const Node* section =
      is_key && connected.node != nullptr ? connected.node->find(input ? "in" : "out") : nullptr;
  if (section != nullptr) {
    for (const Node& child : section->children) {
      if (!known(child.key)) {
        unknown(child.key, scope.slot_name(child.text), child.key_position);
      } else if (child.broken) {
        wrong(child.key, "", child.position);
      } else if (child.kind != Node::Kind::text) {
        wrong(child.key, "", child.position);
        assembly.diagnostics.error(child.position,
                                   quote(connected.key + (input ? "in." : "out.") + child.key) +
                                       " must be the name of a slot or queue, not " + kind_text(child.kind),
                                   "write it in double quotes");
      } else if (!is_slot_name(child.text)) {
        wrong(child.key, scope.slot_name(child.text), child.position);
        assembly.diagnostics.error(
            child.position, quote(child.text) + " is not the name of a slot or queue",
            child.text.find('.') != std::string::npos
                ? "slots inside of a group are reached through its ports: expose it with [port.NAME]"
                : "names are lower_snake_case, and members of arrays are written \"tracks[3]\"");
      } else {
        found.emplace(child.key, Connection{scope.slot_name(child.text), child.position});
      }
    }
  }
  for (const PortBinding& binding : scope.bindings) {
    if (binding.input != input || binding.target != connected.target) continue;
    if (known(binding.port))
      found.emplace(binding.port, Connection{binding.slot, binding.position});
    else
      unknown(binding.port, binding.slot, binding.position);
  }
  return found;
}

template <typename Ports>
std::vector<std::string> names_of(const Ports& ports) {
  std::vector<std::string> names;
  for (const auto& port : ports) names.push_back(port.name);
  return names;
}

Index add_slot(Assembly& assembly, const std::string& name, Index type, const Position& position) {
  Slot slot;
  slot.name = name;
  slot.position = position;
  slot.type = {SlotType::Kind::declared, type};
  const Index index = assembly.model.slots.size();
  const std::string base = array_base(name);
  if (base != name) {
    const std::size_t member = std::stoul(name.substr(base.size() + 1));
    assembly.arrays[base].emplace_back(member, index);
  }
  slot.partial = assembly.broken_places.contains(base);
  assembly.slots.emplace(name, index);
  assembly.model.slots.push_back(std::move(slot));
  return index;
}

Index add_queue(Assembly& assembly, const std::string& name, Index type, const Position& position) {
  Queue queue;
  queue.name = queue.declared = name;
  queue.position = position;
  queue.type = type;
  queue.partial = assembly.broken_places.contains(name);
  assembly.queues[name] = {assembly.model.queues.size()};
  assembly.model.queues.push_back(std::move(queue));
  return assembly.model.queues.size() - 1;
}

// One output of one owner. A slot's second writer is kept in the connection and judged later.
void connect_output(Assembly& assembly, const OutputPort& port, const Connection& to, Writer writer,
                    OutputConnection& connection, const std::string& owner) {
  Model& model = assembly.model;
  connection.position = writer.position = to.position;
  if (to.name.empty()) return;
  if (to.name.find("][") != std::string::npos) {
    assembly.diagnostics.error(
        to.position, "output " + quote(port.name) + " of " + owner + " would be in an array of arrays",
        "a group with a count cannot expose an array: expose single slots, or remove the count");
    assembly.broken_places.insert(array_base(array_base(to.name)));
    return;
  }
  if (port.queue) {
    if (const auto slot = assembly.slots.find(to.name); slot != assembly.slots.end()) {
      assembly.diagnostics.error(
          to.position,
          "output " + quote(port.name) + " of " + owner + " is a queue, but " + quote(to.name) + " is a slot",
          "give the queue another name; the slot's writer is at " +
              to_string(model.slots[slot->second].position));
      return;
    }
    const auto known = assembly.queues.find(to.name);
    const Index queue = known != assembly.queues.end() ? known->second.front()
                                                       : add_queue(assembly, to.name, port.type, to.position);
    model.queues[queue].writers.push_back(writer);
    connection.queues = {queue};
    return;
  }
  if (const auto queue = assembly.queues.find(to.name); queue != assembly.queues.end()) {
    assembly.diagnostics.error(
        to.position,
        "output " + quote(port.name) + " of " + owner + " is a slot, but " + quote(to.name) + " is a queue",
        "give the slot another name; the queue is at " +
            to_string(model.queues[queue->second.front()].position));
    return;
  }
  const auto known = assembly.slots.find(to.name);
  if (known != assembly.slots.end()) {
    connection.slot = known->second;
    model.slots[known->second].loans = std::max(model.slots[known->second].loans, port.loans);
    return;
  }
  const Index slot = add_slot(assembly, to.name, port.type, to.position);
  model.slots[slot].writer = writer;
  model.slots[slot].loans = port.loans;
  connection.slot = slot;
}

void connect_outputs_of(Assembly& assembly, const Connected& connected) {
  Model& model = assembly.model;
  const std::vector<OutputPort>& ports = ports_of(model, connected.owner).outputs;
  const auto found = connections_of(assembly, connected, false, names_of(ports));
  for (std::size_t port = 0; port < ports.size(); ++port) {
    const OutputPort& output = ports[port];
    const auto to = found.find(output.name);
    if (to == found.end()) continue;
    const bool array = connected.population && !output.queue;
    if (array && array_base(to->second.name) != to->second.name) {
      assembly.diagnostics.error(to->second.position,
                                 "output " + quote(output.name) +
                                     " of a population cannot go to the single slot " +
                                     quote(to->second.name),
                                 "a population makes one slot for each member: write the name without an "
                                 "index, and do not expose it from a "
                                 "group with a count");
      assembly.broken_places.insert(array_base(to->second.name));
      for (std::size_t member = 0; member < connected.count; ++member)
        outputs_of(model, connected.member(member))[port].position = to->second.position;
      continue;
    }
    for (std::size_t member = 0; member < connected.count; ++member) {
      const PortOwner owner = connected.member(member);
      Connection one = to->second;
      if (array && !one.name.empty()) one.name += "[" + std::to_string(member) + "]";
      connect_output(assembly, output, one, Writer{Writer::Kind::output, owner, port, {}},
                     outputs_of(model, owner)[port], describe(model, owner));
    }
  }
}

// The slots that an input named: one, or an array's.
std::vector<Index> slots_of(Assembly& assembly, const InputPort& port, const Connection& from,
                            const std::string& owner) {
  const auto array = assembly.arrays.find(from.name);
  const auto slot = assembly.slots.find(from.name);
  if (port.range) {
    if (array != assembly.arrays.end()) {
      std::vector<std::pair<std::size_t, Index>> members = array->second;
      std::sort(members.begin(), members.end());
      std::vector<Index> slots;
      for (const auto& [member, index] : members) slots.push_back(index);
      return slots;
    }
    if (slot != assembly.slots.end()) {
      assembly.diagnostics.error(
          from.position,
          "input " + quote(port.name) + " of " + owner + " reads a range, but " + quote(from.name) +
              " is a single slot",
          "connect it to the output of a population or of a group with a count, or remove range = true at " +
              to_string(port.position));
      return {};
    }
  } else if (slot == assembly.slots.end() && array != assembly.arrays.end()) {
    assembly.diagnostics.error(from.position,
                               "input " + quote(port.name) + " of " + owner + " reads one slot, but " +
                                   quote(from.name) + " is an array of " +
                                   std::to_string(array->second.size()),
                               "choose a member, as " + quote(from.name + "[0]") +
                                   ", or set range = true at " + to_string(port.position));
    return {};
  }
  if (slot != assembly.slots.end()) return {slot->second};
  return {add_slot(assembly, from.name, port.type, from.position)};
}

void connect_input(Assembly& assembly, const PortOwner& of, Index port_index, const Connection& from) {
  Model& model = assembly.model;
  const InputPort& port = ports_of(model, of).inputs[port_index];
  const std::string owner = describe(model, of);
  InputConnection& connection = inputs_of(model, of)[port_index];
  connection.position = from.position;
  if (from.name.empty()) return;
  const InputReference reference{of, port_index, from.position};
  if (port.queue) {
    if (const auto slot = assembly.slots.find(from.name); slot != assembly.slots.end()) {
      assembly.diagnostics.error(from.position,
                                 "input " + quote(port.name) + " of " + owner +
                                     " takes the items of a queue, but " + quote(from.name) + " is a slot",
                                 "it is written at " + to_string(model.slots[slot->second].position) +
                                     "; connect a queue of " + model.types[port.type].name);
      return;
    }
    const auto known = assembly.queues.find(from.name);
    const Index queue = known != assembly.queues.end()
                            ? known->second.front()
                            : add_queue(assembly, from.name, port.type, from.position);
    model.queues[queue].readers.push_back(reference);
    connection.queue = queue;
    return;
  }
  if (const auto queue = assembly.queues.find(from.name); queue != assembly.queues.end()) {
    assembly.diagnostics.error(from.position,
                               "input " + quote(port.name) + " of " + owner + " reads a slot, but " +
                                   quote(from.name) + " is a queue",
                               "it is written at " + to_string(model.queues[queue->second.front()].position) +
                                   "; connect a slot of " + model.types[port.type].name);
    return;
  }
  connection.slots = slots_of(assembly, port, from, owner);
  for (const Index slot : connection.slots) model.slots[slot].inputs.push_back(reference);
}

void connect_inputs_of(Assembly& assembly, const Connected& connected) {
  const std::vector<InputPort>& ports = ports_of(assembly.model, connected.owner).inputs;
  const auto found = connections_of(assembly, connected, true, names_of(ports));
  for (std::size_t port = 0; port < ports.size(); ++port) {
    const auto from = found.find(ports[port].name);
    if (from == found.end()) continue;
    for (std::size_t member = 0; member < connected.count; ++member)
      connect_input(assembly, connected.member(member), port, from->second);
  }
}

std::vector<Connected> connected_by(const Model& model, const UnitRow& entry) {
  const UnitType& type = model.unit_types[model.units[entry.first].type];
  const Node& node = *entry.row->node;
  const PortOwner first{PortOwner::Kind::unit, entry.first, 0};
  return {Connected{entry.row, first, entry.count, entry.population, &node, "", node.key,
                    "the unit type " + quote(type.name)}};
}

std::vector<Connected> connected_by(const Model& model, const DeviceRow& entry) {
  const Node& node = *entry.row->node;
  const Device& device = model.devices[entry.device];
  std::vector<Connected> all;
  for (const PortOwner& owner : owners_in_device(model, entry.device)) {
    Connected one{entry.row, owner, 1, false, &node, "", node.key, ""};
    if (owner.kind == PortOwner::Kind::driver) {
      const std::string& name = model.drivers[device.drivers[owner.choice].driver].name;
      one.node = node.find(name);
      one.key = name + ".";
      one.target = node.key + "." + name;
      one.declared = "the driver " + quote(name);
    } else {
      one.declared = "the interface " + quote(model.interfaces[device.interface].class_name);
    }
    all.push_back(std::move(one));
  }
  return all;
}

// Devices and units in the order of their rows, whichever kind.
template <typename Act>
void for_each_connected(Assembly& assembly, const Act& act) {
  std::size_t device = 0, unit = 0;
  for (const FlatRow& row : assembly.flat.rows) {
    const InScope in_scope(assembly.diagnostics, *row.scope);
    std::vector<Connected> all;
    if (device < assembly.device_rows.size() && assembly.device_rows[device].row == &row)
      all = connected_by(assembly.model, assembly.device_rows[device++]);
    else if (unit < assembly.unit_rows.size() && assembly.unit_rows[unit].row == &row)
      all = connected_by(assembly.model, assembly.unit_rows[unit++]);
    for (const Connected& connected : all) act(connected);
  }
}

}  // namespace

void connect_outputs(Assembly& assembly) {
  for_each_connected(assembly, [&](const Connected& connected) { connect_outputs_of(assembly, connected); });
}

void connect_inputs(Assembly& assembly) {
  for_each_connected(assembly, [&](const Connected& connected) { connect_inputs_of(assembly, connected); });
}

}  // namespace flexrf::config_gen
