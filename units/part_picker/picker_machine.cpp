#include "units/part_picker/picker_machine.hpp"

#include "units/part_picker/picker_rules.hpp"

namespace flexrf::user {

void PickerMachine::begin(const PickerPlan& plan) noexcept {
  *this = PickerMachine{};
  plan_ = plan;
  // The palm and the camera beside it are within half the palm's length and a bit.
  const double room = plan.hand.palm_length / 2 + 0.03;
  // A part hangs as far below the fingertips as they close above the table.
  paths_.use(plan.keep_outs, plan.travel_height - picker::passes_height - plan.grasp_height, room);
  kept_out_.use(plan.keep_outs, 0, room);
}

void PickerMachine::step(const PickerView& view, const PickerWishes& wishes) noexcept {
  view_ = &view;
  wishes_ = &wishes;
  act_ = PickerAct::none;
  target_.reset();
  if (view.tracks_are_new) ++pictures_;
  count_watched_pictures();
  if (!view.arm_rests) moved_ = view.now;
  // While a hand led the arm, or the camera told nothing, anything may have been laid onto the table.
  if (view.others_lead || view.tracks == nullptr) needs_survey_ = true;
  if (!supervise()) act_in_state();
  const bool is_between = in_hand_ || state_ == PickerState::closing;
  if (is_between) let_go_ = view.now + picker::picture_age;
  shows_part_ = is_between || view.now < let_go_;
  if (!picker::watches(state_) && !waits_at_bin_) watch_for_.reset();
  // Fingers finish what they are at; without sight the arm holds.
  if (view.tracks == nullptr) target_.reset();
  const bool is_same_way =
      target_ && led_to_ && (target_->translation() - led_to_->translation()).norm() <= picker::same_way;
  if (!is_same_way && !picker::gives_up(state_)) ++way_;
  led_to_ = target_;
  view_ = nullptr;
  wishes_ = nullptr;
}

/// True: nothing else is done in this step.
bool PickerMachine::supervise() noexcept {
  if (view_->arm_is_in_fault || !view_->may_move || !view_->tool || !view_->gripper.known) {
    const char* const why = view_->arm_is_in_fault ? "the arm is in fault"
                            : !view_->may_move     ? "nothing may move"
                            : !view_->tool         ? "the arm does not say where it is"
                                                   : "the gripper says nothing";
    if (state_ != PickerState::off || cause_ != why) enter(PickerState::off, why);
    return true;
  }
  if (state_ == PickerState::off) {
    leave_off();
    return true;
  }
  return watch_gripper() || watch_person() || watch_arm() || watch_sight() || watch_progress();
}

void PickerMachine::leave_off() noexcept {
  if (!view_->gripper.activated) {
    cause_ = "the gripper is being activated";
    if (view_->gripper.moving) return;
    if (in_hand_ && !wishes_->open_gripper) {
      cause_ =
          "the gripper has to be activated, and may drop the part: hold a hand below it, press Open gripper";
      return;
    }
    act_ = PickerAct::activate;
    return;
  }
  if (view_->gripper.moving) return;
  // They were stopped while they closed, or opened in the bin: closed again they tell whether they hold it.
  if (in_hand_ && view_->gripper.object == GripperObject::unknown) {
    act_ = PickerAct::close;
    cause_ = "the fingers find out whether they hold the part";
    return;
  }
  if (in_hand_ && !fingers_hold()) drop_from_hand();
  needs_survey_ = true;
  enter(PickerState::retreating);
}

bool PickerMachine::watch_gripper() noexcept {
  if (*view_->gripper.trouble != '\0') {
    if (state_ != PickerState::gripper_trouble) enter(PickerState::gripper_trouble);
    // Of fingers that did not come to rest it is activated, and goes on when it is told again.
    if (!view_->gripper.moving && wishes_->open_gripper) act_ = PickerAct::activate;
    return true;
  }
  if (state_ != PickerState::gripper_trouble) return false;
  enter(PickerState::off, "the gripper had trouble");
  return true;
}

bool PickerMachine::watch_person() noexcept {
  const bool wants = wishes_->pick && !view_->stop_requested && !view_->finishing;
  if (state_ == PickerState::paused) {
    if (wants) enter(PickerState::retreating);
    return true;
  }
  // A part that is about to be taken or held is brought away, unless all has to stop.
  const bool finishes = in_hand_ || state_ == PickerState::descending || state_ == PickerState::closing ||
                        state_ == PickerState::releasing;
  if (wants || (finishes && !view_->stop_requested)) return false;
  enter(PickerState::paused, view_->stop_requested ? "a stop is requested"
                             : view_->finishing    ? "the application ends"
                                                   : "picking is switched off");
  return true;
}

bool PickerMachine::watch_arm() noexcept {
  if (view_->others_lead) {
    if (state_ != PickerState::led_by_others) enter(PickerState::led_by_others);
    entered_ = view_->now;
    return true;
  }
  if (state_ != PickerState::led_by_others) return false;
  if (view_->now - entered_ > picker::hand_pause) enter(PickerState::retreating);
  return true;
}

/// One picture now and then is no sight to move by.
bool PickerMachine::watch_sight() noexcept {
  const bool is_blind = view_->tracks == nullptr;
  if (state_ != PickerState::no_sight) {
    if (!is_blind || !picker::needs_sight(state_)) return false;
    enter(PickerState::no_sight);
    return true;
  }
  if (is_blind) {
    if (pictures_ > 0) cause_ = "pictures that can be used come too seldom";
    pictures_ = 0;
    return true;
  }
  if (pictures_ < picker::sees_again) return true;
  enter(PickerState::retreating);
  return false;
}

/// An arm that does not get there does not try for ever.
bool PickerMachine::watch_progress() noexcept {
  if (!picker::is_on_way(state_)) return false;
  const bool rests = view_->now - moved_ > picker::stuck;
  if (!rests && view_->now - entered_ <= wishes_->leg_timeout) return false;
  // An arm that says why it does not go there cannot get to this part. One that just does not move would be
  // no better with another one: it is led on, until it moves.
  const bool is_stuck = rests && *view_->arm_holds == '\0';
  const auto led_to = led_to_;
  if (!is_stuck && picker::is_on_way_to_part(state_)) leave_alone(track_.identity);
  fail(PickerState::unreachable, is_stuck ? "the arm does not move where it is led"
                                 : rests  ? "the arm does not get there"
                                          : "the way takes too long");
  if (is_stuck) stuck_on_ = led_to;
  return true;
}

void PickerMachine::act_in_state() noexcept {
  switch (state_) {
    case PickerState::surveying:
      return survey();
    case PickerState::waiting:
      return watch();
    case PickerState::approaching:
      return approach();
    case PickerState::looking:
      return look();
    case PickerState::descending:
      return descend();
    case PickerState::closing:
      return close();
    case PickerState::lifting:
      return lift();
    case PickerState::carrying:
      return carry();
    case PickerState::looking_into_bin:
      return look_into_bin();
    case PickerState::lowering:
      return lower();
    case PickerState::releasing:
      return release();
    case PickerState::unreachable:
    case PickerState::blocked:
      if (stuck_on_) return push_on();
      return is_watching_ ? watch() : waits_at_bin_ ? look_into_bin() : rise_and_go_on();
    case PickerState::retreating:
    case PickerState::target_lost:
    case PickerState::grasp_failed:
    case PickerState::part_lost:
      return rise_and_go_on();
    case PickerState::unknown_in_hand:
      if (wishes_->open_gripper) open(plan_.hand.widest);
      if (view_->gripper.object == GripperObject::none && !view_->gripper.moving)
        enter(PickerState::retreating);
      return;
    case PickerState::off:
    case PickerState::paused:
    case PickerState::no_sight:
    case PickerState::led_by_others:
    case PickerState::gripper_trouble:
      return;
  }
}

void PickerMachine::push_on() noexcept {
  target_ = stuck_on_;
  if (!view_->arm_rests) stuck_on_.reset();
}

/// Whatever was tried is over: up, and on with what there is.
void PickerMachine::fail(PickerState state, const char* cause) noexcept {
  if (picker::is_on_way_to_part(state_) && state != PickerState::grasp_failed) {
    if (state == PickerState::target_lost) {
      ++counters_.lost_targets;
    } else {
      ++counters_.given_up;
    }
  }
  enter(state, cause);
  aim(tip(), hand_angle());
}

void PickerMachine::open_for_grasp() noexcept {
  needs_opening_ = false;
  open(grasp_.opening);
}

void PickerMachine::open(double opening) noexcept {
  act_ = PickerAct::open;
  opening_ = opening;
}

bool PickerMachine::fingers_hold() const noexcept {
  return view_->gripper.object == GripperObject::gripped ||
         view_->gripper.object == GripperObject::gripped_inside;
}

void PickerMachine::enter(PickerState state, const char* cause) noexcept {
  // What closing fingers have between them when others come between is the part.
  if (state_ == PickerState::closing && state != PickerState::lifting && state != PickerState::grasp_failed)
    in_hand_ = true;
  if (state_ == PickerState::releasing && in_hand_) is_release_cut_short_ = true;
  if (picker::is_on_way_to_part(state_) && picker::interrupts(state)) ++counters_.interrupted;
  if (state != PickerState::approaching && !picker::is_on_way_to_part(state) &&
      state != PickerState::closing && !in_hand_ && state != PickerState::lifting)
    track_.identity = 0;
  state_ = state;
  // Whatever came between: what it did not take it does not drop.
  if (state == PickerState::retreating && !in_hand_ && fingers_hold()) state_ = PickerState::unknown_in_hand;
  cause_ = cause;
  entered_ = view_->now;
  moved_ = view_->now;
  pictures_ = 0;
  watched_pictures_ = 0;
  is_watching_ = false;
  waits_at_bin_ = false;
  stuck_on_.reset();
  is_frozen_ = false;
  is_straight_ = false;
  rest_pictures_ = 0;
  // Straight up from here, whoever brought the arm here.
  if (view_->tool) way_begin_ = tip().head<2>();
}

}  // namespace flexrf::user
