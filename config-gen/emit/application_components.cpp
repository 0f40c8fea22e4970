// Devices and units of a generated application: storage, initial values, connections, records.
#include "config-gen/emit/application_parts.hpp"
#include "config-gen/emit/component.hpp"
#include "config-gen/model/ports.hpp"
#include "config-gen/urdf/urdf_reader.hpp"

namespace flexrf::config_gen {
namespace {

std::string index_or_none(const std::optional<Index>& index) {
  return index ? std::to_string(*index) : "no_index";
}

std::string slot_or_null(const ApplicationNames& names, const std::optional<Index>& slot) {
  return slot ? "&slot_" + names.slot(*slot) : "nullptr";
}

std::string value_list(const Model& model, const ParameterBlock& block, const std::vector<Literal>& values) {
  std::string list;
  for (std::size_t i = 0; i < block.parameters.size(); ++i) {
    const Literal& value = i < values.size() ? values[i] : block.parameters[i].initial;
    list +=
        (list.empty() ? "" : ", ") + cpp_value(model, application_space, block.parameters[i].field, value);
  }
  return list;
}

// The initial values of one block, as a constant; "nullptr" when the block has no parameters.
std::string emit_values(
    const Model& model, const std::string& type, const std::string& name,
    const std::vector<std::pair<const ParameterBlock*, const std::vector<Literal>*>>& parts, Text& out) {
  std::string list;
  for (const auto& [block, values] : parts) {
    const std::string more = value_list(model, *block, *values);
    list += (list.empty() || more.empty() ? "" : ", ") + more;
  }
  if (list.empty()) return "nullptr";
  out << "constexpr " << type << " " << name << "{" << list << "};\n";
  return "&" + name;
}

// Of a driver with runtime parameters of its own: its struct derives from its interface's.
std::string emit_driver_runtime(const Model& model, const Device& device, const DriverChoice& choice,
                                const std::string& prefix, Text& out) {
  const Driver& driver = model.drivers[choice.driver];
  const Interface& interface = model.interfaces[device.interface];
  const std::string name = prefix + "_" + driver.stem + "_runtime";
  const std::string base = value_list(model, interface.runtime, device.runtime);
  out << "constexpr " << application_space.of(driver, block_struct_name(driver.class_name, "Runtime")) << " "
      << name << "{" << (base.empty() ? "" : "{" + base + "}, ")
      << value_list(model, driver.runtime, choice.runtime) << "};\n";
  return "&" + name;
}

// The members of a range and their readers, or the one reader of a plain input.
std::string input_binding(const Model& model, const ApplicationNames& names, const PortOwner& owner,
                          Index port, const std::string& prefix, Text& out) {
  const PortSet ports = ports_of(model, owner);
  const InputPort& input = ports.inputs[port];
  const std::vector<Index>& slots = ports.from[port].slots;
  if (slots.empty()) return "{}";
  std::string members = "nullptr";
  if (input.range) {
    members = prefix + "_" + std::to_string(port) + "_members";
    out << "alignas(cache_line) constinit Input<"
        << application_space.of(model.types[input.type], model.types[input.type].name) << "> " << members
        << "[" << slots.size() << "]{};\n";
  }
  return "{" + names.reader_of(owner, port) + ", " + std::to_string(slots.size()) + ", " +
         duration_literal(input.max_age.value_or(0)) + ", " + members + "}";
}

// A PortBinding of all that these owners have, one after the other: slots and queues apart, in the order of
// their tables. Of a device they are its interface, and a driver of it.
std::string port_binding(const Model& model, const ApplicationNames& names,
                         const std::vector<PortOwner>& owners, const std::string& prefix, Text& out) {
  std::string inputs, queue_inputs, outputs, queue_outputs;
  const auto add = [](std::string& list, const std::string& one) {
    list += (list.empty() ? "" : ", ") + one;
  };
  Index output = 0;
  for (const PortOwner& owner : owners) {
    const PortSet ports = ports_of(model, owner);
    for (Index port = 0; port < ports.inputs.size(); ++port) {
      if (ports.inputs[port].queue) {
        const std::optional<Index>& queue = ports.from[port].queue;
        add(queue_inputs, queue ? names.source(*queue) : "nullptr");
      } else {
        add(inputs, input_binding(model, names, owner, port, prefix, out));
      }
    }
    for (Index port = 0; port < ports.outputs.size(); ++port, ++output) {
      if (!ports.outputs[port].queue) {
        add(outputs, slot_or_null(names, ports.to[port].slot));
        continue;
      }
      const std::string sinks = names.sinks_of(ports.to[port], owner, port);
      const std::string name = prefix + "_" + std::to_string(output) + "_sinks";
      emit_array("QueueSink* const", name, sinks, out);
      add(queue_outputs, array_or_none(name, sinks));
    }
  }
  emit_array("constexpr InputBinding", prefix + "_inputs", inputs, out);
  emit_array("QueueSource* const", prefix + "_queue_inputs", queue_inputs, out);
  emit_array("SlotControl* const", prefix + "_outputs", outputs, out);
  emit_array("constexpr std::span<QueueSink* const>", prefix + "_queue_outputs", queue_outputs, out);
  const std::optional<Index> thread = ports_of(model, owners.front()).thread;
  return "{&context_" + names.thread(thread.value_or(0)) + ", " + array_or_none(prefix + "_inputs", inputs) +
         ", " + array_or_none(prefix + "_queue_inputs", queue_inputs) + ", " +
         array_or_none(prefix + "_outputs", outputs) + ", " +
         array_or_none(prefix + "_queue_outputs", queue_outputs) + "}";
}

// What differs in the records of units and devices without being of one of them alone.
struct Common {
  Index index;
  const char* kind;
  std::string level;
  Nanoseconds stop_timeout;
};

// What the records of units and devices have in common; either is told by its row.
template <class Row>
std::string common_part(const ApplicationNames& names, const Row& row, const Common& common,
                        const std::string& summary, const std::string& prefix) {
  return "{.index = " + std::to_string(common.index) + ",\n      .kind = \"" + common.kind +
         "\",\n      .name = \"" + row.name + "\",\n      .summary = " + string_literal(summary) +
         ",\n      .level = " + common.level + ",\n      .storage = " + prefix +
         ",\n      .storage_size = sizeof(" + prefix + "),\n      .thread = " + index_or_none(row.thread) +
         ",\n      .runtime_slot = " + slot_or_null(names, row.values_slot) +
         ",\n      .feedback_slot = " + slot_or_null(names, row.feedback_slot) +
         ",\n      .initialise_timeout = " + duration_literal(row.initialise_timeout) +
         ",\n      .stop_timeout = " + duration_literal(common.stop_timeout);
}

std::string emit_resources(const Model& model, const Device& device, const std::string& prefix, Text& out) {
  std::string list;
  for (const DeviceResource& resource : device.resources) {
    const std::string constant =
        prefix + "_" + model.interfaces[device.interface].resources[resource.resource].name + "_resource";
    if (resource.registers) {
      emit_register_map(*resource.registers, constant, out);
      list += (list.empty() ? "&" : ", &") + constant;
      continue;
    }
    if (!resource.chain) continue;
    out << "constexpr KinematicChain " << constant << " = " << emit_kinematic_chain(*resource.chain) << ";\n";
    list += (list.empty() ? "&" : ", &") + constant;
  }
  emit_array("constexpr const void*", prefix + "_resources", list, out);
  return array_or_none(prefix + "_resources", list);
}

// Of a driver with ports of its own; else nothing.
std::string emit_driver_ports(const Model& model, const ApplicationNames& names, const PortOwner& owner,
                              const std::string& prefix, Text& out) {
  const PortSet ports = ports_of(model, owner);
  if (ports.inputs.empty() && ports.outputs.empty()) return "";
  const std::string binding =
      port_binding(model, names, {{PortOwner::Kind::device, owner.component, 0}, owner}, prefix, out);
  out << "constexpr PortBinding " << prefix << "_ports = " << binding << ";\n";
  return "&" + prefix + "_ports";
}

std::string emit_drivers(const Model& model, const ApplicationNames& names, Index index,
                         const std::string& prefix, Text& out) {
  const Device& device = model.devices[index];
  const Interface& interface = model.interfaces[device.interface];
  Text records;
  const std::string common_runtime =
      emit_values(model, application_space.of(interface, block_struct_name(interface.class_name, "Runtime")),
                  prefix + "_runtime", {{&interface.runtime, &device.runtime}}, out);
  for (Index place = 0; place < device.drivers.size(); ++place) {
    const DriverChoice& choice = device.drivers[place];
    const Driver& driver = model.drivers[choice.driver];
    const std::string ports = emit_driver_ports(model, names, {PortOwner::Kind::driver, index, place},
                                                prefix + "_" + driver.stem, out);
    const std::string runtime =
        driver.runtime.empty() ? common_runtime : emit_driver_runtime(model, device, choice, prefix, out);
    const std::string configuration = emit_values(
        model, application_space.of(driver, block_struct_name(driver.class_name, "Configuration")),
        prefix + "_" + driver.stem + "_configuration",
        {{&interface.configuration, &device.configuration}, {&driver.configuration, &choice.configuration}},
        out);
    const char* kind = driver.kind == Driver::Kind::mock        ? "mock"
                       : driver.kind == Driver::Kind::simulated ? "simulated"
                                                                : "real";
    records << "    {\"" << driver.name << "\", DriverKind::" << kind << ", " << bool_literal(driver.actuates)
            << ", " << bool_literal(driver.virtual_time) << ", " << size_name(driver) << ", &"
            << application_space.of(driver, driver_construct_name(driver)) << ", &"
            << application_space.of(driver, driver_component_name(driver)) << ", " << configuration << ", "
            << runtime
            << (!driver.options.empty() ? ", " + application_space.of(driver, driver_options_name(driver))
                : !ports.empty()        ? ", {}"
                                        : "")
            << (ports.empty() ? "" : ", " + ports) << "},\n";
  }
  out << "constexpr DriverRecord " << prefix << "_drivers[] = {\n" << records.str() << "};\n";
  return prefix + "_drivers";
}

std::string emit_binding(const Model& model, const ApplicationNames& names, Index index,
                         const std::string& prefix, Text& out) {
  const std::string ports = port_binding(model, names, {{PortOwner::Kind::unit, index, 0}}, prefix, out);
  const std::string devices = list_of(model.units[index].devices, [](const std::optional<Index>& device) {
    return "&constructed_devices[" + std::to_string(device.value_or(0)) + "]";
  });
  emit_array("constexpr Device* const*", prefix + "_devices", devices, out);
  return "{" + ports + ", " + array_or_none(prefix + "_devices", devices) + "}";
}

const char* restart_policy(Unit::Restart restart) {
  switch (restart) {
    case Unit::Restart::never:
      return "never";
    case Unit::Restart::once:
      return "once";
    case Unit::Restart::always:
      break;
  }
  return "always";
}

std::string instead_of(const Device& device) {
  const auto& instead = device.instead;
  if (!instead[0] && !instead[1] && !instead[2]) return "";
  const auto place = [](const std::optional<Index>& driver) {
    return driver ? std::to_string(*driver) : std::string("no_driver");
  };
  return ",\n      .instead = {" + place(instead[0]) + ", " + place(instead[1]) + ", " + place(instead[2]) +
         "}";
}

/// On a bus; each bus that is itself on one lifts it by one level more.
std::string level_of(const Model& model, const Device& device) {
  if (!device.bus) return "level_base";
  std::size_t more = 0;
  for (auto bus = model.devices[*device.bus].bus; bus; bus = model.devices[*bus].bus) ++more;
  return more == 0 ? "level_carried" : "level_carried + " + std::to_string(more);
}

}  // namespace

void emit_devices(const Model& model, const ApplicationNames& names, Text& out,
                  std::vector<std::string>& sizes) {
  if (model.devices.empty()) return;
  out << "\n// ---- Devices: room for the largest of their drivers\n\nconstinit Device* constructed_devices["
      << model.devices.size() << "]{};\n";
  Text records;
  for (Index i = 0; i < model.devices.size(); ++i) {
    const Device& device = model.devices[i];
    const Interface& interface = model.interfaces[device.interface];
    const std::string prefix = "device_" + names.device(i);
    const std::string each_size = list_of(
        device.drivers, [&](const DriverChoice& choice) { return size_name(model.drivers[choice.driver]); });
    out << "\nalignas(cache_line) std::byte " << prefix << "[std::max({" << each_size << "})];\n";
    sizes.push_back("sizeof(" + prefix + ")");
    const std::string ports = port_binding(model, names, {{PortOwner::Kind::device, i, 0}}, prefix, out);
    const std::string resources = emit_resources(model, device, prefix, out);
    const std::string drivers = emit_drivers(model, names, i, prefix, out);
    const Common common{static_cast<Index>(model.units.size() + i), "device", level_of(model, device),
                        device.initialise_timeout};
    records << "    {" << common_part(names, device, common, interface.summary, prefix)
            << "},\n     {.interface = \"" << interface.class_name << "\",\n      .drivers = " << drivers
            << instead_of(device) << ",\n      .instance = &constructed_devices[" << i
            << "],\n      .binding = {" << ports << ", " << resources
            << ", nullptr},\n      .bus = " << index_or_none(device.bus)
            << ",\n      .unit = " << index_or_none(device.owner_unit)
            << (device.required ? "" : ",\n      .required = false") << "}},\n";
  }
  out << "\nconstexpr DeviceRecord devices_table[] = {\n" << records.str() << "};\n";
}

void emit_units(const Model& model, const ApplicationNames& names, Text& out,
                std::vector<std::string>& sizes) {
  if (model.units.empty()) return;
  out << "\n// ---- Units: storage, initial values, connections\n";
  Text records;
  for (Index i = 0; i < model.units.size(); ++i) {
    const Unit& unit = model.units[i];
    const UnitType& type = model.unit_types[unit.type];
    const std::string prefix = "unit_" + names.unit(i);
    out << "\nalignas(cache_line) std::byte " << prefix << "[" << size_name(type) << "];\n";
    sizes.push_back("sizeof(" + prefix + ")");
    const std::string configuration =
        emit_values(model, application_space.of(type, block_struct_name(type.class_name, "Configuration")),
                    prefix + "_configuration", {{&type.configuration, &unit.configuration}}, out);
    const std::string runtime =
        emit_values(model, application_space.of(type, block_struct_name(type.class_name, "Runtime")),
                    prefix + "_runtime", {{&type.runtime, &unit.runtime}}, out);
    const std::string binding = emit_binding(model, names, i, prefix, out);
    const Common common{i, "unit", "level_unit", unit.stop_timeout.value_or(model.application->stop_timeout)};
    records << "    {" << common_part(names, unit, common, type.summary, prefix)
            << ",\n      .population = " << index_or_none(unit.population)
            << ",\n      .member = " << unit.member
            << ",\n      .budget = " << duration_literal(unit.budget.value_or(0)) << "},\n     {.type = &"
            << application_space.of(type, unit_component_name(type)) << ",\n      .construct = &"
            << application_space.of(type, unit_construct_name(type)) << ",\n      .binding = " << binding
            << ",\n      .configuration = " << configuration << ",\n      .runtime = " << runtime
            << ",\n      .restart = RestartPolicy::" << restart_policy(unit.restart) << "}},\n";
  }
  out << "\nconstexpr UnitRecord units_table[] = {\n" << records.str() << "};\n";
  if (model.populations.empty()) return;
  out << "\nconstexpr PopulationRecord populations_table[] = {\n";
  for (const Population& population : model.populations) {
    out << "    {\"" << population.name << "\", " << population.first << ", " << population.capacity << ", "
        << population.active << "},\n";
  }
  out << "};\n";
}

}  // namespace flexrf::config_gen
