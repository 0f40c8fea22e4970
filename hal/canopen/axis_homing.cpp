#include "hal/canopen/axis_homing.hpp"

namespace flexrf::canopen::cia402 {

void AxisHoming::begin(const Limits& limits, Mode own, bool needed) noexcept {
  *this = AxisHoming{};
  limits_ = limits;
  own_ = own;
  needed_ = needed;
  run_ = HomingRun{limits.run, limits.settle, limits.tells_reached};
}

void AxisHoming::start() noexcept {
  if (!needed_ || is_running()) return;
  homed_ = false;
  problem_ = {};
  enter(Phase::resting);
}

void AxisHoming::halt() noexcept {
  if (phase_ == Phase::idle || phase_ == Phase::stopping || phase_ == Phase::leaving) return;
  fail(Status::error(StatusCode::unavailable, "the homing was halted"));
}

void AxisHoming::interrupt() noexcept {
  if (!is_running()) return;
  // It may have been on its way back, with its home found.
  if (!homed_ && problem_.is_ok()) {
    problem_ = Status::error(StatusCode::unavailable,
                             "the homing was interrupted: the drive is not enabled any more");
  }
  enter(Phase::idle);
}

void AxisHoming::refuse_mode() noexcept {
  if (!is_running()) return;
  problem_ = mode_refused();
  enter(Phase::idle);
}

Status AxisHoming::mode_refused() noexcept {
  return Status::error(StatusCode::timeout,
                       "the drive does not take mode %d, homing: does it have it? One that changes its mode "
                       "only while it is off needs `changes_mode_enabled = false`",
                       static_cast<int>(Mode::homing));
}

void AxisHoming::forget() noexcept {
  interrupt();
  homed_ = false;
}

Homing AxisHoming::state() const noexcept {
  if (!needed_) return Homing::homed;
  if (is_running()) return Homing::running;
  if (homed_) return Homing::homed;
  return problem_.is_ok() ? Homing::not_homed : Homing::failed;
}

Mode AxisHoming::mode() const noexcept {
  switch (phase_) {
    case Phase::entering:
    case Phase::running:
    case Phase::stopping:
      return Mode::homing;
    default:
      return own_;
  }
}

std::uint16_t AxisHoming::advance(const HomingView& view, Time now) noexcept {
  if (!since_) since_ = now;
  const Duration in_phase = now - *since_;
  switch (phase_) {
    case Phase::idle:
      return 0;
    case Phase::resting:
      if (view.at_rest) {
        enter(Phase::entering);
      } else if (in_phase > limits_.stop) {
        problem_ = Status::error(StatusCode::timeout, "the axis does not come to rest, to be homed");
        enter(Phase::idle);
      }
      return 0;
    case Phase::entering:
      if (view.shown == Mode::homing) {
        run_.start();
        enter(Phase::running);
      } else if (in_phase > limits_.mode) {
        fail(mode_refused());
      }
      return 0;
    case Phase::running:
      return advance_run(view, now);
    case Phase::stopping:
      if (view.at_rest) {
        enter(Phase::leaving);
      } else if (in_phase > limits_.stop && trouble_.is_ok()) {
        trouble_ = Status::error(StatusCode::timeout, "the drive does not stop its homing");
      }
      return control_bit::halt;
    case Phase::leaving:
      if (view.shown == own_) {
        enter(Phase::idle);
      } else if (in_phase > limits_.mode && trouble_.is_ok()) {
        trouble_ = Status::error(StatusCode::timeout, "the drive does not come back from homing into mode %d",
                                 static_cast<int>(own_));
      }
      return 0;
  }
  return 0;
}

std::uint16_t AxisHoming::advance_run(const HomingView& view, Time now) noexcept {
  const std::uint16_t bits = run_.advance(view.statusword, view.is_new, view.at_rest, now);
  if (run_.state() == HomingRun::State::done) {
    homed_ = true;
    enter(Phase::leaving);
  } else if (run_.state() == HomingRun::State::failed) {
    fail(run_.problem());
    return control_bit::halt;
  }
  return bits;
}

void AxisHoming::enter(Phase phase) noexcept {
  phase_ = phase;
  since_.reset();
}

void AxisHoming::fail(const Status& problem) noexcept {
  problem_ = problem;
  enter(phase_ == Phase::resting ? Phase::idle : Phase::stopping);
}

}  // namespace flexrf::canopen::cia402
