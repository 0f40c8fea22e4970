// The unit's own arrows and steps, its modes, and the reduced speed of a hand.
#include <array>
#include <cmath>

#include "tests/cmocka.hpp"
#include "units/robot_control/tests/robot_world.hpp"

namespace flexrf::robot_jog_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;
using Eigen::Vector3d;
using Hold = bool RobotControlRuntime::*;
using Button = std::uint32_t RobotControlRuntime::*;

constexpr double reduced = 0.25;  // m/s

struct Arrow {
  Hold hold;
  Button step;
  int axis;  // 0 to 2: along, 3 to 5: about x, y, z
  double sign;
};
constexpr Arrow arrows[] = {
    {&RobotControlRuntime::plus_x, &RobotControlRuntime::step_plus_x, 0, 1},
    {&RobotControlRuntime::minus_x, &RobotControlRuntime::step_minus_x, 0, -1},
    {&RobotControlRuntime::plus_y, &RobotControlRuntime::step_plus_y, 1, 1},
    {&RobotControlRuntime::minus_y, &RobotControlRuntime::step_minus_y, 1, -1},
    {&RobotControlRuntime::plus_z, &RobotControlRuntime::step_plus_z, 2, 1},
    {&RobotControlRuntime::minus_z, &RobotControlRuntime::step_minus_z, 2, -1},
    {&RobotControlRuntime::plus_roll, &RobotControlRuntime::step_plus_roll, 3, 1},
    {&RobotControlRuntime::minus_roll, &RobotControlRuntime::step_minus_roll, 3, -1},
    {&RobotControlRuntime::plus_pitch, &RobotControlRuntime::step_plus_pitch, 4, 1},
    {&RobotControlRuntime::minus_pitch, &RobotControlRuntime::step_minus_pitch, 4, -1},
    {&RobotControlRuntime::plus_yaw, &RobotControlRuntime::step_plus_yaw, 5, 1},
    {&RobotControlRuntime::minus_yaw, &RobotControlRuntime::step_minus_yaw, 5, -1}};

struct JointArrow {
  Hold plus;
  Hold minus;
  Button step;
};
constexpr JointArrow joint_arrows[] = {
    {&RobotControlRuntime::plus_joint_1, &RobotControlRuntime::minus_joint_1,
     &RobotControlRuntime::step_plus_joint_1},
    {&RobotControlRuntime::plus_joint_2, &RobotControlRuntime::minus_joint_2,
     &RobotControlRuntime::step_plus_joint_2},
    {&RobotControlRuntime::plus_joint_3, &RobotControlRuntime::minus_joint_3,
     &RobotControlRuntime::step_plus_joint_3},
    {&RobotControlRuntime::plus_joint_4, &RobotControlRuntime::minus_joint_4,
     &RobotControlRuntime::step_plus_joint_4},
    {&RobotControlRuntime::plus_joint_5, &RobotControlRuntime::minus_joint_5,
     &RobotControlRuntime::step_plus_joint_5},
    {&RobotControlRuntime::plus_joint_6, &RobotControlRuntime::minus_joint_6,
     &RobotControlRuntime::step_plus_joint_6}};

/// From one pose of the tool to another: m along x, y, z, then rad about them.
std::array<double, 6> moved(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Vector3d way = to.translation() - from.translation();
  const Vector3d turn = rotation_vector(Eigen::Quaterniond(to.linear() * from.linear().transpose()));
  return {way.x(), way.y(), way.z(), turn.x(), turn.y(), turn.z()};
}

/// Along or about one axis alone, by this much.
bool is_alone(const std::array<double, 6>& way, int axis, double amount, double tolerance) {
  for (int i = 0; i < 6; ++i) {
    const double wanted = i == axis ? amount : 0;
    if (std::abs(way[static_cast<std::size_t>(i)] - wanted) > tolerance) return false;
  }
  return true;
}

