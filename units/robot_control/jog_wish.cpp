#include "units/robot_control/jog_wish.hpp"

#include <iterator>

namespace flexrf::user {
namespace {

using Hold = bool RobotControlRuntime::*;
using Button = std::uint32_t RobotControlRuntime::*;
using Runtime = RobotControlRuntime;

template <class Member>
struct Pair {
  Member plus;
  Member minus;
};

constexpr Pair<Hold> tool_arrows[6] = {
    {&Runtime::plus_x, &Runtime::minus_x},         {&Runtime::plus_y, &Runtime::minus_y},
    {&Runtime::plus_z, &Runtime::minus_z},         {&Runtime::plus_roll, &Runtime::minus_roll},
    {&Runtime::plus_pitch, &Runtime::minus_pitch}, {&Runtime::plus_yaw, &Runtime::minus_yaw},
};
constexpr Pair<Hold> joint_arrows[max_joints] = {
    {&Runtime::plus_joint_1, &Runtime::minus_joint_1}, {&Runtime::plus_joint_2, &Runtime::minus_joint_2},
    {&Runtime::plus_joint_3, &Runtime::minus_joint_3}, {&Runtime::plus_joint_4, &Runtime::minus_joint_4},
    {&Runtime::plus_joint_5, &Runtime::minus_joint_5}, {&Runtime::plus_joint_6, &Runtime::minus_joint_6},
    {&Runtime::plus_joint_7, &Runtime::minus_joint_7}, {&Runtime::plus_joint_8, &Runtime::minus_joint_8},
};
constexpr Pair<Button> steps[6 + max_joints] = {
    {&Runtime::step_plus_x, &Runtime::step_minus_x},
    {&Runtime::step_plus_y, &Runtime::step_minus_y},
    {&Runtime::step_plus_z, &Runtime::step_minus_z},
    {&Runtime::step_plus_roll, &Runtime::step_minus_roll},
    {&Runtime::step_plus_pitch, &Runtime::step_minus_pitch},
    {&Runtime::step_plus_yaw, &Runtime::step_minus_yaw},
    {&Runtime::step_plus_joint_1, &Runtime::step_minus_joint_1},
    {&Runtime::step_plus_joint_2, &Runtime::step_minus_joint_2},
    {&Runtime::step_plus_joint_3, &Runtime::step_minus_joint_3},
    {&Runtime::step_plus_joint_4, &Runtime::step_minus_joint_4},
    {&Runtime::step_plus_joint_5, &Runtime::step_minus_joint_5},
    {&Runtime::step_plus_joint_6, &Runtime::step_minus_joint_6},
    {&Runtime::step_plus_joint_7, &Runtime::step_minus_joint_7},
    {&Runtime::step_plus_joint_8, &Runtime::step_minus_joint_8},
};

double towards(const Runtime& runtime, const Pair<Hold>& arrows) noexcept {
  return (runtime.*arrows.plus ? 1.0 : 0.0) - (runtime.*arrows.minus ? 1.0 : 0.0);
}

// As fast in any direction.
Eigen::Vector3d held_direction(const Runtime& runtime, int first) noexcept {
  Eigen::Vector3d direction;
  for (int i = 0; i < 3; ++i) direction[i] = towards(runtime, tool_arrows[first + i]);
  if (!direction.isZero(0)) direction.normalize();
  return direction;
}

}  // namespace

JogWish held_arrows(const Runtime& runtime, const KinematicChain& chain) noexcept {
  JogWish wish;
  wish.tool.linear = runtime.jog_velocity * held_direction(runtime, 0);
  wish.tool.angular = runtime.turn_velocity * held_direction(runtime, 3);
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    wish.joints[static_cast<Eigen::Index>(i)] =
        towards(runtime, joint_arrows[i]) * runtime.joint_share * chain.joints[i].velocity;
  }
  return wish;
}

bool asks_for_missing_joint(const Runtime& runtime, const KinematicChain& chain) noexcept {
  for (std::size_t i = chain.joint_count; i < max_joints; ++i)
    if (towards(runtime, joint_arrows[i]) != 0) return true;
  return false;
}

std::optional<StepWish> pressed_step(const Runtime& runtime) noexcept {
  for (int axis = 0; axis < static_cast<int>(std::size(steps)); ++axis) {
    const bool plus = runtime.*steps[axis].plus > 0;
    if (!plus && !(runtime.*steps[axis].minus > 0)) continue;
    StepWish wish{.axis = axis, .way = axis < 3 ? runtime.step_length : runtime.step_angle};
    if (wish.of_joint()) wish.way = runtime.joint_step[wish.joint()];
    if (!plus) wish.way = -wish.way;
    return wish;
  }
  return std::nullopt;
}

}  // namespace flexrf::user
