#include "hal/canopen/drive_modes.hpp"

namespace flexrf::canopen::cia402 {

void SetPointHandshake::reset(std::int32_t actual) noexcept {
  step_ = Step::free;
  is_under_way_ = false;
  waiting_.reset();
  target_ = actual;
  problem_ = {};
}

std::uint16_t SetPointHandshake::advance(std::uint16_t statusword, Time now, bool is_told) noexcept {
  const bool acknowledged = (statusword & status_bit::set_point_acknowledged) != 0;
  if (step_ == Step::offered && acknowledged) {
    step_ = Step::withdrawn;
    is_under_way_ = true;
    since_ = now;
  } else if (step_ == Step::withdrawn && !acknowledged) {
    step_ = Step::free;
  } else if (step_ == Step::withdrawn && !at_once_ && (statusword & status_bit::target_reached) == 0) {
    since_ = now;
  }
  const bool is_there = step_ == Step::free && (statusword & status_bit::target_reached) != 0;
  if (is_there) is_under_way_ = false;
  if (step_ == Step::prepared) {
    if (is_told) {
      step_ = Step::offered;
      since_ = now;
    }
  } else if (step_ == Step::free && waiting_ && !acknowledged && (at_once_ || !is_under_way_)) {
    target_ = waiting_->target;
    speed_ = waiting_->speed;
    waiting_.reset();
    step_ = Step::prepared;
    since_ = now;
  }
  if (step_ != Step::free && now - since_ > timeout_ && problem_.is_ok()) give_up(statusword);
  const std::uint16_t bits = at_once_ ? control_bit::change_immediately : 0;
  return step_ == Step::offered ? bits | control_bit::new_set_point : bits;
}

void SetPointHandshake::give_up(std::uint16_t statusword) noexcept {
  if (step_ == Step::prepared) {
    problem_ =
        Status::error(StatusCode::timeout,
                      "the drive does not answer that it took the speed of a new set-point (statusword %04X)",
                      unsigned{statusword});
    return;
  }
  const bool may_finish_first = at_once_ && (statusword & status_bit::target_reached) == 0;
  problem_ = Status::error(StatusCode::timeout, "the drive does not %s a new set-point (statusword %04X)%s",
                           step_ == Step::offered ? "acknowledge" : "let go of", unsigned{statusword},
                           may_finish_first ? "; for one that takes a target only when it is at the one "
                                              "before: `changes_target_at_once = false`"
                                            : "");
}

std::uint16_t InterpolationSwitch::advance(std::uint16_t statusword, Time now) noexcept {
  const bool active = (statusword & status_bit::interpolates) != 0;
  switch (step_) {
    case Step::off:
      step_ = Step::prepared;
      return 0;
    case Step::prepared:
      step_ = Step::asked;
      since_ = now;
      break;
    case Step::asked:
      if (active) {
        step_ = Step::active;
        was_active_ = true;
      } else if (now - since_ > timeout_ && problem_.is_ok()) {
        problem_ = Status::error(StatusCode::timeout,
                                 "the drive does not begin to interpolate positions (statusword %04X)",
                                 unsigned{statusword});
      }
      break;
    case Step::active:
      if (!active && problem_.is_ok()) {
        problem_ =
            Status::error(StatusCode::device_fault,
                          "the drive no longer follows interpolated positions (statusword %04X): do they "
                          "come each period that it was told?",
                          unsigned{statusword});
      }
      break;
  }
  return control_bit::interpolate;
}

void HomingRun::start() noexcept {
  state_ = State::running;
  lowered_ = raised_ = false;
  saw_it_running_ = false;
  heard_ = unheard_ = 0;
  problem_ = {};
}

void HomingRun::interrupt() noexcept {
  if (state_ != State::running) return;
  fail(Status::error(StatusCode::unavailable,
                     "the homing was interrupted: the drive is not enabled any more"));
}

void HomingRun::hear(bool is_new, Time now) noexcept {
  unheard_ = is_new ? 0 : unheard_ + 1;
  if (unheard_ > most_unheard) heard_ = 0;
  if (is_new && heard_++ == 0) heard_since_ = now;
}

bool HomingRun::is_about_this_run(bool is_in_progress, Time now) noexcept {
  if (heard_ <= latency) return false;
  saw_it_running_ = saw_it_running_ || is_in_progress;
  return saw_it_running_ || now - heard_since_ > settle_;
}

std::uint16_t HomingRun::advance(std::uint16_t statusword, bool is_new, bool at_rest, Time now) noexcept {
  if (state_ != State::running) return 0;
  if (!lowered_) {
    lowered_ = true;
    since_ = now;
    return 0;
  }
  if (!raised_) {
    raised_ = true;
    return control_bit::start_homing;
  }
  hear(is_new, now);
  const bool attained = (statusword & status_bit::homing_attained) != 0;
  const bool reached = (statusword & status_bit::target_reached) != 0;
  const bool error = (statusword & status_bit::homing_error) != 0;
  if (is_about_this_run(!attained && !error && !(tells_reached_ && reached), now)) {
    if (error) {
      fail(Status::error(StatusCode::device_fault,
                         "the drive could not home (statusword %04X): does the method fit its switches?",
                         unsigned{statusword}));
      return 0;
    }
    if (attained && (tells_reached_ ? reached : at_rest)) {
      state_ = State::done;
      return 0;
    }
  }
  if (now - since_ > timeout_) {
    const bool says_it_by_one_bit = attained && !reached && tells_reached_;
    fail(Status::error(StatusCode::timeout, "the drive did not home within %lld ms (statusword %04X)%s",
                       static_cast<long long>(timeout_.count() / 1'000'000), unsigned{statusword},
                       says_it_by_one_bit
                           ? ": it says that it found its home (bit 12), and not that it is there (bit 10); "
                             "for a drive that never says that: `homing_tells_reached = false`"
                           : ""));
    return 0;
  }
  return control_bit::start_homing;
}

void HomingRun::fail(const Status& problem) noexcept {
  state_ = State::failed;
  problem_ = problem;
}

}  // namespace flexrf::canopen::cia402
