// The unit with the simulated arm, cycle by cycle as its thread would run it.
#include "units/robot_control/robot_control.hpp"

#include <algorithm>
#include <cmath>

#include "hal/interfaces/device_bench.hpp"
#include "hal/interfaces/robot_arm/pose_conversion.hpp"
#include "hal/simulated/simulated_arm/simulated_arm.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;

constexpr Duration cycle = std::chrono::milliseconds(7);
constexpr double cycle_seconds = 0.007;

struct World {
  DeviceBench<SimulatedArm> arm{&six_axis};
  UnitBench<RobotControl> bench;
  SlotBench<Pose> target;
  SlotBench<Pose> pose;
  SlotBench<JointState> joints;
  InputBinding inputs[1] = {target.input(std::chrono::milliseconds(500))};
  SlotControl* outputs[2] = {&pose.control(), &joints.control()};
  Device* device = &arm.driver();
  Device* const* devices[1] = {&device};
  Pose wanted{};
  bool target_lives = true;

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.devices = devices;
    bench.unit().connect(binding);
    arm.configuration().noise = 0;
    ready = arm.driver().initialise().is_ok() && bench.unit().initialise().is_ok();
    wanted = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
  }

  // As jog and the thread do: the target every cycle, receive, step, send.
  void run(double duration) {
    for (double time = 0; time < duration; time += cycle_seconds) {
      if (target_lives) target.publish(wanted, bench.now());
      arm.receive(cycle);
      bench.step(cycle);
      arm.send();
      watch();
    }
  }
  // Set-points must never jump, whatever happens.
  void watch() {
    const JointVector now = bench.feedback().set_point_map();
    if (watching) {
      for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
        const auto index = static_cast<Eigen::Index>(i);
        const double velocity = std::abs(now[index] - last[index]) / cycle_seconds;
        worst = std::max(worst, velocity / six_axis.joints[i].velocity);
      }
    }
    last = now;
    watching = true;
  }
  bool at(double x, double y, double z, double tolerance = 1e-3) {
    const auto now = pose.latest();
    const Pose home = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
    return now && std::abs(now->position[0] - home.position[0] - x) < tolerance &&
           std::abs(now->position[1] - home.position[1] - y) < tolerance &&
           std::abs(now->position[2] - home.position[2] - z) < tolerance;
  }
  bool holding(const char* text) {
    return bench.feedback().holding_view().find(text) != std::string_view::npos;
  }
  bool smooth() const { return worst <= 1.0 + 1e-9; }

  bool ready = false;
  bool watching = false;
  JointVector last = JointVector::Zero();
  double worst = 0;
};

bool moves_to_the_target() {
  World world;
  world.run(0.1);
  if (!world.at(0, 0, 0) || !world.bench.unit().is_idle() || world.bench.feedback().motions != 1)
    return false;
  world.wanted.position[0] += 0.04;
  world.wanted.position[1] -= 0.03;
  world.run(0.05);
  if (world.bench.unit().is_idle() || !world.bench.feedback().moving) return false;
  world.run(2.0);
  return world.at(0.04, -0.03, 0) && world.bench.unit().is_idle() && world.holding("") &&
         world.bench.feedback().motions == 2 && world.smooth() && world.joints.latest().has_value();
}

// Targets that came during a motion are passed over but for the last.
bool takes_the_latest_when_finished() {
  World world;
  world.run(0.1);
  for (int press = 0; press < 20; ++press) {
    world.wanted.position[2] -= 0.01;
    world.run(cycle_seconds);
  }
  world.run(3.0);
  return world.at(0, 0, -0.2) && world.bench.feedback().motions < 10 && world.smooth();
}

bool refuses_what_it_cannot_reach() {
  World world;
  world.run(0.1);
  world.wanted.position[0] += 3;
  world.run(0.5);
  if (!world.at(0, 0, 0) || !world.holding("refused") || !world.bench.unit().is_idle()) return false;
  world.wanted.position[0] = NAN;
  world.run(0.5);
  if (!world.at(0, 0, 0) || !world.holding("not a pose")) return false;
  world.wanted.position[0] =
      to_pose(forward_kinematics(six_axis, home_position(six_axis))).position[0] + 0.02;
  world.run(1.5);
  return world.at(0.02, 0, 0) && world.smooth();
}

