#include "units/keyboard_robot/keyboard_robot.hpp"

#include <cmath>

#include "hal/driver/device_bench.hpp"
#include "hal/operator/keyboard/mock/mock_keyboard.hpp"
#include "hal/robot_arm/simulated/simulated_arm.hpp"
#include "motion/pose_conversion.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

constexpr Duration cycle = std::chrono::milliseconds(7);

struct World {
  DeviceBench<MockKeyboard> keyboard{nullptr};
  DeviceBench<SimulatedArm> arm{&six_axis};
  UnitBench<KeyboardRobot> bench;
  SlotBench<Pose> pose;
  SlotControl* outputs[1] = {&pose.control()};
  Device* keyboard_device = &keyboard.driver();
  Device* arm_device = &arm.driver();
  Device* const* devices[2] = {&keyboard_device, &arm_device};

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.outputs = outputs;
    binding.devices = devices;
    bench.unit().connect(binding);
    arm.configuration().noise = {};
    ready = arm.driver().initialise().is_ok() && bench.unit().initialise().is_ok();
  }
  void run(double duration) {
    for (double time = 0; time < duration; time += seconds(cycle)) {
      keyboard.receive(cycle);
      arm.receive(cycle);
      bench.step(cycle);
      arm.send();
    }
  }
  void press(const char* text) {
    for (; *text != '\0'; ++text)
      keyboard.driver().press({Key::character, static_cast<std::uint32_t>(*text)});
  }
  bool at(double x, double y, double z) {
    const auto now = pose.latest();
    const Pose home = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
    return now && std::abs(now->position[0] - home.position[0] - x) < 1e-3 &&
           std::abs(now->position[1] - home.position[1] - y) < 1e-3 &&
           std::abs(now->position[2] - home.position[2] - z) < 1e-3;
  }
  bool ready = false;
};

bool keys_move_the_arm() {
  World world;
  world.press("wwwwddd");
  world.run(0.02);
  if (world.bench.unit().is_idle()) return false;
  world.run(2.0);
  if (!world.at(0.04, -0.03, 0) || !world.bench.unit().is_idle()) return false;
  world.press("q");
  world.run(1.0);
  return world.at(0.04, -0.03, 0.01) && world.bench.feedback().presses == 8;
}

bool refuses_and_comes_back() {
  World world;
  world.bench.runtime().step = 0.1;
  world.press("wwwwwwwwwwwwww");
  world.run(0.5);
  if (!world.at(0, 0, 0) || world.bench.feedback().refusal_view().empty()) return false;
  // One press back is enough, however many led out of reach.
  world.press("s");
  world.run(2.0);
  return world.at(-0.1, 0, 0) && world.bench.feedback().refusal_view().empty() &&
         world.bench.feedback().refusals == 1;
}

// [stop-3]
bool keys_while_inhibited_are_forgotten() {
  World world;
  world.arm.driver().set_inhibited(true);
  world.bench.tick().motion_inhibited = true;
  world.press("www");
  world.run(0.2);
  world.arm.driver().set_inhibited(false);
  world.bench.tick().motion_inhibited = false;
  world.run(1.0);
  return world.at(0, 0, 0) && world.bench.unit().is_idle();
}

/// In cycles in which the arm tells nothing new, what it told last grows old.
bool publishes_when_the_arm_measured() {
  World world;
  world.run(0.1);
  const Time measured = world.arm.now();
  for (int cycles = 0; cycles < 3; ++cycles) world.bench.step(cycle);
  return world.ready && world.pose.latest() && world.bench.now() > measured &&
         world.pose.sampled_at() == measured;
}

void moves(void**) {
  assert_true(keys_move_the_arm());
}
void refuses(void**) {
  assert_true(refuses_and_comes_back());
}
void says_when(void**) {
  assert_true(publishes_when_the_arm_measured());
}
void forgets_while_inhibited(void**) {
  assert_true(keys_while_inhibited_are_forgotten());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(moves),
      cmocka_unit_test(refuses),
      cmocka_unit_test(forgets_while_inhibited),
      cmocka_unit_test(says_when),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
