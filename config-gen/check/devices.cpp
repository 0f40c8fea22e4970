// Devices: owners, buses, IO threads, drivers.
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "config-gen/check/checks.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

struct Owner {
  Index unit = 0;
  Index port = 0;
};

std::map<Index, std::vector<Owner>> owners_by_device(const Model& model) {
  std::map<Index, std::vector<Owner>> owners;
  for (Index unit = 0; unit < model.units.size(); ++unit) {
    if (model.units[unit].member > 0) continue;  // a population that owns a device was reported as such
    for (Index port = 0; port < model.units[unit].devices.size(); ++port)
      if (const auto device = model.units[unit].devices[port]) owners[*device].push_back({unit, port});
  }
  return owners;
}

// Of its interface or of a driver: then it has something to do by itself.
bool has_ports(const Model& model, const Device& device) {
  return !model.interfaces[device.interface].outputs.empty() ||
         std::any_of(device.drivers.begin(), device.drivers.end(), [&](const DriverChoice& choice) {
           const Driver& driver = model.drivers[choice.driver];
           return !driver.inputs.empty() || !driver.outputs.empty();
         });
}

bool waits(const Model& model, const Device& device) {
  return std::any_of(device.drivers.begin(), device.drivers.end(),
                     [&](const DriverChoice& choice) { return model.drivers[choice.driver].waits; });
}

void check_owners(const Model& model, const Device& device, const std::vector<Owner>& owners,
                  Diagnostics& diagnostics) {
  const Interface& interface = model.interfaces[device.interface];
  for (const Owner& owner : owners) {
    const Unit& unit = model.units[owner.unit];
    const DevicePort& port = model.unit_types[unit.type].devices[owner.port];
    const InInstance instance(diagnostics, model, unit.name);
    if (port.interface != device.interface)
      diagnostics.error(unit.position,
                        "device " + quote(port.name) + " of unit " + quote(unit.name) + " must be a " +
                            model.interfaces[port.interface].class_name + ", but " + quote(device.name) +
                            " is a " + interface.class_name,
                        "the device is declared at " + to_string(device.position) + ", the unit's port at " +
                            to_string(port.position));
    if (&owner != &owners.front())
      diagnostics.error(
          unit.position,
          "device " + quote(device.name) + " has two owners: units " +
              quote(model.units[owners.front().unit].name) + " and " + quote(unit.name),
          "one unit owns a device, and others ask it through slots and queues; the first owner is at " +
              to_string(model.units[owners.front().unit].position));
  }
  const InInstance instance(diagnostics, model, device.name);
  // What waits or publishes lacks an IO thread rather than an owner, which is reported as such.
  const bool lacks_io_thread = std::any_of(device.outputs.begin(), device.outputs.end(),
                                           [](const auto& output) { return bool(output.position); }) ||
                               waits(model, device);
  if (owners.empty() && !device.io_thread && !interface.bus && !lacks_io_thread)
    diagnostics.error(device.position, "device " + quote(device.name) + " has no owner",
                      !has_ports(model, device)
                          ? "give it to a unit, as device.NAME = \"" + device.name + "\""
                          : "give it to a unit, as device.NAME = \"" + device.name +
                                "\", or let it publish by itself with io_thread = true");
  if (!owners.empty() && device.io_thread && !interface.bus)
    diagnostics.error(device.position,
                      "device " + quote(device.name) + " has an IO thread and is owned by unit " +
                          quote(model.units[owners.front().unit].name),
                      "remove io_thread and let the unit's thread serve it, or remove it from the unit at " +
                          to_string(model.units[owners.front().unit].position) + " and read its outputs");
  if (interface.bus && device.children.empty() && owners.empty())
    diagnostics.error(device.position, "bus " + quote(device.name) + " carries nothing",
                      "put a device on it, as on = \"" + device.name + "\", or remove it");
}

void check_io_thread(const Model& model, const Device& device, Diagnostics& diagnostics) {
  const Interface& interface = model.interfaces[device.interface];
  if (!device.io_thread) {
    for (std::size_t port = 0; port < device.outputs.size(); ++port)
      if (device.outputs[port].position)
        diagnostics.error(device.outputs[port].position,
                          "device " + quote(device.name) + " publishes " +
                              quote(interface.outputs[port].name) + " only with an IO thread",
                          "add io_thread = true, or let the unit that owns it publish");
  } else if (!has_ports(model, device) && !interface.bus && !waits(model, device)) {
    diagnostics.error(model.threads[*device.io_thread].position,
                      "device " + quote(device.name) + " needs no IO thread: " + interface.class_name +
                          " publishes nothing",
                      "remove io_thread, and give the device to a unit");
  }
}

