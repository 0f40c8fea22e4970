// Slots and queues come to be by being named: by outputs first, then by inputs that hope for a writer.
#include <algorithm>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {
namespace {

// A connection as written: in the row itself, or by a port of the group around it.
struct Connection {
  std::string name;  // full; empty when what is written is wrong, and was reported
  Position position;
};

// All `in` or `out` connections of a row by port, with unknown ports reported.
std::map<std::string, Connection> connections_of(Assembly& assembly, const FlatRow& flat, bool input,
                                                 const std::vector<std::string>& ports,
                                                 const std::string& owner) {
  std::map<std::string, Connection> found;
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
    assembly.diagnostics.error(position, "unknown " + kind + " " + quote(port) + " of " + owner,
                               suggest(port, ports, kind + "s", "it has none: remove this connection"));
  };
  if (const Node* section = flat.node->find(input ? "in" : "out"); section != nullptr) {
    for (const Node& child : section->children) {
      if (!known(child.key)) {
        unknown(child.key, flat.scope->slot_name(child.text), child.key_position);
      } else if (child.broken) {
        wrong(child.key, "", child.position);
      } else if (child.kind != Node::Kind::text) {
        wrong(child.key, "", child.position);
        assembly.diagnostics.error(child.position,
                                   quote((input ? "in." : "out.") + child.key) +
                                       " must be the name of a slot or queue, not " + kind_text(child.kind),
                                   "write it in double quotes");
      } else if (!is_slot_name(child.text)) {
        wrong(child.key, flat.scope->slot_name(child.text), child.position);
        assembly.diagnostics.error(
            child.position, quote(child.text) + " is not the name of a slot or queue",
            child.text.find('.') != std::string::npos
                ? "slots inside of a group are reached through its ports: expose it with [port.NAME]"
                : "names are lower_snake_case, and members of arrays are written \"tracks[3]\"");
      } else {
        found.emplace(child.key, Connection{flat.scope->slot_name(child.text), child.position});
      }
    }
  }
  for (const PortBinding& binding : flat.scope->bindings) {
    if (binding.input != input || binding.target != flat.node->key) continue;
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

// One output of one unit or device. A slot's second writer is kept in the connection and judged later.
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
    return;
  }
  const Index slot = add_slot(assembly, to.name, port.type, to.position);
  model.slots[slot].writer = writer;
  model.slots[slot].loans = port.loans;
  connection.slot = slot;
}

void connect_device_outputs(Assembly& assembly, const DeviceRow& entry) {
  Model& model = assembly.model;
  const Interface& interface = model.interfaces[model.devices[entry.device].interface];
  const std::string& name = model.devices[entry.device].name;
  model.devices[entry.device].outputs.resize(interface.outputs.size());
  const auto found = connections_of(assembly, *entry.row, false, names_of(interface.outputs),
                                    "the interface " + quote(interface.class_name));
  for (std::size_t port = 0; port < interface.outputs.size(); ++port) {
    const auto to = found.find(interface.outputs[port].name);
    if (to == found.end()) continue;
    connect_output(assembly, interface.outputs[port], to->second,
                   Writer{Writer::Kind::device_output, entry.device, port, {}},
                   model.devices[entry.device].outputs[port], "device " + quote(name));
  }
}

