// Unit tables, and the ports that units, interfaces and drivers have in common.
#include <algorithm>

#include "config-gen/model/words.hpp"
#include "config-gen/read/library.hpp"
#include "config-gen/read/members.hpp"
#include "config-gen/read/needs.hpp"

namespace flexrf::config_gen {
namespace {

struct PortType {
  bool queue = false;
  std::optional<Index> type;
  Position position;
};

PortType read_port_type(Library& library, Row& row) {
  Diagnostics& diagnostics = library.diagnostics();
  PortType port;
  const auto type = row.text("type");
  const auto queue = row.text("queue");
  if (row.has("type") && row.has("queue")) {
    diagnostics.error(row.position("queue"), row.name() + " has both 'type' and 'queue'",
                      "'type' is for the latest item of a slot, 'queue' for the items of a queue: keep one");
    return port;
  }
  if (!row.has("type") && !row.has("queue")) {
    row.missing(
        "type",
        "add type = \"Pose\" for a slot's latest item, or queue = \"KeyEvent\" for the items of a queue");
    return port;
  }
  port.queue = row.has("queue");
  const auto& name = port.queue ? queue : type;
  port.position = row.position(port.queue ? "queue" : "type");
  if (!name) return port;
  if (!is_camel_case(*name)) {
    diagnostics.error(
        port.position,
        quote(*name) + " cannot be published: " + row.name() + " needs the name of a type table",
        "declare a type with this field in types/, and name it in CamelCase");
    return port;
  }
  port.type = library.type(*name, port.position);
  if (port.queue && port.type && library.model().types[*port.type].resizable() != nullptr) {
    diagnostics.error(port.position,
                      quote(*name) + " cannot be an item of a queue: it is as large as each slot says",
                      "publish it in a slot: type = \"" + *name + "\"");
    port.type.reset();
  }
  return port;
}

// Of a file in the table's folder or below it: it is written into an #include as it is.
bool is_header_name(std::string_view name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./").find(c) != std::string_view::npos;
  };
  return !name.empty() && name.front() != '/' && name.back() != '/' &&
         name.find("..") == std::string_view::npos && std::all_of(name.begin(), name.end(), is_plain);
}

std::optional<InputPort> read_input(Library& library, const Node& node) {
  Diagnostics& diagnostics = library.diagnostics();
  Row row(node, "[input." + node.key + "]", diagnostics);
  InputPort input;
  input.name = node.key;
  input.position = node.key_position;
  input.summary = row.summary();
  const PortType port = read_port_type(library, row);
  input.max_age = row.positive_duration("max_age", release_bounds);
  input.hold = row.boolean("hold").value_or(false);
  input.range = row.boolean("range").value_or(false);
  input.history = row.boolean("history").value_or(false);
  input.optional = row.boolean("optional").value_or(false);
  row.finish();
  if (port.queue)
    for (const char* key : {"max_age", "hold", "range", "history"})
      if (row.has(key))
        diagnostics.error(row.position(key),
                          quote(key) + " of " + row.name() + " is for slots, not for queues",
                          "remove it: an item of a queue is taken once, in order");
  if (!port.type) return std::nullopt;
  input.queue = port.queue;
  input.type = *port.type;
  input.type_position = port.position;
  return input;
}

}  // namespace

bool read_inputs(Library& library, const Node& table, std::vector<InputPort>& inputs) {
  const auto rows = named_rows(library, table, "input", "an input");
  for (const Node* node : rows)
    if (auto input = read_input(library, *node)) inputs.push_back(std::move(*input));
  return inputs.size() == rows.size();
}

