#include "hal/gripper/scene/scene_gripper.hpp"

namespace flexrf {

Status SceneGripper::initialise() {
  if (const Status status = check_widths(configuration.closed_width, configuration.open_width); !status)
    return status;
  control_.begin({.whose = "the scene's",
                  .closed_width = configuration.closed_width,
                  .open_width = configuration.open_width,
                  .speed = configuration.speed,
                  .activation = configuration.activation,
                  .travel_timeout = configuration.travel_timeout});
  state_.reset();
  last_cycle_ = Time{};
  begin(configuration);
  return {};
}

GripperCapabilities SceneGripper::capabilities() const noexcept {
  return {.open_width = configuration.open_width,
          .closed_width = configuration.closed_width,
          .positions = true,
          .measures_opening = true,
          .speed = true,
          .force = true,
          .detects_object = true,
          .halts = true};
}

void SceneGripper::hear(const Tick& tick) noexcept {
  const Duration elapsed = last_cycle_ == Time{} ? Duration{} : tick.now - last_cycle_;
  last_cycle_ = tick.now;
  if (const auto seen = scene.latest()) meet_width(control_.fingers(), seen->grip_width);
  control_.advance(elapsed);
  SceneFingers told{};
  told.opening = control_.fingers().opening();
  fingers.publish(told, tick.now);
  state_.reset();
  if (!control_.is_heard()) return;
  state_.emplace();
  tell_known();
}

void SceneGripper::tell_known() noexcept {
  if (!state_) return;
  state_ = control_.known();
  state_->opening = control_.fingers().opening();
}

void SceneGripper::go(const GripperGoal& goal) noexcept {
  control_.go(goal);
  tell_known();
}

void SceneGripper::begin_activation() noexcept {
  control_.activate();
  tell_known();
}

void SceneGripper::halt() noexcept {
  control_.halt();
  tell_known();
}

}  // namespace flexrf