// Stops within the limits, stays, and goes on when the target is there again.
bool holds_when_the_target_is_late() {
  World world;
  world.bench.runtime().speed = 0.1;
  world.run(0.1);
  world.wanted.position[2] -= 0.4;
  world.run(0.2);
  world.target_lives = false;
  world.run(0.45);
  if (!world.bench.feedback().moving) return false;  // not late yet
  world.run(1.5);
  if (world.bench.feedback().moving || !world.holding("old") || world.at(0, 0, -0.4)) return false;
  const auto held = world.pose.latest();
  world.run(0.5);
  const auto still = world.pose.latest();
  if (!held || !still || std::abs(held->position[2] - still->position[2]) > 1e-6) return false;
  world.bench.runtime().speed = 1;
  world.target_lives = true;
  world.run(3.0);
  return world.at(0, 0, -0.4) && world.smooth();
}

bool holds_when_the_writer_faults() {
  World world;
  world.run(0.1);
  world.wanted.position[2] -= 0.4;
  world.run(0.15);
  world.target.control().set_writer_state(WriterState::faulted);
  world.target_lives = false;
  world.run(1.0);
  return !world.at(0, 0, -0.4, 0.01) && !world.bench.feedback().moving && world.bench.unit().is_idle() &&
         world.holding("fault") && world.smooth();
}

bool a_stop_request_brings_it_to_rest() {
  World world;
  world.run(0.1);
  world.wanted.position[2] -= 0.4;
  world.run(0.15);
  world.bench.tick().stop_requested = true;
  world.run(1.0);
  return world.bench.unit().is_idle() && !world.at(0, 0, -0.4, 0.01) && world.smooth();
}

// A target from before the Start is not followed after it.
bool starts_from_where_the_arm_is() {
  World world;
  world.bench.tick().motion_inhibited = true;
  world.arm.driver().set_inhibited(true);
  world.wanted.position[2] -= 0.2;
  world.run(0.5);
  if (!world.at(0, 0, 0)) return false;
  world.bench.tick().motion_inhibited = false;
  world.arm.driver().set_inhibited(false);
  world.run(1.0);
  if (!world.at(0, 0, 0)) return false;
  world.wanted.position[2] += 0.1;
  world.run(2.0);
  return world.at(0, 0, -0.1) && world.smooth();
}

bool waits_for_the_arms_sensors() {
  World world;
  world.arm.driver().inject(SimulatedArm::Fault::sensors_lost);
  world.run(0.3);
  return !world.pose.latest() && world.holding("no joint positions") && world.bench.unit().is_idle();
}

bool stops_without_sensors() {
  World world;
  world.run(0.1);
  world.wanted.position[2] -= 0.4;
  world.run(0.15);
  world.arm.driver().inject(SimulatedArm::Fault::sensors_lost);
  world.run(1.0);
  return !world.bench.feedback().moving && world.holding("no longer tells") && world.smooth();
}

// A cycle that comes half a second late delays the motion.
bool a_late_cycle_is_no_jump() {
  World world;
  world.run(0.1);
  world.wanted.position[2] -= 0.4;
  world.run(0.2);
  const JointVector before = world.bench.feedback().set_point_map();
  world.target.publish(world.wanted, world.bench.now() + std::chrono::milliseconds(500));
  world.arm.receive(std::chrono::milliseconds(500));
  world.bench.step(std::chrono::milliseconds(500));
  world.arm.send();
  const JointVector after = world.bench.feedback().set_point_map();
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    if (std::abs(after[index] - before[index]) > 0.02 * six_axis.joints[i].velocity) return false;
  }
  world.last = after;
  world.run(3.0);
  return world.at(0, 0, -0.4);
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      {"moves to the target", passes<moves_to_the_target>, nullptr, nullptr, nullptr},
      {"takes the latest when finished", passes<takes_the_latest_when_finished>, nullptr, nullptr, nullptr},
      {"refuses what it cannot reach", passes<refuses_what_it_cannot_reach>, nullptr, nullptr, nullptr},
      {"holds when the target is late", passes<holds_when_the_target_is_late>, nullptr, nullptr, nullptr},
      {"holds when its writer faults", passes<holds_when_the_writer_faults>, nullptr, nullptr, nullptr},
      {"a stop request brings it to rest", passes<a_stop_request_brings_it_to_rest>, nullptr, nullptr,
       nullptr},
      {"starts from where the arm is", passes<starts_from_where_the_arm_is>, nullptr, nullptr, nullptr},
      {"waits for the arm's sensors", passes<waits_for_the_arms_sensors>, nullptr, nullptr, nullptr},
      {"stops without sensors", passes<stops_without_sensors>, nullptr, nullptr, nullptr},
      {"a late cycle is no jump", passes<a_late_cycle_is_no_jump>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
