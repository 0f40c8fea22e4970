// The unit with the simulated arm, cycle by cycle as its thread would run it.
#include <cmath>

#include "tests/cmocka.hpp"
#include "units/robot_control/tests/robot_world.hpp"

namespace flexrf::robot_control_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;

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
  // Once for each target; whoever made it learns where to go on from, and the first cause stays to be read.
  if (world.bench.feedback().refusals != 2) return false;
  if (world.bench.feedback().first_refusal_view().find("m refused: ") == std::string_view::npos) return false;
  const auto said = world.answer.latest();
  if (!said || said->accepted || std::abs(said->kept.position[0] - world.home_x()) > 1e-3) return false;
  world.wanted = said->kept;
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
// [stop-3]
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
  world.run(0.05);
  const auto before = world.led_by.latest();
  const bool is_told = world.holding("no longer tells") && before && !before->in_fault;
  world.run(1.0);
  const auto after = world.led_by.latest();
  return is_told && !world.bench.feedback().moving && world.holding("the arm is in fault: ") && after &&
         after->in_fault && world.smooth();
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

// Where the set-points have the tool, without the servos' lag.
Eigen::Vector3d commanded(World& world) {
  return world.tool().translation();
}

bool a_hand_moves_the_tool_on_a_straight_line() {
  World world;
  world.run(0.1);
  const Eigen::Vector3d begin = commanded(world);
  world.hand[1] = -0.1;
  world.run(1.0);
  const Eigen::Vector3d middle = commanded(world);
  world.run(1.0);
  const Eigen::Vector3d end = commanded(world);
  if (std::abs((end - middle).y() + 0.1) > 1e-3 || !world.bench.feedback().moving) return false;
  if (std::abs((end - begin).x()) > 1e-5 || std::abs((end - begin).z()) > 1e-5) return false;
  // No faster than is allowed.
  world.hand[1] = 0;
  world.hand[0] = -3;
  world.run(1.0);
  const Eigen::Vector3d before = commanded(world);
  world.run(cycle_seconds * 10);
  const double speed = (commanded(world) - before).norm() / (cycle_seconds * 10);
  return speed < 0.25 + 1e-3 && world.smooth();
}

// From the cycle in which the hand is gone, each cycle is slower than the one before.
bool begins_to_rest_at_once(World& world) {
  world.run(0.1);
  world.hand[2] = -0.1;
  world.run(1.0);
  Eigen::Vector3d last = commanded(world);
  world.run(cycle_seconds);
  double speed = (commanded(world) - last).norm();
  const Eigen::Vector3d begin = commanded(world);
  world.hand[2] = 0;
  for (int cycles = 0; world.bench.feedback().moving; ++cycles) {
    if (cycles > 40) return false;  // 0.1 m/s at 0.5 m/s^2
    last = commanded(world);
    world.run(cycle_seconds);
    const double slower = (commanded(world) - last).norm();
    if (slower > speed - 1e-6) return false;
    speed = slower;
  }
  if ((commanded(world) - begin).norm() > 0.012) return false;
  // The target from before is not gone back to; a new one is followed.
  const Eigen::Vector3d rest = commanded(world);
  world.run(1.0);
  if ((commanded(world) - rest).norm() > 1e-9 || !world.bench.unit().is_idle()) return false;
  world.wanted.position[0] -= 0.02;
  world.run(2.0);
  return world.at(-0.02, 0, 0) && world.smooth();
}

bool it_rests_when_the_hand_is_gone() {
  World world;
  return begins_to_rest_at_once(world);
}

bool it_rests_when_nobody_tells_of_the_hand() {
  World world;
  world.run(0.1);
  world.hand[2] = -0.1;
  world.run(1.0);
  world.hand_lives = false;
  world.run(0.1 + 0.2 + 0.05);  // too old, come to rest
  return !world.bench.feedback().moving && world.bench.unit().is_idle() && world.smooth();
}

bool a_hand_takes_over_from_a_motion_on_its_path() {
  World world;
  world.run(0.1);
  const Eigen::Vector3d begin = commanded(world);
  world.wanted.position[2] -= 0.3;
  world.run(0.05);
  world.hand[0] = -0.1;
  world.run(2.0);
  // It came to rest early, and then went where the hand wanted.
  const Eigen::Vector3d way = commanded(world) - begin;
  return world.bench.feedback().moving && way.x() < -0.1 && way.z() < 0 && way.z() > -0.2 && world.smooth();
}

bool a_stop_request_ends_what_a_hand_holds() {
  World world;
  world.run(0.1);
  world.hand[0] = -0.1;
  world.run(0.5);
  world.bench.tick().stop_requested = true;
  world.run(0.5);
  return world.bench.unit().is_idle() && world.holding("stop requested") && world.smooth();
}

bool a_hand_stays_within_reach() {
  World world;
  world.run(0.1);
  world.hand[0] = 0.25;
  world.run(10.0);
  if (!world.holding("cannot go on") || !world.smooth()) return false;
  world.hand[0] = -0.25;
  world.run(1.0);
  return world.holding("") && world.bench.feedback().moving && world.smooth();
}

/// In cycles in which the arm tells nothing new, what it told last grows old.
bool publishes_when_the_arm_measured() {
  World world;
  world.run(0.1);
  const Time measured = world.arm.now();
  for (int cycles = 0; cycles < 3; ++cycles) world.bench.step(cycle);
  const bool is_told = world.pose.latest() && world.joints.latest();
  return world.ready && is_told && world.bench.now() > measured && world.pose.sampled_at() == measured &&
         world.joints.sampled_at() == measured;
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::robot_control_test

int main() {
  using namespace flexrf::robot_control_test;
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
      {"a hand moves the tool straight", passes<a_hand_moves_the_tool_on_a_straight_line>, nullptr, nullptr,
       nullptr},
      {"rests when the hand is gone", passes<it_rests_when_the_hand_is_gone>, nullptr, nullptr, nullptr},
      {"rests when nobody tells", passes<it_rests_when_nobody_tells_of_the_hand>, nullptr, nullptr, nullptr},
      {"a hand takes over", passes<a_hand_takes_over_from_a_motion_on_its_path>, nullptr, nullptr, nullptr},
      {"a stop request ends a hand's motion", passes<a_stop_request_ends_what_a_hand_holds>, nullptr, nullptr,
       nullptr},
      {"publishes when the arm measured", passes<publishes_when_the_arm_measured>, nullptr, nullptr, nullptr},
      {"a hand stays within reach", passes<a_hand_stays_within_reach>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
