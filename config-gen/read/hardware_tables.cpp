// Interface tables and driver tables.
#include "config-gen/model/source_text.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/library.hpp"
#include "config-gen/read/members.hpp"
#include "config-gen/read/needs.hpp"
#include "config-gen/read/object_list.hpp"
#include "config-gen/read/parts.hpp"
#include "config-gen/read/quantities.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::int64_t most_helper_threads = 8;

std::string read_class(Row& row, const std::string& stem, Diagnostics& diagnostics) {
  const std::string name = row.text("class").value_or(camel_case(stem));
  check_class_name(name, row.position("class"), camel_case(stem), diagnostics);
  return name;
}

// units.NAME = ["m", "rad"]: what each device's row chooses one of.
std::vector<UnitChoice> read_unit_choices(Row& row, Diagnostics& diagnostics) {
  std::vector<UnitChoice> choices;
  const Node* table = row.table("units");
  if (table == nullptr) return choices;
  Row names(*table, "'units' of " + row.name(), diagnostics);
  for (const Node& child : table->children) {
    UnitChoice choice;
    choice.name = child.key;
    choice.position = child.key_position;
    const Node* list = names.list_of_texts(child.key);
    if (!is_snake_case(choice.name) || judge_unit(choice.name, UnitUse::device).empty())
      diagnostics.error(
          child.key_position, quote(choice.name) + " is not a name for a choice of units",
          "write a word in small letters that is no unit itself, as units.axis = [\"m\", \"rad\"]");
    if (list == nullptr) continue;
    for (const Node& unit : list->children) {
      std::string advice = judge_unit(unit.text, UnitUse::si);
      if (advice.empty() && unit.text.find_first_of("*/^") != std::string::npos)
        advice = "write a single one, as \"m\"; what is made of it stands in the parameters' units";
      if (advice.empty()) {
        choice.units.push_back(unit.text);
        continue;
      }
      diagnostics.error(unit.position,
                        quote(unit.text) + " is not a unit that " + names.name() + " can offer", advice);
    }
    if (list->children.empty())
      diagnostics.error(list->position, quote("units." + choice.name) + " offers nothing to choose",
                        "name the units that a device's row may choose, as [\"m\", \"rad\"]");
    if (!choice.units.empty()) choices.push_back(std::move(choice));
  }
  names.finish();
  return choices;
}

Resource read_resource(const Node& node, Diagnostics& diagnostics) {
  Row row(node, "[resource." + node.key + "]", diagnostics);
  Resource resource;
  resource.name = node.key;
  resource.position = node.key_position;
  resource.summary = row.summary();
  row.required_text("from", "add from = \"urdf\": the device row's key, and what reads the file");
  const std::vector<std::string> readers = {"urdf", "register_map"};
  const std::size_t reader = row.word("from", readers).value_or(0);
  resource.reader = static_cast<Resource::Reader>(reader);
  resource.key = readers[reader];
  row.finish();
  return resource;
}

// objects = "FILE": what the driver asks of a device that is described by an EDS file.
void read_objects(Library& library, const std::string& name, const Position& position, Driver& driver) {
  const std::filesystem::path file = (driver.file.parent_path() / name).lexically_normal();
  if (!check_named_file(file, name, position, library.diagnostics())) return;
  library.model().files.push_back(file);
  std::vector<ListParameter> parameters;
  for (const ParameterBlock* block :
       {&library.model().interfaces[driver.interface].configuration, &driver.configuration}) {
    for (const Parameter& parameter : block->parameters) {
      parameters.push_back({parameter.field.name, {}});
      if (parameter.field.type.kind != FieldType::Kind::declared) continue;
      for (const EnumerationValue& value : library.model().types[parameter.field.type.declared].values)
        parameters.back().values.push_back(value.name);
    }
  }
  driver.takes_eds = true;
  driver.objects = read_object_list(file, parameters, library.diagnostics());
}

// A device is described by the same files whichever driver it has.
void refuse_resources(Row& row, const std::string& interface, Diagnostics& diagnostics) {
  if (!row.has("resource")) return;
  row.also("resource");
  diagnostics.error(row.position("resource"),
                    "a driver cannot have [resource.NAME]: only its interface has it",
                    "move it to the table of the interface " + interface +
                        ", so that every driver has it; a driver's own are [configuration.NAME], "
                        "[runtime.NAME], [feedback.NAME], [input.NAME] and [output.NAME]");
}