void check_drivers(const Model& model, const Device& device, Diagnostics& diagnostics) {
  for (const DriverChoice& choice : device.drivers) {
    const Driver& driver = model.drivers[choice.driver];
    if (driver.waits && !device.io_thread)
      diagnostics.error(device.position,
                        "driver " + quote(driver.name) + " of device " + quote(device.name) +
                            " waits, and the device has no IO thread",
                        "add io_thread = true, or choose a driver that does not wait");
    if (driver.bus_interface && !device.partial) {
      const std::string& bus = model.interfaces[*driver.bus_interface].class_name;
      if (!device.bus)
        diagnostics.error(
            device.position,
            "driver " + quote(driver.name) + " of device " + quote(device.name) + " needs a bus",
            "add on = \"NAME\", a device with the interface " + bus);
      else if (model.devices[*device.bus].interface != *driver.bus_interface)
        diagnostics.error(device.position,
                          "driver " + quote(driver.name) + " of device " + quote(device.name) + " needs a " +
                              bus + ", but " + quote(model.devices[*device.bus].name) + " is a " +
                              model.interfaces[model.devices[*device.bus].interface].class_name,
                          "put it on a bus of that kind; the bus is declared at " +
                              to_string(model.devices[*device.bus].position));
    }
  }
}

// Told once, at the first row of the circle.
void check_bus_circle(const Model& model, Index first, Diagnostics& diagnostics) {
  std::string way;
  auto bus = model.devices[first].bus;
  for (std::size_t steps = 0; bus && *bus >= first && steps < model.devices.size(); ++steps) {
    const Device& device = model.devices[*bus];
    if (*bus == first) {
      diagnostics.error(
          device.position,
          "bus " + quote(device.name) + " carries itself" + (way.empty() ? "" : ", through" + way),
          "remove 'on' from one of them");
      return;
    }
    way += " " + quote(device.name);
    bus = device.bus;
  }
}

// Without an IO thread a bus is served by the one thread in which all live that are on it.
void check_bus_threads(const Model& model, const Device& bus, Diagnostics& diagnostics) {
  if (bus.io_thread || bus.children.empty()) return;
  const Device* first = nullptr;
  for (const Index index : bus.children) {
    const Device& child = model.devices[index];
    if (!child.thread) continue;
    if (first == nullptr) first = &child;
    if (child.thread == first->thread) continue;
    diagnostics.error(
        child.position,
        "devices " + quote(first->name) + " and " + quote(child.name) + " on bus " + quote(bus.name) +
            " are in different threads: " + quote(model.threads[*first->thread].name) + " and " +
            quote(model.threads[*child.thread].name),
        "put their units into one thread, or give the bus an IO thread with io_thread = true at " +
            to_string(bus.position));
  }
}

/// Where a device is, by one of the drivers that its row permits: on its bus a number or a line's name; of
/// the machine a real driver's file or interface.
struct Address {
  std::string value;
  std::string name;  // of the parameter
};

// A line's offset has several spellings: "3", "#3", "#03".
std::string plain_address(std::string_view text) {
  std::string_view digits = text.substr(text.starts_with('#') ? 1 : 0);
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos)
    return std::string(text);
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  return "#" + std::string(digits);
}

void take_addresses(const ParameterBlock& block, const std::vector<Literal>& values,
                    std::vector<Address>& addresses) {
  const auto take = [&](const Parameter& parameter, const Literal& literal) {
    const auto* number = std::get_if<std::int64_t>(&literal.value);
    const auto* text = std::get_if<std::string>(&literal.value);
    if (number != nullptr && *number != 0)
      addresses.push_back({std::to_string(*number), parameter.field.name});
    if (text != nullptr && !text->empty())
      addresses.push_back({quote(plain_address(*text)), parameter.field.name});
  };
  for (std::size_t i = 0; i < block.parameters.size() && i < values.size(); ++i) {
    if (!block.parameters[i].address) continue;
    take(block.parameters[i], values[i]);
    // An array's default has numbers for more than there are, as for joints.
    const Position& set = values[i].position;
    const Position& initial = block.parameters[i].initial.position;
    if (set.file == initial.file && set.line == initial.line) continue;
    for (const Literal& element : values[i].elements) take(block.parameters[i], element);
  }
}

