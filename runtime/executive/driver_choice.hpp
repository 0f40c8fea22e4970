// Which driver each device has: the first that its row permits, unless the command line names another one.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "runtime/executive/application.hpp"
#include "runtime/executive/options.hpp"

namespace flexrf {

/// One driver for each device, in table order. invalid_argument: a device has no driver of the kind that was
/// asked for, or its driver cannot run in virtual time.
Result<std::vector<const DriverRecord*>> choose_drivers(const Application& application,
                                                        const Options& options);
/// The drivers in the form of --hardware: "axis_x=canopen,camera=v4l2". Empty: there are no devices.
std::string hardware_text(const Application& application, std::span<const DriverRecord* const> drivers);

}  // namespace flexrf
