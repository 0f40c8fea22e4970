// Of PickMachine: how it gets from one state to the next, and what each begins with.
#include "apps/pick-station/units/pick_sequence/pick_machine.hpp"

namespace flexrf::user {

void PickMachine::enter(PickState state) noexcept {
  state_ = state;
  entered_ = view_->now;
  stage_ = 0;
  switch (state) {
    case PickState::homing:
    case PickState::recovering:
      cycle_began_ = Time{};
      hold_wished_ = false;
      act_ = GripperAct::activate;
      break;
    case PickState::to_feeder:
      cycle_began_ = view_->now;
      act_ = GripperAct::open;
      order(GantryCommand::move, {plan_.feeder[0], plan_.travel_height});
      break;
    case PickState::lowering:
      order(GantryCommand::move, plan_.feeder);
      break;
    case PickState::gripping:
      attempts_ = 0;
      act_ = GripperAct::close;
      break;
    case PickState::lifting:
      order(GantryCommand::move, {plan_.feeder[0], plan_.travel_height});
      break;
    case PickState::to_tray:
      order(GantryCommand::move, {plan_.tray[0], plan_.travel_height});
      break;
    case PickState::placing:
      order(GantryCommand::move, plan_.tray);
      break;
    case PickState::releasing:
      act_ = GripperAct::open;
      break;
    case PickState::rising:
      order(GantryCommand::move, {plan_.tray[0], plan_.travel_height});
      break;
    case PickState::off:
    case PickState::interrupted:
    case PickState::fault:
      cycle_began_ = Time{};
      break;
    case PickState::not_homed:
    case PickState::ready:
    case PickState::waiting_for_part:
    case PickState::held:
      break;
  }
}

/// A step is done. The next one follows, unless a person wants to be asked.
void PickMachine::complete(PickState next) noexcept {
  if (state_ == PickState::lifting) {
    ask_for_next_part();
    took_part_ = false;
  }
  resume_ = next;
  const bool waits = hold_wished_ || wishes_->mode == PickMode::manual;
  if (waits) cycle_began_ = Time{};
  enter(waits ? PickState::held : next);
}

/// The axes brake; the gripper ends what it is at.
void PickMachine::hold() noexcept {
  if (state_ == PickState::gripping || state_ == PickState::releasing) {
    hold_wished_ = true;
    return;
  }
  order(GantryCommand::hold);
  cycle_began_ = Time{};
  if (is_in_cycle()) {
    resume_ = state_;
    enter(PickState::held);
  } else {
    was_interrupted_ = true;
    enter(state_ == PickState::homing ? PickState::not_homed : PickState::interrupted);
  }
}

void PickMachine::give_up(PickTrouble trouble, const Status& cause) noexcept {
  if (state_ != PickState::off && view_->gantry != nullptr && view_->gantry->enabled)
    order(GantryCommand::hold);
  ++counters_.faults;
  trouble_ = trouble;
  cause_ = cause;
  resume_ = state_;
  was_interrupted_ = true;
  enter(PickState::fault);
}

void PickMachine::fail_of_gantry(const char* otherwise) noexcept {
  const GantryState* gantry = view_->gantry;
  const bool tells = gantry != nullptr && gantry->trouble[0] != '\0';
  give_up(PickTrouble::gantry,
          Status::error(StatusCode::device_fault, "%.199s", tells ? gantry->trouble.data() : otherwise));
}

void PickMachine::order(GantryCommand command, std::array<double, 2> point) noexcept {
  ++order_.number;
  order_.command = command;
  order_.point = point;
  order_.speed = wishes_->speed;
}

/// An order that was given up is a fault.
bool PickMachine::order_is_done() noexcept {
  const GantryState& gantry = *view_->gantry;
  if (gantry.order != order_.number || gantry.outcome == GantryOutcome::busy) return false;
  if (gantry.outcome == GantryOutcome::done) return true;
  fail_of_gantry("the axes gave up");
  return false;
}

void PickMachine::move_when_done(PickState next) noexcept {
  if (order_is_done()) complete(next);
}

bool PickMachine::holds_part() const noexcept {
  const GripperObject object = view_->gripper.object;
  return object == GripperObject::gripped || object == GripperObject::gripped_inside;
}

}  // namespace flexrf::user
