#include "hal/robot_arm/melfa_mxt/tests/loopback_world.hpp"

int main() {
  using namespace flexrf;
  return run_robot_arm_conformance("MELFA arm over UDP", []() -> std::unique_ptr<RobotArmWorld> {
    return std::make_unique<MelfaConformanceWorld<LoopbackWorld>>();
  });
}
