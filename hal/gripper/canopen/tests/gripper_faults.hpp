// What goes wrong between a gripper that is an axis and its driver: cases that are run on a simulated bus in
// virtual time, and on a real one against a simulator in another process.
#pragma once

#include <memory>

#include "hal/gripper/canopen/tests/axis_gripper_world.hpp"

namespace flexrf {

using MakeAxisGripperWorld = std::unique_ptr<AxisGripperWorld> (*)(const FingerAxis&);

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_gripper_faults(const char* where, MakeAxisGripperWorld make);

}  // namespace flexrf