void connect_unit_outputs(Assembly& assembly, const UnitRow& entry) {
  Model& model = assembly.model;
  const UnitType& type = model.unit_types[model.units[entry.first].type];
  const auto found = connections_of(assembly, *entry.row, false, names_of(type.outputs),
                                    "the unit type " + quote(type.name));
  for (std::size_t port = 0; port < type.outputs.size(); ++port) {
    const OutputPort& output = type.outputs[port];
    const auto to = found.find(output.name);
    if (to == found.end()) continue;
    const bool array = entry.population && !output.queue;
    if (array && array_base(to->second.name) != to->second.name) {
      assembly.diagnostics.error(to->second.position,
                                 "output " + quote(output.name) +
                                     " of a population cannot go to the single slot " +
                                     quote(to->second.name),
                                 "a population makes one slot for each member: write the name without an "
                                 "index, and do not expose it from a "
                                 "group with a count");
      assembly.broken_places.insert(array_base(to->second.name));
      for (std::size_t member = 0; member < entry.count; ++member)
        model.units[entry.first + member].outputs[port].position = to->second.position;
      continue;
    }
    for (std::size_t member = 0; member < entry.count; ++member) {
      const Index unit = entry.first + member;
      Connection one = to->second;
      if (array && !one.name.empty()) one.name += "[" + std::to_string(member) + "]";
      connect_output(assembly, output, one, Writer{Writer::Kind::unit_output, unit, port, {}},
                     model.units[unit].outputs[port], "unit " + quote(model.units[unit].name));
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

void connect_input(Assembly& assembly, Index unit, Index port_index, const Connection& from) {
  Model& model = assembly.model;
  const InputPort& port = model.unit_types[model.units[unit].type].inputs[port_index];
  const std::string owner = "unit " + quote(model.units[unit].name);
  InputConnection& connection = model.units[unit].inputs[port_index];
  connection.position = from.position;
  if (from.name.empty()) return;
  const InputReference reference{unit, port_index, from.position};
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

// elements = 4147200, or [1920, 1080, 2], which is their product.
std::optional<std::size_t> read_elements(Row& row, Diagnostics& diagnostics) {
  const Node* const node = row.any("elements");
  if (node == nullptr) return std::nullopt;
  const auto is_count = [](const Node& one) {
    return one.kind == Node::Kind::integer && one.integer > 0 &&
           one.integer <= static_cast<std::int64_t>(most_elements);
  };
  std::size_t product = 1;
  bool good = is_count(*node);
  if (good) product = static_cast<std::size_t>(node->integer);
  if (node->kind == Node::Kind::array && !node->children.empty()) {
    good = std::all_of(node->children.begin(), node->children.end(), is_count);
    for (const Node& one : node->children)
      if (good) product = std::min(most_elements + 1, product * static_cast<std::size_t>(one.integer));
  }
  if (good && product <= most_elements) return product;
  diagnostics.error(node->position,
                    "'elements' of " + row.name() + " must be a whole number from 1 to " +
                        std::to_string(most_elements) + ", or a list of such that are multiplied",
                    "write elements = 4147200, or elements = [1920, 1080, 2]");
  return std::nullopt;
}

void set_elements(Assembly& assembly, Slot& slot, std::size_t elements, const Position& position) {
  const Field* const field = slot.type.kind == SlotType::Kind::declared
                                 ? assembly.model.types[slot.type.index].resizable()
                                 : nullptr;
  if (field == nullptr) {
    assembly.diagnostics.error(position,
                               "the items of slot " + quote(slot.name) + " all have one size: " +
                                   type_name(assembly.model, slot.type) + " has no field that is resizable",
                               "remove 'elements'; what is as large as its slot says is the last field of a "
                               "type, with resizable = true in the type's table");
    return;
  }
  Field resized = *field;
  resized.shape = {elements};
  lay_out(assembly.model, resized);
  if (resized.offset + resized.size > max_type_size) {
    assembly.diagnostics.error(position,
                               "an item of slot " + quote(slot.name) + " takes " +
                                   std::to_string(resized.offset + resized.size) + " bytes, more than " +
                                   std::to_string(max_type_size),
                               "make 'elements' smaller");
    return;
  }
  slot.elements = elements;
}

void read_slot_row(Assembly& assembly, const FlatRow& flat) {
  Row row(*flat.node, "[slot." + flat.node->key + "]", assembly.diagnostics);
  const auto observe = row.boolean("observe");
  const auto wall = row.boolean("wall");
  const auto history = row.integer("history", 1, 1 << 20);
  const auto elements = read_elements(row, assembly.diagnostics);
  const auto summary = row.sentence("summary");
  row.finish();
  const std::string name = flat.scope->slot_name(flat.node->key);
  std::vector<Index> found;
  if (const auto slot = assembly.slots.find(name); slot != assembly.slots.end())
    found.push_back(slot->second);
  if (const auto array = assembly.arrays.find(name); array != assembly.arrays.end())
    for (const auto& [member, slot] : array->second) found.push_back(slot);
  if (found.empty()) {
    if (assembly.broken_places.contains(name)) return;
    const bool queue = assembly.queues.contains(name);
    assembly.diagnostics.error(
        flat.node->key_position,
        queue ? quote(flat.node->key) + " is a queue, not a slot"
              : "unknown slot " + quote(flat.node->key) + ": no output writes it",
        queue ? "write [queue." + flat.node->key + "]"
              : suggest(flat.node->key, assembly.names_in(*flat.scope, assembly.slots), "slots",
                        "slots come to be by being named in out.PORT of a unit or device"));
    return;
  }
  for (const Index index : found) {
    Slot& slot = assembly.model.slots[index];
    slot.position = flat.node->key_position;
    slot.observe = observe.value_or(true);
    slot.for_panel = observe.value_or(false);
    slot.wall = wall.value_or(false);
    slot.history = static_cast<std::size_t>(history.value_or(0));
    slot.summary = summary.value_or("");
    if (elements) set_elements(assembly, slot, *elements, row.position("elements"));
  }
}

// order = "arrival", or { score = "field" }.
void read_order(Assembly& assembly, Row& row, Queue& queue) {
  const Node* order = row.any("order");
  if (order == nullptr || (order->kind == Node::Kind::text && order->text == "arrival")) return;
  const Node* score = order->kind == Node::Kind::table ? order->find("score") : nullptr;
  if (score == nullptr || score->kind != Node::Kind::text || order->children.size() != 1) {
    assembly.diagnostics.error(order->position,
                               "'order' of " + row.name() + " is neither \"arrival\" nor a score",
                               "write order = \"arrival\", or order = { score = \"FIELD\" }");
    return;
  }
  const Type& type = assembly.model.types[queue.type];
  std::vector<std::string> known;
  for (std::size_t i = 0; i < type.fields.size(); ++i) {
    const Field& field = type.fields[i];
    known.push_back(field.name);
    if (field.name != score->text) continue;
    const bool number = field.type.kind == FieldType::Kind::scalar && field.shape.empty() &&
                        (is_integer(field.type.scalar) || is_floating(field.type.scalar));
    if (!number)
      assembly.diagnostics.error(
          score->position,
          quote(score->text) + " of " + type.name + " is not a single number, so it cannot be a score",
          "choose a number; the field is at " + to_string(field.position));
    queue.score = i;
    return;
  }
  assembly.diagnostics.error(score->position, "unknown field " + quote(score->text) + " of " + type.name,
                             suggest(score->text, known, "fields", "it has none: remove 'order'"));
}

void read_queue_row(Assembly& assembly, const FlatRow& flat) {
  Row row(*flat.node, "[queue." + flat.node->key + "]", assembly.diagnostics);
  const std::string name = flat.scope->slot_name(flat.node->key);
  const auto found = assembly.queues.find(name);
  Queue unused;
  Queue& queue = found != assembly.queues.end() ? assembly.model.queues[found->second.front()] : unused;
  const auto capacity = row.integer("capacity", 1, 1 << 20);
  if (capacity) queue.capacity = static_cast<std::size_t>(*capacity);
  if (const auto policy = row.word("policy", {"drop_newest", "drop_oldest"}))
    queue.policy = static_cast<Queue::Policy>(*policy);
  const auto share = row.word("share", {"jobs", "copies"});
  queue.jobs = share == std::size_t{0};
  queue.wall = row.boolean("wall").value_or(false);
  queue.summary = row.sentence("summary").value_or("");
  if (found != assembly.queues.end())
    read_order(assembly, row, queue);
  else
    row.also("order");
  row.finish();
  if (found == assembly.queues.end()) {
    if (assembly.broken_places.contains(name)) return;
    const bool slot = assembly.slots.contains(name) || assembly.arrays.contains(name);
    assembly.diagnostics.error(
        flat.node->key_position,
        slot ? quote(flat.node->key) + " is a slot, not a queue"
             : "unknown queue " + quote(flat.node->key) + ": no output or input names it",
        slot ? "write [slot." + flat.node->key + "]"
             : suggest(flat.node->key, assembly.names_in(*flat.scope, assembly.queues), "queues",
                       "queues come to be by being named in out.PORT of a unit or device"));
    return;
  }
  queue.position = flat.node->key_position;
  if (share == std::size_t{1}) assembly.copied.insert(name);
}

}  // namespace

void connect_outputs(Assembly& assembly) {
  // Devices and units in the order of their rows, whichever kind.
  std::size_t device = 0, unit = 0;
  for (const FlatRow& row : assembly.flat.rows) {
    const InScope in_scope(assembly.diagnostics, *row.scope);
    if (device < assembly.device_rows.size() && assembly.device_rows[device].row == &row)
      connect_device_outputs(assembly, assembly.device_rows[device++]);
    else if (unit < assembly.unit_rows.size() && assembly.unit_rows[unit].row == &row)
      connect_unit_outputs(assembly, assembly.unit_rows[unit++]);
  }
}

void connect_inputs(Assembly& assembly) {
  for (const UnitRow& entry : assembly.unit_rows) {
    const InScope in_scope(assembly.diagnostics, *entry.row->scope);
    const UnitType& type = assembly.model.unit_types[assembly.model.units[entry.first].type];
    const auto found = connections_of(assembly, *entry.row, true, names_of(type.inputs),
                                      "the unit type " + quote(type.name));
    for (std::size_t port = 0; port < type.inputs.size(); ++port) {
      const auto from = found.find(type.inputs[port].name);
      if (from == found.end()) continue;
      for (std::size_t member = 0; member < entry.count; ++member)
        connect_input(assembly, entry.first + member, port, from->second);
    }
  }
}

void read_place_rows(Assembly& assembly) {
  for (const FlatRow& row : assembly.flat.rows) {
    const InScope in_scope(assembly.diagnostics, *row.scope);
    if (row.kind == FlatRow::Kind::slot) read_slot_row(assembly, row);
    if (row.kind == FlatRow::Kind::queue) read_queue_row(assembly, row);
  }
}

}  // namespace flexrf::config_gen
