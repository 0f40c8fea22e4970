// A RobotArm of several drives: what its drivers, real, simulated and mock, have in common.
#pragma once

#include <cstdio>

#include "hal/robot_arm/of_drives/same_columns.hpp"
#include "hal/robot_arm/of_drives/servo_group.hpp"
#include "hal/servo_drive/interface/servo_restraints.hpp"
#include "motion/kinematics.hpp"

namespace flexrf {

/// `Base`: the driver's generated base, of a RobotArm. `Drive`: a driver of ServoDrive, of which it has one
/// for each joint. Limits of position, velocity and acceleration are the chain's. What the arm's table calls
/// as the drive's table does goes to each drive.
template <class Base, class Drive>
class ArmOfDrives : public Base {
 public:
  using DriveConfiguration = typename Drive::Configuration;

  Status initialise() override {
    const std::size_t joints = this->chain->joint_count;
    for (std::size_t i = 0; i < joints; ++i) {
      if (const Status status = initialise_drive(i); !status.is_ok()) {
        stop_first(i);
        return Status::error(status.code(), "%s: %s", names_[i].data(), status.cause());
      }
    }
    group_.begin(std::span(members_).first(joints), *this->chain);
    this->begin_supervision(this->configuration);
    return {};
  }
  void stop() override { stop_first(this->chain->joint_count); }

  std::optional<JointState> state() const noexcept override { return group_.state(); }
  Time measured_at() const noexcept override { return group_.measured_at(); }
  /// For faults on purpose; of the drive with this joint.
  Drive& drive(std::size_t joint) noexcept { return drives_[joint]; }

 protected:
  /// What differs from joint to joint, beside the chain's limits. Error: it does not fit the chain.
  virtual Status configure(std::size_t joint, DriveConfiguration& configuration) = 0;

 private:
  void take_in(const Tick& tick) noexcept override {
    for (Drive& drive : drives()) drive.receive(tick);
    group_.watch();
    const auto state = group_.state();
    if (state) this->feedback.position = state->position;
    group_.following_error(this->feedback.following_error);
    this->supervise(tick.now);
  }
  void forget() noexcept override { group_.lead(false); }
  void act(const Tick& tick) noexcept override {
    group_.lead(true);
    exchange(tick);
  }
  void rest(const Tick& tick) noexcept override { exchange(tick); }
  void exchange(const Tick& tick) noexcept {
    for (Drive& drive : drives()) {
      drive.send(tick);
      // That it is led too fast the arm says itself, with the joint's name.
      if (const Restraint held = drive.take_restraint(); held.reason != servo_restraints::led_too_fast)
        this->restrain(held);
    }
    group_.watch();
    if (!group_.fault().is_ok()) this->fail(group_.fault());
  }
  bool become_safe() noexcept override { return group_.make_safe(); }
  void follow(const JointPositions& set_points) noexcept override {
    group_.command(set_points);
    this->tell_limits_and_pace(set_points);
  }
  bool is_operational() const noexcept override { return group_.is_ready(); }

  std::span<Drive> drives() noexcept { return std::span(drives_).first(this->chain->joint_count); }

  Status initialise_drive(std::size_t i) {
    const ChainJoint& joint = this->chain->joints[i];
    if (joint.kind == JointKind::continuous) {
      return Status::error(
          StatusCode::invalid_argument,
          "joint %.*s turns without end, and a drive that is led by positions counts only so "
          "far: give it lower and upper in the device's row, by urdf.joint",
          static_cast<int>(joint.name.size()), joint.name.data());
    }
    Drive& drive = drives_[i];
    members_[i] = &drive;
    std::snprintf(names_[i].data(), names_[i].size(), "%s.%.*s", this->name(),
                  static_cast<int>(joint.name.size()), joint.name.data());
    drive.set_name(names_[i].data());
    drive.set_environment(&this->environment());
    DeviceBinding binding;
    if constexpr (requires { this->bus; }) binding.bus = this->bus;
    drive.connect(binding);
    drive.clear_fault();
    drive.set_inhibited(true);
    auto& settings = *static_cast<DriveConfiguration*>(drive.parameter_memory().configuration);
    settings = {};
    copy_same_columns(*descriptor_of<typename Base::Configuration>, &this->configuration,
                      *descriptor_of<DriveConfiguration>, &settings);
    settings.mode = ServoMode::cyclic_position;
    settings.lowest = joint.lower;
    settings.highest = joint.upper;
    settings.fastest = joint.velocity;
    settings.acceleration = joint.acceleration;
    if (const Status status = configure(i, settings); !status.is_ok()) return status;
    return drive.initialise();
  }
  void stop_first(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) drives_[i].stop();
  }

  std::array<Drive, max_joints> drives_;
  std::array<ServoDrive*, max_joints> members_{};
  std::array<std::array<char, 64>, max_joints> names_{};
  ServoGroup group_;
};

}  // namespace flexrf