std::vector<Address> addresses_of(const Model& model, const Device& device, const DriverChoice& choice,
                                  bool on_bus) {
  const Driver& driver = model.drivers[choice.driver];
  std::vector<Address> addresses;
  if (driver.bus_interface.has_value() != on_bus) return addresses;
  if (!on_bus && driver.kind != Driver::Kind::real) return addresses;
  take_addresses(model.interfaces[device.interface].configuration, device.configuration, addresses);
  take_addresses(driver.configuration, choice.configuration, addresses);
  return addresses;
}

// Two that answer to one address are led as if they were one, whichever of their drivers are chosen. Told
// once of a device. `bus`: null where none is between them and the machine.
void check_addresses(const Model& model, const std::vector<const Device*>& devices, const Device* bus,
                     Diagnostics& diagnostics) {
  const std::string on_bus = bus != nullptr ? " on bus " + quote(bus->name) : "";
  std::map<std::string, const Device*> taken;
  for (const Device* device : devices) {
    const Device& child = *device;
    std::map<std::string, std::string> own;
    std::optional<Address> doubled;
    for (const DriverChoice& choice : child.drivers) {
      std::set<std::string> of_driver;
      for (const Address& address : addresses_of(model, child, choice, bus != nullptr)) {
        own.emplace(address.value, address.name);
        if (!of_driver.insert(address.value).second) doubled = address;
      }
    }
    if (doubled) {
      diagnostics.error(child.position,
                        "the address " + doubled->value + " (" + quote(doubled->name) + ") of device " +
                            quote(child.name) + " is there twice",
                        "give each its own, as it is on the device");
      continue;
    }
    for (const auto& [value, name] : own) {
      const auto [other, fresh] = taken.emplace(value, &child);
      if (fresh) continue;
      diagnostics.error(child.position,
                        "the address " + value + " (" + quote(name) + ") of device " + quote(child.name) +
                            on_bus + " is that of " + quote(other->second->name) + ", too",
                        "give each its own, as it is on the device; the other one is at " +
                            to_string(other->second->position));
      break;
    }
  }
}

void check_restart(const Model& model, const Unit& unit, Diagnostics& diagnostics) {
  if (unit.restart == Unit::Restart::never) return;
  for (const auto& index : unit.devices) {
    if (!index) continue;
    const Device& device = model.devices[*index];
    for (const DriverChoice& choice : device.drivers) {
      const Driver& driver = model.drivers[choice.driver];
      if (driver.kind != Driver::Kind::real || !driver.actuates) continue;
      const InInstance instance(diagnostics, model, unit.name);
      diagnostics.error(unit.position,
                        "unit " + quote(unit.name) + " must not restart by itself: its device " +
                            quote(device.name) + " can be a real actuator (driver " + quote(driver.name) +
                            ")",
                        "remove 'restart': a person starts it again");
      return;
    }
  }
}

void check_autostart(const Model& model, Diagnostics& diagnostics) {
  if (!model.application->autostart) return;
  for (const Device& device : model.devices)
    for (const DriverChoice& choice : device.drivers) {
      const Driver& driver = model.drivers[choice.driver];
      if (driver.kind == Driver::Kind::real && driver.actuates)
        diagnostics.warning(device.position,
                            "with autostart, device " + quote(device.name) +
                                " may move right after power-on (driver " + quote(driver.name) + ")",
                            "remove autostart = true, so that a person gives the start");
    }
}

}  // namespace

void check_devices(const Model& model, Diagnostics& diagnostics) {
  const auto owners = owners_by_device(model);
  for (Index index = 0; index < model.devices.size(); ++index) {
    const Device& device = model.devices[index];
    const auto found = owners.find(index);
    if (!device.partial)
      check_owners(model, device, found != owners.end() ? found->second : std::vector<Owner>{}, diagnostics);
    const InInstance instance(diagnostics, model, device.name);
    check_io_thread(model, device, diagnostics);
    check_drivers(model, device, diagnostics);
    check_bus_circle(model, index, diagnostics);
    check_bus_threads(model, device, diagnostics);
    std::vector<const Device*> children;
    for (const Index child : device.children) children.push_back(&model.devices[child]);
    check_addresses(model, children, &device, diagnostics);
  }
  std::vector<const Device*> all;
  for (const Device& device : model.devices) all.push_back(&device);
  check_addresses(model, all, nullptr, diagnostics);
  for (const Unit& unit : model.units) check_restart(model, unit, diagnostics);
  check_autostart(model, diagnostics);
}

}  // namespace flexrf::config_gen
