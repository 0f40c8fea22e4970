// What goes wrong between a PC and a MELFA controller, over UDP: what the operator reads, what the arm does,
// and that it goes on when the cause is gone.
#pragma once

#include <memory>

#include "hal/robot_arm/melfa_mxt/tests/melfa_controller.hpp"
#include "hal/robot_arm/melfa_mxt/tests/melfa_world.hpp"

namespace flexrf {

using MakeMelfaWorld = std::unique_ptr<MelfaWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_melfa_faults(const char* where, MakeMelfaWorld make);

/// There in the end.
bool arrives(MelfaWorld& world);
/// While it was led nothing came any more, and the operator reads why that may be.
bool has_fault_of_silence(MelfaWorld& world);

}  // namespace flexrf
