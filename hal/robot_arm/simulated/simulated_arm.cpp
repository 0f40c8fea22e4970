#include "hal/robot_arm/simulated/simulated_arm.hpp"

#include "motion/kinematics.hpp"

namespace flexrf {
namespace {

bool is_due(double after, Time started, Time now) {
  return after > 0 && seconds(now - started) >= after;
}

}  // namespace

Status SimulatedArm::initialise() {
  model_.restart(*chain, configuration.servo_lag);
  model_.stick(static_cast<int>(configuration.stuck_joint) - 1);
  random_.seed(environment().seed);
  noise_.reset();
  state_.reset();
  commanded_.reset();
  started_ = Time{};
  sensors_lost_ = false;
  begin_supervision(configuration);
  return {};
}

void SimulatedArm::take_in(const Tick& tick) noexcept {
  if (started_ == Time{}) started_ = tick.now;
  inject_scheduled(tick.now);
  if (!may_act()) forget();
  model_.advance(tick.now);
  if (true_joints.is_connected()) {
    JointState joints{};
    joints.position_map() = model_.position();
    joints.velocity_map() = model_.velocity();
    true_joints.publish(joints, tick.now);
  }
  sense(tick.now);
  supervise(tick.now);
}

void SimulatedArm::follow(const JointPositions& set_points) noexcept {
  tell_limits_and_pace(set_points);
  commanded_ = set_points;
}

void SimulatedArm::forget() noexcept {
  commanded_.reset();
  model_.hold();
}

void SimulatedArm::act(const Tick& /*tick*/) noexcept {
  if (commanded_) model_.follow(commanded_->position_map());
  commanded_.reset();
}

bool SimulatedArm::become_safe() noexcept {
  forget();
  return model_.is_at_rest();
}

void SimulatedArm::inject(Fault fault) noexcept {
  switch (fault) {
    case Fault::drives_trip:
      fail(Status::error(StatusCode::device_fault, "the simulated drives tripped, as they were asked to"));
      break;
    case Fault::sensors_lost:
      sensors_lost_ = true;
      break;
    case Fault::joint_sticks:
      model_.stick(0);
      break;
  }
}

void SimulatedArm::inject_scheduled(Time now) noexcept {
  if (is_due(configuration.drive_fault_after, started_, now)) inject(Fault::drives_trip);
  if (is_due(configuration.sensor_lost_after, started_, now)) inject(Fault::sensors_lost);
}

void SimulatedArm::sense(Time now) noexcept {
  if (sensors_lost_) {
    state_.reset();
    return;
  }
  JointVector sensed = model_.position();
  for (std::size_t i = 0; i < chain->joint_count; ++i) {
    const double deviation = configuration.noise[i];
    if (deviation > 0) sensed[static_cast<Eigen::Index>(i)] += deviation * noise_(random_);
  }
  state_.emplace();
  measured_at_ = now;
  state_->position_map() = sensed;
  state_->velocity_map() = model_.velocity();
  feedback.position_map() = sensed;
  feedback.following_error_map() = model_.followed() - sensed;
}

}  // namespace flexrf
