#include "apps/pick-station/units/pick_sequence/pick_machine.hpp"

namespace flexrf::user {
namespace {

constexpr Duration shortest_pulse = std::chrono::milliseconds(200);

}  // namespace

void PickMachine::begin(const PickPlan& plan) noexcept {
  // Orders go on counting: the gantry remembers the last one's number.
  const std::uint64_t number = order_.number;
  *this = PickMachine{};
  plan_ = plan;
  order_.number = number;
}

void PickMachine::step(const PickView& view, const PickWishes& wishes) noexcept {
  view_ = &view;
  wishes_ = &wishes;
  act_ = GripperAct::none;
  waits_long_ = false;
  follow_feeder();
  supervise();
  act();
  view_ = nullptr;
  wishes_ = nullptr;
}

/// It is asked for the next part until its place was seen empty, and long enough for it to see that.
void PickMachine::follow_feeder() noexcept {
  if (!next_part_) return;
  saw_place_empty_ = saw_place_empty_ || !view_->part.value_or(true);
  if (saw_place_empty_ && view_->now - asked_since_ >= shortest_pulse) next_part_ = false;
}

void PickMachine::ask_for_next_part() noexcept {
  if (next_part_) return;
  next_part_ = true;
  saw_place_empty_ = false;
  asked_since_ = view_->now;
}

// ---- what ends whatever is under way

void PickMachine::supervise() noexcept {
  const bool was_under_way = state_ != PickState::off && state_ != PickState::ready &&
                             state_ != PickState::not_homed && state_ != PickState::fault;
  if (!view_->may_move) {
    was_interrupted_ = was_interrupted_ || was_under_way;
    permitted_since_ = view_->now;
    if (state_ != PickState::off) enter(PickState::off);
    return;
  }
  if (state_ == PickState::off || state_ == PickState::fault) return;
  if (view_->gantry == nullptr || !view_->gantry->known || !view_->gantry->enabled) {
    return fail_of_gantry("the axes no longer follow");
  }
  const bool prepares = state_ == PickState::homing || state_ == PickState::recovering;
  if (state_ != PickState::not_homed && !(prepares && stage_ == 0) && *view_->gripper.trouble != '\0') {
    give_up(PickTrouble::gripper, Status::error(StatusCode::device_fault, "%s", view_->gripper.trouble));
    return;
  }
  if (!was_under_way || state_ == PickState::held || state_ == PickState::interrupted ||
      state_ == PickState::waiting_for_part)
    return;
  const Duration limit = state_ == PickState::homing ? plan_.homing_timeout : plan_.step_timeout;
  if (view_->now - entered_ <= limit) return;
  if (*view_->gripper.trouble != '\0') {
    give_up(PickTrouble::gripper, Status::error(StatusCode::timeout, "%s", view_->gripper.trouble));
  } else {
    give_up(PickTrouble::too_slow);
  }
}

/// The permission to move is there: what comes next depends on what was before.
void PickMachine::leave_off() noexcept {
  const GantryState* gantry = view_->gantry;
  if (gantry == nullptr || !gantry->known || !gantry->enabled) {
    // Drives take their time to enable; one that cannot says so.
    if (view_->now - permitted_since_ <= plan_.step_timeout) return;
    return fail_of_gantry("the drives do not follow");
  }
  if (trouble_ != PickTrouble::none) return enter(PickState::fault);
  if (!gantry->homed || !view_->gripper.activated) return enter(PickState::not_homed);
  enter(was_interrupted_ ? PickState::interrupted : PickState::ready);
}

// ---- the states

void PickMachine::act() noexcept {
  const bool listens = !view_->stop_requested;
  switch (state_) {
    case PickState::off:
      if (view_->may_move) leave_off();
      break;
    case PickState::not_homed:
      if (listens && wishes_->home) enter(PickState::homing);
      break;
    case PickState::ready:
    case PickState::held:
    case PickState::interrupted:
      if (listens) idle();
      break;
    case PickState::fault:
      if (!listens || !wishes_->reset) break;
      trouble_ = PickTrouble::none;
      cause_ = {};
      if (view_->gantry == nullptr || !view_->gantry->enabled) {
        enter(PickState::off);  // says what is still wrong
      } else {
        enter(view_->gantry->homed ? PickState::recovering : PickState::not_homed);
      }
      break;
    case PickState::homing:
    case PickState::recovering:
      prepare_axes();
      break;
    case PickState::to_feeder:
      move_when_done(PickState::waiting_for_part);
      break;
    case PickState::waiting_for_part:
      wait_for_part();
      break;
    case PickState::lowering:
      move_when_done(PickState::gripping);
      break;
    case PickState::gripping:
      grip();
      break;
    case PickState::lifting:
    case PickState::to_tray:
    case PickState::placing:
      if (view_->gripper.detects && !holds_part() && gripper_rests()) {
        ++counters_.lost_parts;
        return give_up(PickTrouble::part_lost);
      }
      move_when_done(state_ == PickState::lifting   ? PickState::to_tray
                     : state_ == PickState::to_tray ? PickState::placing
                                                    : PickState::releasing);
      break;
    case PickState::releasing:
      release();
      break;
    case PickState::rising:
      if (order_is_done()) finish_cycle();
      break;
  }
  if ((wishes_->hold || !listens) && !is_at_rest()) hold();
}

/// Ready, held or interrupted: it does what a person wants.
void PickMachine::idle() noexcept {
  move_gripper_by_hand();
  if (wishes_->home) return enter(PickState::homing);
  if (wishes_->reset) return enter(PickState::recovering);
  const bool goes_on = wishes_->mode == PickMode::automatic ? wishes_->start : wishes_->next_step;
  if (!goes_on || state_ == PickState::interrupted || !gripper_rests()) return;
  hold_wished_ = false;
  if (state_ == PickState::ready) {
    begin_cycle();
  } else if (moved_by_hand_) {
    enter(PickState::recovering);  // it may be down, with or without a part
  } else {
    enter(resume_);
  }
}

void PickMachine::move_gripper_by_hand() noexcept {
  if (wishes_->mode != PickMode::manual || !gripper_rests()) return;
  if (wishes_->open_gripper) act_ = GripperAct::open;
  if (wishes_->close_gripper) act_ = GripperAct::close;
  moved_by_hand_ = moved_by_hand_ || act_ != GripperAct::none;
}

void PickMachine::begin_cycle() noexcept {
  in_batch_ = 0;
  batch_is_done_ = false;
  // A part that was taken before it was interrupted left an empty place.
  if (took_part_ && (holds_part() || !view_->part.value_or(true))) ask_for_next_part();
  took_part_ = false;
  enter(holds_part() ? PickState::to_tray : PickState::to_feeder);
}

void PickMachine::wait_for_part() noexcept {
  const bool seen = !wishes_->ask_camera || view_->sight.value_or(false);
  if (view_->part.value_or(false) && !next_part_ && seen) {
    if (gripper_rests()) complete(PickState::lowering);
    return;
  }
  waits_long_ = view_->now - entered_ > wishes_->patience;
  cycle_began_ = waits_long_ ? Time{} : cycle_began_;
}

void PickMachine::grip() noexcept {
  if (!gripper_rests()) return;
  if (stage_ == 1) {  // it was opened to close once more
    stage_ = 0;
    act_ = GripperAct::close;
    return;
  }
  if (holds_part() || !view_->gripper.detects) {
    took_part_ = true;
    return complete(PickState::lifting);
  }
  ++counters_.missed_grips;
  if (++attempts_ >= wishes_->grip_attempts) return give_up(PickTrouble::nothing_gripped);
  stage_ = 1;
  act_ = GripperAct::open;
}

void PickMachine::release() noexcept {
  if (!gripper_rests()) return;
  ++counters_.parts;
  complete(PickState::rising);
}

void PickMachine::finish_cycle() noexcept {
  if (cycle_began_ != Time{}) counters_.cycle_time = seconds(view_->now - cycle_began_);
  cycle_began_ = Time{};
  ++in_batch_;
  batch_is_done_ = wishes_->batch > 0 && in_batch_ >= wishes_->batch;
  if (batch_is_done_) {
    enter(PickState::ready);
  } else {
    complete(PickState::to_feeder);
  }
}

/// Homing and recovering: the gripper follows, the axes are where nothing is in the way, and the gripper is
/// open unless it holds a part.
void PickMachine::prepare_axes() noexcept {
  const auto& gripper = view_->gripper;
  switch (stage_) {
    case 0:
      if (!gripper.activated || gripper.moving || *gripper.trouble != '\0') break;
      stage_ = 1;
      if (state_ == PickState::homing) {
        order(GantryCommand::home);
      } else {
        order(GantryCommand::move, {view_->gantry->position[0], plan_.travel_height});
      }
      break;
    case 1:
      if (!order_is_done()) break;
      stage_ = 2;
      if (!holds_part()) act_ = GripperAct::open;
      break;
    default:
      if (!gripper_rests()) break;
      was_interrupted_ = false;
      moved_by_hand_ = false;
      enter(PickState::ready);
      break;
  }
}

}  // namespace flexrf::user
