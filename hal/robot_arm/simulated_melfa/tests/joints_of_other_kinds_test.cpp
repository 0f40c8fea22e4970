// A controller's joints turn, and have ends: others are refused before anything is sent to it.
#include <cstring>
#include <memory>

#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/simulated_melfa/simulated_melfa.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

bool refused_with(JointKind kind, const char* words) {
  static KinematicChain chain;
  chain = six_axis;
  chain.joints[1].kind = kind;
  const auto bench = std::make_unique<DeviceBench<SimulatedMelfa>>(&chain);
  const Status status = bench->driver().initialise();
  return !status.is_ok() && std::strstr(status.cause(), words) != nullptr;
}

void sliding_joints_are_refused(void**) {
  const bool refused = refused_with(JointKind::prismatic, "joint axis_2 slides");
  assert_true(refused);
}
void joints_without_end_are_refused(void**) {
  const bool refused = refused_with(JointKind::continuous, "joint axis_2 turns without end");
  assert_true(refused);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(sliding_joints_are_refused),
      cmocka_unit_test(joints_without_end_are_refused),
  };
  return cmocka_run_group_tests_name("MELFA: joints of other kinds", tests, nullptr, nullptr);
}
