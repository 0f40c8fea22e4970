// The pose stream: who follows it when, and that the arm holds when the camera that makes it is lost.
#include <cmath>
#include <string_view>

#include "tests/cmocka.hpp"
#include "units/robot_control/tests/robot_world.hpp"

namespace flexrf::robot_servo_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;
using Eigen::Vector3d;

ServoTarget beside_home(double x, double y, double z, double yaw = 0) {
  Eigen::Isometry3d pose = forward_kinematics(six_axis, home_position(six_axis));
  pose.translation() += Vector3d(x, y, z);
  pose.linear() = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix() * pose.linear();
  return {.valid = true, .pose = to_pose(pose)};
}

/// In automatic mode, at home, with nobody who makes targets.
struct Cell : World {
  Cell() : World(true) {
    target_lives = false;
    inputs[0] = {};
    connect();
    hand_lives = false;
    run(0.05);
    chosen = choose(ControlMode::automatic);
  }
  void connect() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.devices = devices;
    bench.unit().connect(binding);
  }
  Status chosen;
};

bool follows_a_goal_that_moves() {
  Cell cell;
  if (!cell.chosen || !cell.holding("has not begun")) return false;
  for (int k = 0; k < 60; ++k) {  // a picture every 35 ms
    cell.stream = beside_home(0, -0.002 * k, -0.001 * k, 0.005 * k);
    cell.run(5 * cycle_seconds - 1e-6);
    if (cell.bench.feedback().activity != RobotActivity::servo) return false;
  }
  cell.run(1.5);
  const Eigen::Isometry3d goal = to_isometry(cell.stream->pose);
  return (cell.tool().matrix() - goal.matrix()).norm() < 1e-6 && cell.at(0, -0.118, -0.059) &&
         cell.smooth() && cell.fastest_tool < 0.5 && cell.bench.feedback().holding_view().empty();
}

/// From the moment on it comes to rest and holds; it says why; and goes on when it is back.
bool holds_when(void (*lose)(Cell&), const char* reason) {
  Cell cell;
  cell.stream = beside_home(0, 0.3, 0);
  cell.run(0.6);
  if (cell.bench.feedback().tool_speed < 0.1) return false;
  lose(cell);
  cell.run(0.15 + 0.6);
  if (cell.bench.feedback().moving || !cell.holding(reason) || !cell.holding("the arm holds")) return false;
  const Eigen::Isometry3d rest = cell.tool();
  cell.run(1.0);
  if (cell.tool().matrix() != rest.matrix() || !cell.bench.unit().is_idle()) return false;
  cell.servo.control().set_writer_state(WriterState::running);
  cell.stream = beside_home(0, 0.3, 0);
  cell.run(3.0);
  return cell.at(0, 0.3, 0) && cell.smooth();
}

bool holds_when_no_more_comes() {
  return holds_when([](Cell& cell) { cell.stream.reset(); }, "too old");
}
bool holds_when_nothing_is_seen() {
  return holds_when([](Cell& cell) { cell.stream->valid = false; }, "nowhere to go");
}
bool holds_when_its_maker_faults() {
  return holds_when(
      [](Cell& cell) {
        cell.stream.reset();
        cell.servo.control().set_writer_state(WriterState::faulted);
      },
      "in fault");
}
bool holds_when_it_is_no_pose() {
  return holds_when([](Cell& cell) { cell.stream->pose.position[1] = NAN; }, "no pose");
}

bool out_of_reach_is_told() {
  Cell cell;
  cell.stream = beside_home(2, 0, 0);
  cell.run(8.0);
  if (cell.bench.feedback().moving || !cell.holding("cannot go on")) return false;
  cell.restraint();
  cell.run(cycle_seconds / 2);
  return cell.restraint().reason != nullptr && cell.smooth();
}