// Press, parameter, set-point, what the arm's joints say; and the release.
bool each_arrow_moves_the_tool_while_it_is_held() {
  for (const Arrow& arrow : arrows) {
    World world;
    world.run(0.1);
    const Eigen::Isometry3d begin = world.tool();
    const auto joints_before = world.joints.latest();
    world.bench.runtime().*arrow.hold = true;
    world.run(1.0);
    if (!world.bench.feedback().moving || world.bench.feedback().activity != RobotActivity::jog) return false;
    const Eigen::Isometry3d middle = world.tool();
    world.run(0.5);
    const double speed =
        arrow.axis < 3 ? world.bench.runtime().jog_velocity : world.bench.runtime().turn_velocity;
    const double amount = arrow.sign * speed * 72 * cycle_seconds;
    if (!is_alone(moved(middle, world.tool()), arrow.axis, amount, 1e-6)) return false;
    world.bench.runtime().*arrow.hold = false;
    world.run(0.5);
    if (world.bench.feedback().moving || !world.bench.unit().is_idle()) return false;
    const Eigen::Isometry3d rest = world.tool();
    world.run(0.5);  // nor is a target from before gone back to
    if (world.tool().matrix() != rest.matrix() || !world.smooth()) return false;
    const auto joints_after = world.joints.latest();
    const Eigen::Isometry3d arm = forward_kinematics(six_axis, joints_after->position_map());
    if ((arm.matrix() - rest.matrix()).norm() > 1e-3 ||
        (joints_after->position_map() - joints_before->position_map()).norm() < 1e-3)
      return false;
    if (std::abs(moved(begin, rest)[static_cast<std::size_t>(arrow.axis)]) < std::abs(amount)) return false;
  }
  return true;
}

// From the cycle of the release on, each is slower than the one before.
bool an_arrow_that_is_let_go_brakes_at_once() {
  World world;
  world.bench.runtime().jog_velocity = 0.2;
  world.run(0.1);
  world.bench.runtime().minus_z = true;
  world.run(1.0);
  world.bench.runtime().minus_z = false;
  double last = world.bench.feedback().tool_speed;
  if (std::abs(last - 0.2) > 1e-6) return false;
  for (int cycles = 0; world.bench.feedback().moving; ++cycles) {
    if (cycles > 62) return false;  // 0.2 m/s at 0.5 m/s^2
    world.run(cycle_seconds / 2);
    if (!(world.bench.feedback().tool_speed < last)) return false;
    last = world.bench.feedback().tool_speed;
  }
  return world.smooth();
}

bool joint_arrows_move_one_joint_at_reduced_speed() {
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
    for (const bool plus : {true, false}) {
      World world;
      world.bench.runtime().joint_share = 1;
      world.run(0.1);
      const Hold hold = plus ? joint_arrows[i].plus : joint_arrows[i].minus;
      const JointVector begin = world.bench.feedback().set_point_map();
      world.bench.runtime().*hold = true;
      world.run(0.6);
      if (world.bench.feedback().activity != RobotActivity::joint_jog) return false;
      world.bench.runtime().*hold = false;
      world.run(1.0);
      JointVector way = world.bench.feedback().set_point_map() - begin;
      const auto index = static_cast<Eigen::Index>(i);
      if (plus ? way[index] < 0.05 : way[index] > -0.05) return false;
      way[index] = 0;
      if (!way.isZero(0) || world.bench.feedback().moving) return false;
      if (world.fastest_tool > reduced || !world.smooth()) return false;
    }
  }
  return true;
}

bool a_joint_arrow_ends_at_the_joints_end() {
  World world;
  world.bench.runtime().joint_share = 1;
  world.run(0.1);
  world.bench.runtime().plus_joint_5 = true;  // from 1.57 to 2.094 rad
  world.run(6);
  const double end = world.bench.feedback().set_point_map()[4];
  return std::abs(end - six_axis.joints[4].upper) < 1e-9 && !world.bench.feedback().moving &&
         world.holding("end of its range") && world.smooth();
}

bool a_step_is_one_increment_and_is_finished() {
  for (const Arrow& arrow : arrows) {
    World world;
    world.run(0.1);
    const Eigen::Isometry3d begin = world.tool();
    world.press(arrow.step);
    world.run(0.05);
    if (!world.bench.feedback().stepping || world.bench.feedback().activity != RobotActivity::step)
      return false;
    world.press(arrow.step);  // the table refuses it: without effect here, too
    world.bench.runtime().plus_y = arrow.axis != 1;
    world.run(0.05);
    world.bench.runtime().plus_y = false;  // held and let go meanwhile
    world.run(3.0);
    const double amount =
        arrow.sign * (arrow.axis < 3 ? world.bench.runtime().step_length : world.bench.runtime().step_angle);
    if (!is_alone(moved(begin, world.tool()), arrow.axis, amount, 1e-7)) return false;
    if (world.bench.feedback().stepping || !world.bench.unit().is_idle() || !world.smooth()) return false;
    if (world.fastest_tool > world.bench.runtime().jog_velocity + 1e-9) return false;
  }
  return true;
}