// Members of one class: those of the interface's base, and of the driver's.
void check_ports_beside(const Interface& face, const Driver& driver, const Node& root,
                        Diagnostics& diagnostics) {
  std::vector<std::pair<std::string, const Node*>> members;
  add_members(root, "input", "an input", members);
  add_members(root, "output", "an output", members);
  check_members(Heir::interface, members, diagnostics);
  const auto check = [&](const std::string& name, const Position& position) {
    const auto taken = [&](const std::string& other, const Position& place) {
      if (name == other)
        diagnostics.error(
            position,
            "the name " + quote(name) + " is used twice: every driver of " + face.class_name + " has it",
            "rename it; the other is at " + to_string(place));
    };
    for (const OutputPort& port : face.outputs) taken(port.name, port.position);
    for (const Resource& resource : face.resources) taken(resource.name, resource.position);
  };
  for (const InputPort& port : driver.inputs) check(port.name, port.position);
  for (const OutputPort& port : driver.outputs) check(port.name, port.position);
}

// A driver's own stand beside its interface's in one struct.
void check_beside(const ParameterBlock& common, const ParameterBlock& own, const std::string& interface,
                  Diagnostics& diagnostics) {
  for (const Parameter& parameter : own.parameters)
    for (const Parameter& other : common.parameters)
      if (parameter.field.name == other.field.name)
        diagnostics.error(parameter.field.position,
                          "the name " + quote(parameter.field.name) + " is used twice: every driver of " +
                              interface + " has it",
                          "rename it; the other is at " + to_string(other.field.position));
}

// The build reads these itself (read/parts.hpp), and only plain words.
void check_build_words(Row& row, std::string_view key, std::string_view meaning, Diagnostics& diagnostics) {
  const Node* words = row.list_of_texts(key);
  if (words == nullptr) return;
  for (const Node& word : words->children)
    if (!is_build_word(word.text))
      diagnostics.error(word.position, quote(word.text) + " cannot be one of " + std::string(key),
                        "each is " + std::string(meaning));
}

}  // namespace

std::optional<Index> read_interface_table(Library& library, const Node& root,
                                          const std::filesystem::path& file) {
  Diagnostics& diagnostics = library.diagnostics();
  Interface interface;
  interface.name = file.stem().string();
  interface.file = file;
  interface.space = library.space_of(file);
  interface.header = library.include_path(file, interface.name + ".hpp");
  interface.position = root.position;
  Row row(root, "this interface table", diagnostics);
  interface.summary = row.summary();
  interface.class_name = read_class(row, interface.name, diagnostics);
  if (is_camel_case(interface.class_name) && interface.class_name != camel_case(interface.name))
    diagnostics.error(row.position("class"),
                      "the class " + quote(interface.class_name) + " does not fit the file's name",
                      "interfaces are found by it: write " + quote(camel_case(interface.name)) +
                          ", or rename folder and file to " + quote(snake_case(interface.class_name)));
  interface.bus = row.boolean("bus").value_or(false);
  interface.operated = row.boolean("operated").value_or(false);
  interface.units = read_unit_choices(row, diagnostics);
  for (const char* section : {"resource", "output", "configuration", "runtime", "feedback"})
    row.also(section);
  row.finish();

  for (const Node* node : named_rows(library, root, "resource", "a resource"))
    interface.resources.push_back(read_resource(*node, diagnostics));
  const bool complete = read_outputs(library, root, interface.outputs);
  std::vector<std::pair<std::string, const Node*>> members;
  add_members(root, "resource", "a resource", members);
  add_members(root, "output", "an output", members);
  check_members(Heir::interface, members, diagnostics);
  read_parameters(library, root, Parameter::Kind::configuration, interface.configuration, interface.units);
  read_parameters(library, root, Parameter::Kind::runtime, interface.runtime, interface.units);
  read_parameters(library, root, Parameter::Kind::feedback, interface.feedback, interface.units);
  read_needs(library, root, interface.runtime, interface.feedback);
  read_needs_of_configuration(library, root, interface.configuration);
  if (!complete) return std::nullopt;

  Model& model = library.model();
  model.interfaces.push_back(std::move(interface));
  return model.interfaces.size() - 1;
}