bool manual_does_not_follow_it_and_says_so() {
  Cell cell;
  if (!cell.choose(ControlMode::manual)) return false;
  cell.stream = beside_home(0, 0.2, 0);
  cell.run(0.5);
  if (!cell.at(0, 0, 0) || !cell.holding("pose stream is not followed in manual")) return false;
  if (cell.restraint().reason == nullptr) return false;
  // A hand moves it all the same.
  cell.bench.runtime().plus_z = true;
  cell.run(0.5);
  return cell.bench.feedback().activity == RobotActivity::jog && cell.bench.feedback().moving &&
         cell.smooth();
}

// Without a switch of the mode a hand goes before it; and it goes before targets, which are not gone back to.
bool has_its_place_among_the_others() {
  World world(true);
  world.run(0.1);
  world.wanted.position[2] -= 0.2;
  world.run(0.1);
  world.stream = beside_home(0, 0.1, 0);
  world.run(3.0);
  if (!world.at(0, 0.1, 0) || world.bench.feedback().activity != RobotActivity::servo) return false;
  world.hand[0] = -0.1;
  world.run(1.0);
  if (world.bench.feedback().activity != RobotActivity::jog || world.at(0, 0.1, 0, 0.03)) return false;
  world.hand[0] = 0;
  world.run(2.0);
  if (!world.at(0, 0.1, 0)) return false;
  world.stream->valid = false;
  world.run(2.0);
  if (!world.at(0, 0.1, 0)) return false;
  world.wanted.position[2] += 0.1;
  world.run(3.0);
  return world.at(0, 0, -0.1) && world.smooth();
}

// Who makes the stream has to know when a hand is at the arm.
bool tells_who_leads() {
  Cell cell;
  cell.stream = beside_home(0, 0.1, 0);
  cell.run(0.3);
  auto said = cell.led_by.latest();
  if (!said || said->activity != RobotActivity::servo || !said->moving) return false;
  cell.run(2.0);
  said = cell.led_by.latest();
  if (!said || said->moving || said->mode != ControlMode::automatic) return false;
  if (!cell.choose(ControlMode::shared)) return false;
  cell.bench.runtime().plus_z = true;
  cell.run(0.3);
  said = cell.led_by.latest();
  if (!said || said->activity != RobotActivity::jog || !said->moving) return false;
  cell.bench.runtime().plus_z = false;
  cell.run(2.0);
  if (!cell.choose(ControlMode::manual)) return false;
  cell.run(0.1);
  said = cell.led_by.latest();
  return said && said->mode == ControlMode::manual &&
         std::string_view{said->holding.data()}.find("not followed in manual") != std::string_view::npos;
}

bool a_stop_brakes_it() {
  Cell cell;
  cell.stream = beside_home(0, 0.3, 0);
  cell.run(0.5);
  cell.bench.tick().stop_requested = true;
  cell.run(0.6);
  if (!cell.bench.unit().is_idle() || !cell.holding("stop requested") || cell.at(0, 0.3, 0, 0.01))
    return false;
  cell.bench.tick().stop_requested = false;
  cell.run(3.0);
  return cell.at(0, 0.3, 0) && cell.smooth();
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::robot_servo_test

int main() {
  using namespace flexrf::robot_servo_test;
  const CMUnitTest tests[] = {
      {"follows a goal that moves", passes<follows_a_goal_that_moves>, nullptr, nullptr, nullptr},
      {"holds when no more comes", passes<holds_when_no_more_comes>, nullptr, nullptr, nullptr},
      {"holds when nothing is seen", passes<holds_when_nothing_is_seen>, nullptr, nullptr, nullptr},
      {"holds when its maker faults", passes<holds_when_its_maker_faults>, nullptr, nullptr, nullptr},
      {"holds when it is no pose", passes<holds_when_it_is_no_pose>, nullptr, nullptr, nullptr},
      {"out of reach is told", passes<out_of_reach_is_told>, nullptr, nullptr, nullptr},
      {"manual does not follow it", passes<manual_does_not_follow_it_and_says_so>, nullptr, nullptr, nullptr},
      {"its place among the others", passes<has_its_place_among_the_others>, nullptr, nullptr, nullptr},
      {"tells who leads", passes<tells_who_leads>, nullptr, nullptr, nullptr},
      {"a stop brakes it", passes<a_stop_brakes_it>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
