#include "runtime/executive/driver_choice.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

namespace flexrf {
namespace {

std::optional<DriverKind> kind_named(std::string_view word) noexcept {
  for (const DriverKind kind : {DriverKind::mock, DriverKind::simulated, DriverKind::real}) {
    if (word == name_of(kind)) return kind;
  }
  return std::nullopt;
}

std::optional<std::uint16_t> find_driver(const DeviceRecord& device, std::string_view wanted) noexcept {
  for (std::size_t i = 0; i < device.drivers.size(); ++i) {
    const DriverRecord& driver = device.drivers[i];
    if (wanted == driver.name || wanted == name_of(driver.kind)) return static_cast<std::uint16_t>(i);
  }
  if (const auto kind = kind_named(wanted); kind) {
    const std::uint8_t instead = device.instead[static_cast<std::size_t>(*kind)];
    if (instead != no_driver) return instead;
  }
  return std::nullopt;
}

bool is_chosen_by_option(const DriverRecord& driver, const OptionValues& values) noexcept {
  return std::any_of(driver.options.begin(), driver.options.end(),
                     [&](const Option& option) { return option.chooses && values.has(option.name); });
}

Status check_virtual_time(const DeviceRecord& device, const DriverRecord& driver) {
  if (driver.virtual_time) return {};
  std::string able;
  for (const DriverRecord& other : device.drivers) {
    if (other.virtual_time) able += (able.empty() ? "" : ", ") + std::string{other.name};
  }
  return Status::error(
      StatusCode::invalid_argument,
      "--virtual-time: device `%s`: driver `%s` waits for the real world and cannot live in "
      "virtual time; %s%s",
      device.name, driver.name,
      able.empty() ? "no driver of this device can" : "choose --hardware with one of: ", able.c_str());
}

}  // namespace

Result<std::vector<const DriverRecord*>> choose_drivers(const Application& application,
                                                        const Options& options) {
  std::vector<const DriverRecord*> drivers;
  // The kind that was asked for, of all devices, and those that have no driver of it.
  std::string kind;
  std::string without;
  for (const DeviceRecord& device : application.devices) {
    std::uint16_t chosen = 0;
    std::string lacks;
    const auto choose = [&](std::string_view wanted) {
      if (const auto found = find_driver(device, wanted); found) {
        chosen = *found;
        lacks.clear();
      } else if (kind_named(wanted)) {
        lacks = wanted;
      }
    };
    // An option may imply the driver that reads it; what --hardware says comes after and wins.
    for (const DriverRecord& driver : device.drivers) {
      if (is_chosen_by_option(driver, options.values())) choose(driver.name);
    }
    for (const HardwareChoice& choice : options.hardware) {
      if (choice.device.empty() || choice.device == device.name) choose(choice.driver);
    }
    if (!lacks.empty()) {
      kind = lacks;
      without += (without.empty() ? "" : ", ") + std::string{device.name};
    }
    drivers.push_back(&device.drivers[chosen]);
    if (!options.virtual_time) continue;
    if (const Status status = check_virtual_time(device, *drivers.back()); !status) return status;
  }
  if (without.empty()) return drivers;
  return Status::error(StatusCode::invalid_argument,
                       "--hardware %s: these devices have no such driver: %.100s; name one for each, as "
                       "`--hardware %s,DEVICE=DRIVER`, "
                       "or say in its table `instead = { %s = \"DRIVER\" }`",
                       kind.c_str(), without.c_str(), kind.c_str(), kind.c_str());
}

std::string hardware_text(const Application& application, std::span<const DriverRecord* const> drivers) {
  std::string text;
  for (std::size_t i = 0; i < drivers.size(); ++i)
    text += (i == 0 ? "" : ",") + std::string{application.devices[i].name} + '=' + drivers[i]->name;
  return text;
}

}  // namespace flexrf