std::optional<Index> read_driver_table(Library& library, const Node& root,
                                       const std::filesystem::path& file) {
  Diagnostics& diagnostics = library.diagnostics();
  Model& model = library.model();
  Driver driver;
  driver.stem = file.stem().string();
  driver.file = file;
  driver.space = library.space_of(file);
  driver.position = root.position;
  Row row(root, "this driver table", diagnostics);
  driver.summary = row.summary();
  driver.class_name = read_class(row, driver.stem, diagnostics);
  if (!is_snake_case(driver.stem))
    diagnostics.error(root.position, "the file's name " + quote(driver.stem) + " is not a name for a driver",
                      "name folder and file in lower_snake_case, as robotiq_gripper/robotiq_gripper.toml");
  driver.base_class = driver.class_name + "Driver";
  driver.header = library.include_path(file, driver.stem + ".hpp");
  driver.base_header = driver.stem + "_driver.hpp";
  driver.name = row.required_text(
                       "name", "add name = \"simulated\", as it is written in drivers = [...] and --hardware")
                    .value_or("");
  if (row.has("name") && !is_snake_case(driver.name))
    diagnostics.error(
        row.position("name"), quote(driver.name) + " is not a name for a driver",
        "names are lower_snake_case: small letters, digits and single underscores, a letter first");
  if (!row.has("kind")) row.missing("kind", "add kind = \"mock\", \"simulated\" or \"real\"");
  const auto kind = row.word("kind", {"mock", "simulated", "real"});
  if (kind) driver.kind = static_cast<Driver::Kind>(*kind);
  if (!row.has("actuates"))
    row.missing("actuates", "add actuates = true if it can move something, false if it only senses");
  driver.actuates = row.boolean("actuates").value_or(false);
  driver.virtual_time = row.boolean("virtual_time").value_or(false);
  driver.waits = row.boolean("waits").value_or(false);
  driver.helper_threads =
      static_cast<std::size_t>(row.integer("helper_threads", 0, most_helper_threads).value_or(0));
  const auto interface =
      row.required_text("interface", "add interface = \"RobotArm\", the interface that it implements");
  std::optional<Index> index;
  if (interface) index = library.interface(*interface, row.position("interface"));
  if (const auto bus = row.text("on")) {
    driver.bus_interface = library.interface(*bus, row.position("on"));
    if (driver.bus_interface && !model.interfaces[*driver.bus_interface].bus)
      diagnostics.error(row.position("on"), quote(*bus) + " is not a bus",
                        "name an interface whose table says bus = true");
  }
  for (const char* section : {"input", "output", "configuration", "runtime", "feedback", "option"})
    row.also(section);
  check_build_words(row, "libraries", "a target of the build, as \"FlexRF::can_wire\"", diagnostics);
  check_build_words(row, "packages", "what pkg-config calls a library, as \"libgpiod\"", diagnostics);
  const auto objects = row.text("objects");
  refuse_resources(row, interface.value_or(""), diagnostics);
  row.finish();
  driver.options = read_driver_options(library, root, driver.kind);
  // A copy: further tables may be read meanwhile, and the interfaces move.
  Interface face;
  if (index) {
    driver.interface = *index;
    face = model.interfaces[*index];
  }
  bool complete = read_inputs(library, root, driver.inputs);
  complete = read_outputs(library, root, driver.outputs) && complete;
  read_parameters(library, root, Parameter::Kind::configuration, driver.configuration, face.units,
                  face.configuration);
  read_parameters(library, root, Parameter::Kind::runtime, driver.runtime, face.units, face.runtime);
  read_parameters(library, root, Parameter::Kind::feedback, driver.feedback, face.units, face.feedback);
  read_needs(library, root, driver.runtime, driver.feedback, face);
  read_needs_of_configuration(library, root, driver.configuration, face.configuration);
  if (!index) return std::nullopt;
  check_beside(face.configuration, driver.configuration, *interface, diagnostics);
  check_beside(face.runtime, driver.runtime, *interface, diagnostics);
  check_beside(face.feedback, driver.feedback, *interface, diagnostics);
  check_ports_beside(face, driver, root, diagnostics);
  if (!complete) return std::nullopt;  // as of a unit

  if (objects) read_objects(library, *objects, row.position("objects"), driver);

  model.drivers.push_back(std::move(driver));
  return model.drivers.size() - 1;
}

}  // namespace flexrf::config_gen
