// [device.N] rows of applications and groups.
#include <algorithm>
#include <array>

#include "config-gen/model/source_text.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"
#include "config-gen/read/eds_check.hpp"
#include "config-gen/read/register_map.hpp"
#include "config-gen/read/robot_row.hpp"

namespace flexrf::config_gen {
namespace {

// io_thread = true, or { priority, role, period, min_interval, budget, stack, hang_timeout }.
void read_io_thread(Assembly& assembly, Row& row, Index device) {
  const Node* value = row.any("io_thread");
  if (value == nullptr || (value->kind == Node::Kind::boolean && !value->boolean)) return;
  Thread thread;
  thread.name = assembly.model.devices[device].name;
  thread.position = thread.trigger_position = value->position;
  thread.io_device = device;
  thread.role = CpuRole::io;
  thread.summary = "Serves the device " + thread.name + ".";
  DeviceTrigger trigger;
  trigger.device = device;
  thread.trigger = trigger;
  if (value->kind == Node::Kind::table) {
    Row io(*value, "'io_thread' of " + row.name(), assembly.diagnostics);
    thread.priority = static_cast<int>(io.integer("priority", 0, 98).value_or(0));
    thread.above_interrupts = io.boolean("above_interrupts").value_or(false);
    thread.role = read_role(io).value_or(thread.role);
    const auto period = io.positive_duration("period", release_bounds);
    trigger.min_interval = io.positive_duration("min_interval", release_bounds);
    thread.trigger = trigger;
    if (period) thread.trigger = PeriodTrigger{*period, 0};
    if (period && io.has("min_interval"))
      assembly.diagnostics.error(
          io.position("min_interval"), io.name() + " has both 'period' and 'min_interval'",
          "keep 'period' for a polled device, 'min_interval' for one that wakes its thread");
    thread.demand = io.positive_duration("budget", release_bounds).value_or(0);
    thread.stack = read_stack(io, assembly.diagnostics).value_or(thread.stack);
    thread.hang_timeout = io.positive_duration("hang_timeout", supervision_bounds);
    io.finish();
  } else if (value->kind != Node::Kind::boolean) {
    row.wrong_kind(*value, "io_thread", "true or a table",
                   "write io_thread = true, or io_thread = { priority = 30, period = \"1 ms\" }");
    return;
  }
  assembly.io_threads.push_back(std::move(thread));
}

void read_drivers(Assembly& assembly, Row& row, const Scope& scope, Device& device) {
  if (!row.has("drivers")) row.missing("drivers", "add drivers = [\"simulated\"]: the first is the default");
  const Node* names = row.list_of_texts("drivers");
  if (names == nullptr) return;
  if (names->children.empty())
    assembly.diagnostics.error(names->position, row.name() + " permits no driver",
                               "name at least one; the first is the default");
  std::vector<std::string> seen;
  for (const Node& name : names->children) {
    if (std::find(seen.begin(), seen.end(), name.text) != seen.end()) {
      assembly.diagnostics.error(name.position,
                                 "the driver " + quote(name.text) + " is listed twice in " + row.name(),
                                 "remove one");
      continue;
    }
    seen.push_back(name.text);
    const Node* values = row.table(name.text);
    const auto driver = assembly.library.driver(device.interface, name.text, name.position);
    if (!driver) {
      if (values != nullptr) mark_broken_places(assembly, *values, scope);
      continue;
    }
    DriverChoice choice;
    choice.driver = *driver;
    choice.inputs.resize(assembly.model.drivers[*driver].inputs.size());
    choice.outputs.resize(assembly.model.drivers[*driver].outputs.size());
    const Node* configuration = nullptr;
    const Node* runtime = nullptr;
    if (values != nullptr) {
      Row own(*values, quote(name.text) + " in " + row.name(), assembly.diagnostics);
      configuration = own.table("configuration");
      runtime = own.table("runtime");
      own.table("in");
      own.table("out");
      if (assembly.model.drivers[*driver].takes_eds) {
        choice.eds = own.text("eds").value_or("");
        choice.eds_position = own.position("eds");
      }
      own.finish();
    }
    const std::string of_driver = row.name() + ", driver " + quote(name.text);
    choice.configuration = read_values(assembly, configuration, assembly.model.drivers[*driver].configuration,
                                       "configuration", of_driver);
    choice.runtime =
        read_values(assembly, runtime, assembly.model.drivers[*driver].runtime, "runtime", of_driver);
    device.drivers.push_back(std::move(choice));
  }
}

// instead = { mock = "simulated" }: what --hardware mock chooses of a device that has no mock.
void read_instead(Assembly& assembly, Row& row, Device& device) {
  const Node* value = row.table("instead");
  if (value == nullptr) return;
  Row kinds(*value, "'instead' of " + row.name(), assembly.diagnostics);
  constexpr std::array<const char*, 3> names{"mock", "simulated", "real"};
  for (std::size_t kind = 0; kind < names.size(); ++kind) {
    const auto wanted = kinds.text(names[kind]);
    if (!wanted) continue;
    std::vector<std::string> known;
    for (std::size_t i = 0; i < device.drivers.size(); ++i) {
      const Driver& driver = assembly.model.drivers[device.drivers[i].driver];
      known.push_back(driver.name);
      if (driver.name == *wanted) device.instead[kind] = i;
      if (static_cast<std::size_t>(driver.kind) != kind) continue;
      assembly.diagnostics.error(
          kinds.position(names[kind]),
          row.name() + " has a driver of the kind " + quote(names[kind]) + ": " + quote(driver.name),
          "remove this key: --hardware " + std::string(names[kind]) + " chooses that one");
    }
    if (!device.instead[kind])
      assembly.diagnostics.error(kinds.position(names[kind]),
                                 row.name() + " permits no driver " + quote(*wanted),
                                 suggest(*wanted, known, "drivers", "name one of drivers = [...]"));
  }
  kinds.finish();
}

void read_resources(Assembly& assembly, Row& row, Device& device) {
  const Interface& interface = assembly.model.interfaces[device.interface];
  const std::filesystem::path folder = assembly.model.application->file.parent_path();
  for (std::size_t i = 0; i < interface.resources.size(); ++i) {
    const Resource& resource = interface.resources[i];
    const bool is_robot = resource.reader == Resource::Reader::urdf;
    if (!row.has(resource.key)) {
      row.missing(resource.key, interface.class_name + " needs its " + quote(resource.name) + ": add " +
                                    resource.key + " = \"FILE\", relative to the application's folder");
      continue;
    }
    RobotRow robot;
    if (is_robot) {
      robot = read_robot_row(row, resource.key, row.node().key, assembly.diagnostics);
    } else {
      robot.file = row.text(resource.key);
      robot.urdf.position = row.position(resource.key);
    }
    if (!robot.file) continue;
    const std::filesystem::path file = (folder / *robot.file).lexically_normal();
    device.resources.push_back({i, file, robot.urdf.position, std::nullopt, std::nullopt, {}});
    DeviceResource& read = device.resources.back();
    for (const std::string& package : robot.packages)
      read.packages.push_back((folder / package).lexically_normal());
    if (!check_named_file(file, *robot.file, robot.urdf.position, assembly.diagnostics)) continue;
    assembly.model.files.push_back(file);
    if (is_robot)
      read.chain = read_urdf(file, robot.urdf, assembly.diagnostics);
    else
      read.registers = read_register_map(file, assembly.diagnostics);
  }
}

// units.axis = "m": what the interface leaves to each device.
void read_units(Row& row, const Interface& interface, Device& device, Diagnostics& diagnostics) {
  const auto hint = [&interface](const UnitChoice& choice) {
    std::string offers;
    for (const std::string& unit : choice.units)
      offers += (offers.empty() ? "" : " or ") + ("units." + choice.name + " = \"" + unit + "\"");
    return interface.class_name + " is measured in it: add " + offers;
  };
  const Node* table = row.table("units");
  if (table == nullptr) {
    for (const UnitChoice& choice : interface.units)
      if (!row.has("units")) row.missing("units." + choice.name, hint(choice));
    return;
  }
  Row units(*table, "'units' of " + row.name(), diagnostics);
  for (const UnitChoice& choice : interface.units) {
    if (!units.has(choice.name)) units.missing(choice.name, hint(choice));
    const auto place = units.word(choice.name, choice.units);
    device.units.push_back(choice.units[place.value_or(0)]);
  }
  units.finish();
}

// What the vendor says of the device, against what the driver asks of it.
void check_data_sheets(Assembly& assembly, const Device& device) {
  const Interface& interface = assembly.model.interfaces[device.interface];
  for (const DriverChoice& choice : device.drivers) {
    if (choice.eds.empty()) continue;
    const Driver& driver = assembly.model.drivers[choice.driver];
    const std::filesystem::path file =
        (assembly.model.application->file.parent_path() / choice.eds).lexically_normal();
    if (!check_named_file(file, choice.eds, choice.eds_position, assembly.diagnostics)) continue;
    assembly.model.files.push_back(file);
    const auto eds = read_eds(file, assembly.diagnostics);
    if (!eds) continue;
    const auto parameter = [&](const std::string& name) -> const Literal* {
      const auto in = [&](const ParameterBlock& block, const std::vector<Literal>& values) -> const Literal* {
        for (std::size_t i = 0; i < block.parameters.size() && i < values.size(); ++i)
          if (block.parameters[i].field.name == name) return &values[i];
        return nullptr;
      };
      const Literal* own = in(driver.configuration, choice.configuration);
      return own != nullptr ? own : in(interface.configuration, device.configuration);
    };
    check_eds({*eds, choice.eds, choice.eds_position, driver.objects, parameter}, assembly.diagnostics);
  }
}

void read_device_overrides(Assembly& assembly, Row& row, Device& device) {
  const Interface& kind = assembly.model.interfaces[device.interface];
  // Of several of one name the first is meant.
  std::vector<const ParameterBlock*> blocks;
  const auto add = [&](const ParameterBlock& common, ParameterBlock Driver::*own) {
    blocks.push_back(&common);
    for (const DriverChoice& choice : device.drivers)
      blocks.push_back(&(assembly.model.drivers[choice.driver].*own));
  };
  add(kind.runtime, &Driver::runtime);
  add(kind.configuration, &Driver::configuration);
  add(kind.feedback, &Driver::feedback);
  device.overrides = read_overrides(assembly, row.table("parameter"), blocks, quote(device.name), row.name());
  check_narrowed(assembly, device.overrides, kind.configuration, device.configuration);
  check_narrowed(assembly, device.overrides, kind.runtime, device.runtime);
  for (const DriverChoice& choice : device.drivers) {
    const Driver& driver = assembly.model.drivers[choice.driver];
    check_narrowed(assembly, device.overrides, driver.configuration, choice.configuration);
    check_narrowed(assembly, device.overrides, driver.runtime, choice.runtime);
  }
}

}  // namespace

void read_device_row(Assembly& assembly, const FlatRow& flat) {
  Row row(*flat.node, "[device." + flat.node->key + "]", assembly.diagnostics);
  const auto name = row.required_text("interface", "add interface = \"RobotArm\", the name of an interface");
  const auto interface = name ? assembly.library.interface(*name, row.position("interface")) : std::nullopt;
  if (!interface) {
    mark_broken(assembly, flat);
    return;
  }
  const Index index = assembly.model.devices.size();
  {
    Device device;
    device.name = flat.scope->prefix + flat.node->key;
    device.position = flat.node->key_position;
    device.interface = *interface;
    assembly.devices.emplace(device.name, index);
    assembly.model.devices.push_back(std::move(device));
  }
  assembly.device_rows.push_back({&flat, index});
  Device& device = assembly.model.devices[index];
  read_drivers(assembly, row, *flat.scope, device);
  read_instead(assembly, row, device);
  read_resources(assembly, row, device);
  read_units(row, assembly.model.interfaces[*interface], device, assembly.diagnostics);
  row.text("on");
  row.table("out");
  device.outputs.resize(assembly.model.interfaces[*interface].outputs.size());
  device.initialise_timeout =
      row.positive_duration("initialise_timeout", supervision_bounds).value_or(device.initialise_timeout);
  device.required = row.boolean("required").value_or(device.required);
  const Interface& kind = assembly.model.interfaces[*interface];
  device.configuration =
      read_values(assembly, row.table("configuration"), kind.configuration, "configuration", row.name());
  device.runtime = read_values(assembly, row.table("runtime"), kind.runtime, "runtime", row.name());
  const ConfigurationPart common{kind.configuration, device.configuration};
  check_needs_of_configuration(assembly, common, std::nullopt, row);
  for (const DriverChoice& choice : device.drivers)
    check_needs_of_configuration(
        assembly, {assembly.model.drivers[choice.driver].configuration, choice.configuration}, common, row);
  check_data_sheets(assembly, device);
  read_device_overrides(assembly, row, device);
  read_io_thread(assembly, row, index);
  row.finish();
}

void connect_devices(Assembly& assembly) {
  Model& model = assembly.model;
  // A name means the row in the same table, else one in a table around it.
  const auto look_up = [&](const Scope& scope, const std::string& name) -> std::optional<Index> {
    std::string prefix = scope.prefix;
    while (true) {
      if (const auto found = assembly.devices.find(prefix + name); found != assembly.devices.end())
        return found->second;
      if (prefix.empty()) return std::nullopt;
      const std::size_t dot = prefix.rfind('.', prefix.size() - 2);
      prefix = dot == std::string::npos || prefix.size() < 2 ? "" : prefix.substr(0, dot + 1);
    }
  };
  const auto unknown = [&](const Scope& scope, const Node& value) {
    // The one that was meant has no owner only because of this.
    if (const std::string meant = nearest(value.text, assembly.names_in(scope, assembly.devices));
        !meant.empty())
      assembly.broken_owners.insert(scope.prefix + meant);
    if (assembly.is_broken_device(scope.prefix + value.text) || assembly.is_broken_device(value.text)) return;
    assembly.diagnostics.error(value.position, "unknown device " + quote(value.text),
                               suggest(value.text, assembly.names_in(scope, assembly.devices), "devices",
                                       "declare it as [device." + value.text + "]"));
  };
  for (const DeviceRow& entry : assembly.device_rows) {
    const Scope& scope = *entry.row->scope;
    const InScope in_scope(assembly.diagnostics, scope);
    const Node* on = entry.row->node->find("on");
    if (on == nullptr || (on->kind != Node::Kind::text && !on->cell)) continue;
    const auto bus = look_up(scope, on->text);
    if (!bus) {
      unknown(scope, *on);
      model.devices[entry.device].partial = true;
    } else if (*bus == entry.device || !model.interfaces[model.devices[*bus].interface].bus) {
      assembly.diagnostics.error(
          on->position,
          quote(on->text) + " is not a bus, so " + quote(entry.row->node->key) + " cannot be on it",
          "name a device whose interface's table says bus = true");
      model.devices[entry.device].partial = true;
    } else {
      model.devices[entry.device].bus = bus;
      model.devices[*bus].children.push_back(entry.device);
    }
  }
  for (const UnitRow& entry : assembly.unit_rows) {
    const Scope& scope = *entry.row->scope;
    const InScope in_scope(assembly.diagnostics, scope);
    const UnitType& type = model.unit_types[model.units[entry.first].type];
    const std::string row_name = "[unit." + entry.row->node->key + "]";
    const Node* section = entry.row->node->find("device");
    if (section != nullptr && section->kind != Node::Kind::table) continue;
    std::vector<std::string> known;
    for (std::size_t port = 0; port < type.devices.size(); ++port) {
      known.push_back(type.devices[port].name);
      const Node* value = section != nullptr ? section->find(type.devices[port].name) : nullptr;
      if (value == nullptr) {
        assembly.diagnostics.error(entry.row->node->key_position,
                                   row_name + " is given no device for " + quote(type.devices[port].name),
                                   "add device." + type.devices[port].name +
                                       " = \"NAME\", a device with the interface " +
                                       model.interfaces[type.devices[port].interface].class_name);
        continue;
      }
      if (value->kind != Node::Kind::text) {
        assembly.diagnostics.error(value->position,
                                   quote("device." + value->key) + " of " + row_name +
                                       " must be a text, not " + kind_text(value->kind),
                                   "write the device's name in double quotes");
        continue;
      }
      const auto device = look_up(scope, value->text);
      if (!device) {
        unknown(scope, *value);
        continue;
      }
      for (std::size_t member = 0; member < entry.count; ++member)
        model.units[entry.first + member].devices[port] = device;
      if (!model.devices[*device].owner_unit) {
        model.devices[*device].owner_unit = entry.first;
        model.devices[*device].owner_port = port;
      }
    }
    if (section == nullptr) continue;
    for (const Node& child : section->children)
      if (std::find(known.begin(), known.end(), child.key) == known.end())
        assembly.diagnostics.error(
            child.key_position,
            "unknown device " + quote(child.key) + " of the unit type " + quote(type.name),
            suggest(child.key, known, "devices", "it owns none: remove this line"));
  }
}

}  // namespace flexrf::config_gen