bool a_joints_step_is_one_increment() {
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
    World world;
    world.run(0.1);
    const JointVector begin = world.bench.feedback().set_point_map();
    world.press(joint_arrows[i].step);
    world.run(2.0);
    JointVector way = world.bench.feedback().set_point_map() - begin;
    way[static_cast<Eigen::Index>(i)] -= world.bench.runtime().joint_step[i];
    if (way.cwiseAbs().maxCoeff() > 1e-9 || world.bench.feedback().stepping) return false;
    if (world.fastest_tool > reduced || !world.smooth()) return false;
  }
  return true;
}

bool a_step_to_where_it_cannot_go_is_refused() {
  World world;
  world.run(0.1);
  for (double& step : world.bench.runtime().joint_step) step = 0.5;
  const JointVector begin = world.bench.feedback().set_point_map();
  world.press(&RobotControlRuntime::step_plus_joint_5);  // to 2.07 of 2.094 rad
  world.run(3.0);
  if (std::abs(world.bench.feedback().set_point_map()[4] - begin[4] - 0.5) > 1e-9) return false;
  world.restraint();
  world.press(&RobotControlRuntime::step_plus_joint_5);
  if (world.restraint().reason == nullptr || !world.holding("beyond its range")) return false;
  world.run(1.0);
  if (!world.holding("beyond its range") || world.bench.feedback().stepping) return false;
  return std::abs(world.bench.feedback().set_point_map()[4] - begin[4] - 0.5) < 1e-9 && world.smooth();
}

bool a_stop_ends_a_step() {
  World world;
  world.bench.runtime().step_length = 0.1;
  world.run(0.1);
  const Eigen::Isometry3d begin = world.tool();
  world.press(&RobotControlRuntime::step_minus_z);
  world.run(0.7);
  world.bench.tick().stop_requested = true;
  world.run(0.5);
  const double way = -moved(begin, world.tool())[2];
  if (!world.bench.unit().is_idle() || way < 0.005 || way > 0.09) return false;
  world.bench.tick().stop_requested = false;
  world.run(2.0);  // it is over
  return std::abs(way + moved(begin, world.tool())[2]) < 1e-9 && world.smooth();
}

// A hand, whatever it wants: 250 mm/s at the tool.
bool manual_is_slow_whatever_is_asked() {
  World world;
  world.run(0.1);
  if (!world.choose(ControlMode::manual)) return false;
  world.hand[0] = -3;
  world.hand[1] = 2;
  world.turn = AngularVelocity{{0.5, 0, 0.5}};
  world.run(1.0);
  world.hand[0] = 3;
  world.hand[1] = 0;
  world.run(1.0);
  if (world.restraint().reason == nullptr || world.fastest_tool < 0.2) return false;
  world.hand[0] = 0;
  world.turn.reset();
  world.run(1.0);
  JointVelocities all{};
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) all.velocity[i] = i % 2 == 0 ? 3.0 : -3.0;
  world.joint_hand = all;
  world.run(0.4);
  if (world.bench.feedback().activity != RobotActivity::joint_jog || world.restraint().reason == nullptr)
    return false;
  for (double& rate : all.velocity) rate = -rate;
  world.joint_hand = all;
  world.run(0.8);
  world.joint_hand.reset();
  world.run(1.5);
  return !world.bench.feedback().moving && world.fastest_tool <= reduced * (1 + 1e-9) && world.smooth();
}

bool automatic_refuses_jog_and_steps() {
  World world;
  world.run(0.1);
  if (!world.choose(ControlMode::automatic)) return false;
  const Eigen::Isometry3d begin = world.tool();
  world.hand[1] = 0.1;
  world.run(0.5);
  if (world.restraint().reason == nullptr || !world.holding("refused in automatic")) return false;
  world.hand[1] = 0;
  world.bench.runtime().plus_x = true;
  world.run(0.5);
  if (!world.holding("refused in automatic")) return false;
  world.bench.runtime().plus_x = false;
  world.bench.runtime().plus_joint_1 = true;
  world.run(0.5);
  if (!world.holding("refused in automatic")) return false;
  world.bench.runtime().plus_joint_1 = false;
  world.run(0.1);
  world.restraint();
  world.press(&RobotControlRuntime::step_plus_x);
  const Restraint said = world.restraint();
  if (said.reason == nullptr ||
      std::string_view(said.reason).find("steps are refused") == std::string_view::npos)
    return false;
  world.run(0.5);
  if (world.tool().matrix() != begin.matrix() || world.bench.feedback().moving) return false;
  // Targets are followed.
  world.wanted.position[2] -= 0.1;
  world.run(2.0);
  return world.at(0, 0, -0.1) && world.bench.feedback().holding_view().empty() && world.smooth();
}

