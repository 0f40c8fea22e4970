#include "hal/gripper/mock/mock_gripper.hpp"

namespace flexrf {

Status MockGripper::initialise() {
  if (const Status status = check_widths(configuration.closed_width, configuration.open_width); !status)
    return status;
  control_.begin({.whose = "the mock's",
                  .closed_width = configuration.closed_width,
                  .open_width = configuration.open_width,
                  .speed = configuration.speed,
                  .activation = configuration.activation,
                  .travel_timeout = configuration.travel_timeout,
                  .halts = !configuration.two_state});
  opening_.reset();
  state_.reset();
  last_cycle_ = Time{};
  noise_.seed(environment().seed);
  delay_.clear();
  begin(configuration);
  return {};
}

GripperCapabilities MockGripper::capabilities() const noexcept {
  const bool all = !configuration.two_state;
  return {.open_width = configuration.open_width,
          .closed_width = configuration.closed_width,
          .positions = all,
          .measures_opening = all,
          .speed = all,
          .force = all,
          .detects_object = true,
          .halts = all};
}

void MockGripper::hear(const Tick& tick) noexcept {
  const Duration elapsed = last_cycle_ == Time{} ? Duration{} : tick.now - last_cycle_;
  last_cycle_ = tick.now;
  control_.advance(elapsed);
  const double opening = fingers().opening();
  const bool at_end = opening == configuration.open_width || opening == configuration.closed_width;
  const double measured = delay_.pass(opening + noise_.around_zero(configuration.opening_noise), tick.now);
  opening_.reset();
  if (configuration.two_state && at_end) opening_ = opening;
  if (!configuration.two_state) opening_ = measured;
  state_.reset();
  if (!control_.is_heard()) return;
  state_.emplace();
  tell_known();
}

void MockGripper::tell_known() noexcept {
  if (!state_) return;
  state_ = control_.known();
  state_->opening = opening_;
}

void MockGripper::go(const GripperGoal& goal) noexcept {
  if (!is_ready()) return;
  if (configuration.object_width > 0 && goal.opening < fingers().opening() &&
      !control_.known().holds_object())
    fingers().put_object(configuration.object_width);
  control_.go(goal);
  tell_known();
}

void MockGripper::begin_activation() noexcept {
  control_.activate();
  tell_known();
}

void MockGripper::halt() noexcept {
  control_.halt();
  tell_known();
}

}  // namespace flexrf
