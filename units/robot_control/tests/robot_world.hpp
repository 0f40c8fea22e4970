// The unit with the simulated arm, cycle by cycle as its thread would run it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/simulated/simulated_arm.hpp"
#include "motion/pose_conversion.hpp"
#include "six_axis.hpp"
#include "units/robot_control/robot_control.hpp"
#include "units/unit_bench.hpp"

namespace flexrf::user {

inline constexpr Duration cycle = std::chrono::milliseconds(7);
inline constexpr double cycle_seconds = 0.007;

struct World {
  DeviceBench<SimulatedArm> arm{&six_axis};
  UnitBench<RobotControl> bench;
  SlotBench<Pose> target;
  SlotBench<Velocity> velocity;
  SlotBench<AngularVelocity> turning;
  SlotBench<JointVelocities> joint_jog;
  SlotBench<ServoTarget> servo;
  SlotBench<Pose> pose;
  SlotBench<JointState> joints;
  InputBinding inputs[5] = {target.input(std::chrono::milliseconds(500)),
                            velocity.input(std::chrono::milliseconds(100)),
                            turning.input(std::chrono::milliseconds(100)),
                            joint_jog.input(std::chrono::milliseconds(100)), servo.input()};
  SlotBench<TargetAnswer> answer;
  SlotBench<RobotLead> led_by;
  SlotControl* outputs[4] = {&pose.control(), &joints.control(), &answer.control(), &led_by.control()};
  Device* device = &arm.driver();
  Device* const* devices[1] = {&device};
  Pose wanted{};
  bool target_lives = true;
  double hand[3] = {0, 0, 0};  // m/s
  bool hand_lives = true;
  std::optional<AngularVelocity> turn;
  std::optional<JointVelocities> joint_hand;
  std::optional<ServoTarget> stream;

  /// `has_servo` false: that input is not connected.
  explicit World(bool has_servo = false) {
    if (!has_servo) inputs[4] = {};
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.devices = devices;
    bench.unit().connect(binding);
    arm.configuration().noise = {};
    ready = arm.driver().initialise().is_ok() && bench.unit().initialise().is_ok();
    wanted = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
  }

  static double home_x() {
    return to_pose(forward_kinematics(six_axis, home_position(six_axis))).position[0];
  }
  // As jog and the thread do: the target every cycle, receive, step, send.
  void run(double duration) {
    for (double time = 0; time < duration; time += cycle_seconds) {
      if (target_lives) target.publish(wanted, bench.now());
      if (hand_lives) velocity.publish({{hand[0], hand[1], hand[2]}}, bench.now());
      if (turn) turning.publish(*turn, bench.now());
      if (joint_hand) joint_jog.publish(*joint_hand, bench.now());
      if (stream) servo.publish(*stream, bench.now());
      arm.receive(cycle);
      bench.step(cycle);
      arm.send();
      watch();
    }
  }
  // Where the set-points have the tool, without the servos' lag.
  Eigen::Isometry3d tool() { return forward_kinematics(six_axis, bench.feedback().set_point_map()); }
  // As the executive does it, whose answer the operator reads.
  Status choose(ControlMode mode) {
    RobotControlRuntime proposed = bench.runtime();
    proposed.mode = mode;
    const Status answered = bench.unit().accept(proposed);
    if (answered) bench.runtime() = proposed;
    return answered;
  }
  // A press of a button is seen in one step.
  void press(std::uint32_t RobotControlRuntime::*button) {
    bench.runtime().*button = 1;
    run(cycle_seconds / 2);
    bench.runtime().*button = 0;
  }
  Restraint restraint() { return bench.unit().take_restraint(); }
  // Set-points must never jump, whatever happens.
  void watch() {
    const JointVector now = bench.feedback().set_point_map();
    if (watching) {
      const double tool_speed =
          (tool().translation() - forward_kinematics(six_axis, last).translation()).norm() / cycle_seconds;
      fastest_tool = std::max(fastest_tool, tool_speed);
      for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
        const auto index = static_cast<Eigen::Index>(i);
        const double rate = std::abs(now[index] - last[index]) / cycle_seconds;
        worst = std::max(worst, rate / six_axis.joints[i].velocity);
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
  double worst = 0;         // of a joint's velocity
  double fastest_tool = 0;  // m/s
};

}  // namespace flexrf::user