bool manual_follows_no_target_and_says_so() {
  World world;
  world.run(0.1);
  if (!world.choose(ControlMode::manual)) return false;
  world.wanted.position[2] -= 0.1;
  world.restraint();
  world.run(cycle_seconds / 2);
  if (world.restraint().reason == nullptr) return false;
  world.run(1.0);
  if (!world.at(0, 0, 0) || !world.holding("not followed in manual") || !world.bench.unit().is_idle())
    return false;
  // Back in automatic it is not gone to either; the next one is.
  if (!world.choose(ControlMode::automatic)) return false;
  world.run(1.0);
  if (!world.at(0, 0, 0)) return false;
  world.wanted.position[2] -= 0.02;
  world.run(2.0);
  return world.at(0, 0, -0.12) && world.smooth();
}

bool the_mode_changes_at_standstill_only() {
  World world;
  world.run(0.1);
  world.wanted.position[2] -= 0.3;
  world.run(0.2);
  const Status refused = world.choose(ControlMode::automatic);
  if (refused || std::string_view(refused.cause()).find("standstill") == std::string_view::npos) return false;
  // What else is changed together with it, or without it, has no such rule.
  RobotControlRuntime proposed = world.bench.runtime();
  proposed.speed = 0.5;
  if (!world.bench.unit().accept(proposed)) return false;
  world.run(3.0);
  if (!world.at(0, 0, -0.3) || !world.choose(ControlMode::manual)) return false;
  world.bench.runtime().plus_y = true;
  world.run(0.3);
  if (world.choose(ControlMode::automatic)) return false;
  world.bench.runtime().plus_y = false;
  world.run(0.01);
  if (world.choose(ControlMode::automatic)) return false;  // it brakes still
  world.run(0.5);
  return world.choose(ControlMode::automatic).is_ok() && world.smooth();
}

bool what_is_not_a_number_is_refused() {
  World world;
  world.run(0.1);
  const Eigen::Isometry3d begin = world.tool();
  world.turn = AngularVelocity{{NAN, 0, 0}};
  world.run(0.3);
  if (!world.holding("not a number") || world.restraint().reason == nullptr) return false;
  world.turn.reset();
  world.joint_hand = JointVelocities{};
  world.joint_hand->velocity[1] = NAN;
  world.run(0.3);
  return world.holding("not a number") && world.tool().matrix() == begin.matrix() && world.smooth();
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::robot_jog_test

int main() {
  using namespace flexrf::robot_jog_test;
  const CMUnitTest tests[] = {
      {"each arrow moves the tool while held", passes<each_arrow_moves_the_tool_while_it_is_held>, nullptr,
       nullptr, nullptr},
      {"an arrow let go brakes at once", passes<an_arrow_that_is_let_go_brakes_at_once>, nullptr, nullptr,
       nullptr},
      {"joint arrows move one joint", passes<joint_arrows_move_one_joint_at_reduced_speed>, nullptr, nullptr,
       nullptr},
      {"a joint arrow ends at its end", passes<a_joint_arrow_ends_at_the_joints_end>, nullptr, nullptr,
       nullptr},
      {"a step is finished", passes<a_step_is_one_increment_and_is_finished>, nullptr, nullptr, nullptr},
      {"a joint's step", passes<a_joints_step_is_one_increment>, nullptr, nullptr, nullptr},
      {"a step out of reach is refused", passes<a_step_to_where_it_cannot_go_is_refused>, nullptr, nullptr,
       nullptr},
      {"a stop ends a step", passes<a_stop_ends_a_step>, nullptr, nullptr, nullptr},
      {"manual is slow", passes<manual_is_slow_whatever_is_asked>, nullptr, nullptr, nullptr},
      {"automatic refuses jog", passes<automatic_refuses_jog_and_steps>, nullptr, nullptr, nullptr},
      {"manual follows no target", passes<manual_follows_no_target_and_says_so>, nullptr, nullptr, nullptr},
      {"the mode changes at standstill", passes<the_mode_changes_at_standstill_only>, nullptr, nullptr,
       nullptr},
      {"not a number is refused", passes<what_is_not_a_number_is_refused>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
