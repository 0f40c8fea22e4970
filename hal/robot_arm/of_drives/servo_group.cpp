#include "hal/robot_arm/of_drives/servo_group.hpp"

#include <algorithm>

namespace flexrf {

void ServoGroup::begin(std::span<ServoDrive* const> drives, const KinematicChain& chain) noexcept {
  *this = ServoGroup{};
  chain_ = &chain;
  count_ = std::min({drives.size(), chain.joint_count, max_joints});
  std::copy_n(drives.begin(), count_, drives_.begin());
}

void ServoGroup::lead(bool may_move) noexcept {
  const bool may = may_move && fault_.is_ok();
  for (ServoDrive* drive : std::span(drives_).first(count_)) drive->set_inhibited(!may);
  if (!may) {
    ready_ = false;
    sent_home_ = {};
    return;
  }
  if (!ready_) ready_ = all_enabled() && all_homed();
}

void ServoGroup::watch() noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    if (!drives_[i]->fault().is_ok()) fail(i, drives_[i]->fault());
  }
  if (!ready_) return;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto state = drives_[i]->state();
    if (state && state->enabled && state->homing == ServoHoming::homed) continue;
    fail(i, Status::error(StatusCode::device_fault, "its drive dropped out by itself"));
  }
}

std::optional<JointState> ServoGroup::state() const noexcept {
  JointState result{};
  for (std::size_t i = 0; i < count_; ++i) {
    const auto state = drives_[i]->state();
    if (!state || state->homing != ServoHoming::homed) return std::nullopt;
    result.position[i] = state->position;
    result.velocity[i] = state->velocity;
  }
  return result;
}

Time ServoGroup::measured_at() const noexcept {
  if (!state()) return Time{};
  Time oldest = Time::max();
  for (std::size_t i = 0; i < count_; ++i) oldest = std::min(oldest, drives_[i]->state()->measured_at);
  return oldest;
}

void ServoGroup::following_error(std::array<double, max_joints>& error) const noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    const auto state = drives_[i]->state();
    error[i] = state ? state->following_error : 0;
  }
}

void ServoGroup::command(const JointPositions& set_points) noexcept {
  if (!ready_) return;
  for (std::size_t i = 0; i < count_; ++i) {
    const ChainJoint& joint = chain_->joints[i];
    drives_[i]->command_position(std::clamp(set_points.position[i], joint.lower, joint.upper));
  }
}

bool ServoGroup::make_safe() noexcept {
  ready_ = false;
  bool safe = true;
  for (ServoDrive* drive : std::span(drives_).first(count_)) {
    if (!drive->make_safe()) safe = false;
  }
  return safe;
}

// The first cause counts; the others follow from it.
void ServoGroup::fail(std::size_t joint, const Status& cause) noexcept {
  ready_ = false;
  if (!fault_.is_ok()) return;
  const std::string_view name = chain_->joints[joint].name;
  fault_ = Status::error(cause.code(), "%.*s: %s", static_cast<int>(name.size()), name.data(), cause.cause());
}

bool ServoGroup::all_enabled() const noexcept {
  return std::all_of(drives_.begin(), drives_.begin() + count_, [](const ServoDrive* drive) {
    const auto state = drive->state();
    return state && state->enabled;
  });
}

bool ServoGroup::all_homed() noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    const auto state = drives_[i]->state();
    if (!state) return false;
    if (state->homing == ServoHoming::homed) continue;
    if (state->homing == ServoHoming::running) return false;
    if (sent_home_[i]) {
      fail(i, drives_[i]->homing_problem());
    } else {
      drives_[i]->home();
      sent_home_[i] = true;
    }
    return false;
  }
  return true;
}

}  // namespace flexrf
