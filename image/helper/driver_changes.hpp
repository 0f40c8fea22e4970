// Which devices have another driver in another version.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexrf::helper {

/// A driver's name is empty where the version has no such device, or does not say which driver it has.
struct DriverChange {
  std::string device;
  std::string from;  ///< in the version that runs
  std::string to;    ///< in the other one
};

/// Compares the values of `drivers=` in two version files, which have the form that an application's
/// --drivers prints. First come the devices of the running version whose driver differs, in its order, then
/// new devices.
std::vector<DriverChange> driver_changes(std::string_view running, std::string_view other);
/// For a message: "axis_x: canopen -> simulated, valve: none -> gpio, and 7 more".
std::string text_of(const std::vector<DriverChange>& changes);

}  // namespace flexrf::helper
