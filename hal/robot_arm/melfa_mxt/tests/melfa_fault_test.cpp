#include "hal/robot_arm/melfa_mxt/tests/loopback_world.hpp"
#include "hal/robot_arm/melfa_mxt/tests/melfa_faults.hpp"

int main() {
  return flexrf::run_melfa_faults(
      "faults of a MELFA arm over UDP",
      []() -> std::unique_ptr<flexrf::MelfaWorld> { return std::make_unique<flexrf::LoopbackWorld>(); });
}