bool read_outputs(Library& library, const Node& table, std::vector<OutputPort>& outputs) {
  for (const Node* node : named_rows(library, table, "output", "an output")) {
    Diagnostics& diagnostics = library.diagnostics();
    Row row(*node, "[output." + node->key + "]", diagnostics);
    OutputPort output;
    output.name = node->key;
    output.position = node->key_position;
    output.summary = row.summary();
    const PortType port = read_port_type(library, row);
    output.loans = static_cast<std::size_t>(row.integer("loans", 1, 62).value_or(1));
    if (port.queue && row.has("loans"))
      diagnostics.error(row.position("loans"), "'loans' of " + row.name() + " is for slots, not for queues",
                        "remove it");
    output.optional = row.boolean("optional").value_or(false);
    row.finish();
    if (!port.type) continue;
    output.queue = port.queue;
    output.type = *port.type;
    output.type_position = port.position;
    outputs.push_back(std::move(output));
  }
  const Node* rows = table.find("output");
  return rows == nullptr || outputs.size() == rows->children.size();
}

std::optional<Index> read_unit_table(Library& library, const Node& root, const std::filesystem::path& file) {
  Diagnostics& diagnostics = library.diagnostics();
  UnitType unit;
  unit.name = file.stem().string();
  unit.file = file;
  unit.space = library.space_of(file);
  unit.position = root.position;
  if (!is_snake_case(unit.name))
    diagnostics.error(root.position, "the file's name " + quote(unit.name) + " is not a name for a unit",
                      "name folder and file in lower_snake_case, as robot_control/robot_control.toml");
  Row row(root, "this unit table", diagnostics);
  unit.summary = row.summary();
  unit.class_name = row.text("class").value_or(camel_case(unit.name));
  check_class_name(unit.class_name, row.position("class"), camel_case(unit.name), diagnostics);
  const std::string header = row.text("header").value_or(unit.name + ".hpp");
  if (!is_header_name(header))
    diagnostics.error(row.position("header"), quote(header) + " is not the name of a header",
                      "write it as it lies in the table's folder, as " + quote(unit.name + ".hpp") +
                          ": letters, digits, '_', '-', '.' and '/'");
  else
    unit.header = library.include_path(file, header);
  unit.base_class = unit.class_name + "Unit";
  unit.base_header = unit.name + "_unit.hpp";
  if (const auto access = row.text("access")) {
    unit.cell_access = *access == "cell";
    if (!unit.cell_access)
      diagnostics.error(row.position("access"), "there is no access to " + quote(*access),
                        "write access = \"cell\": the unit may see all slots and parameters, and ask for "
                        "changes; without the key it has its ports alone");
  }
  for (const char* section : {"input", "output", "device", "configuration", "runtime", "feedback"})
    row.also(section);
  row.finish();

  bool complete = read_inputs(library, root, unit.inputs);
  complete = read_outputs(library, root, unit.outputs) && complete;
  for (const Node* node : named_rows(library, root, "device", "a device")) {
    Row device(*node, "[device." + node->key + "]", diagnostics);
    DevicePort port{node->key, node->key_position, 0, device.summary()};
    const auto interface =
        device.required_text("interface", "add interface = \"RobotArm\", the name of an interface");
    const auto index = interface ? library.interface(*interface, device.position("interface")) : std::nullopt;
    device.finish();
    complete = complete && index.has_value();
    if (!index) continue;
    port.interface = *index;
    unit.devices.push_back(std::move(port));
  }
  std::vector<std::pair<std::string, const Node*>> members;
  add_members(root, "input", "an input", members);
  add_members(root, "output", "an output", members);
  add_members(root, "device", "a device", members);
  check_members(Heir::unit, members, diagnostics);
  read_parameters(library, root, Parameter::Kind::configuration, unit.configuration);
  read_parameters(library, root, Parameter::Kind::runtime, unit.runtime);
  read_parameters(library, root, Parameter::Kind::feedback, unit.feedback);
  read_needs(library, root, unit.runtime, unit.feedback);
  read_needs_of_configuration(library, root, unit.configuration);
  if (!complete) return std::nullopt;  // connections to ports that are not there would be reported as unknown

  Model& model = library.model();
  model.unit_types.push_back(std::move(unit));
  return model.unit_types.size() - 1;
}

}  // namespace flexrf::config_gen
