#include "apps/pick-station/units/pick_sequence/pick_sequence.hpp"

#include "apps/pick-station/units/pick_sequence/pick_messages.hpp"
#include "hal/gripper/interface/gripper.hpp"
#include "hal/modbus/station/interface/modbus_station.hpp"

namespace flexrf::user {

Status PickSequence::initialise() {
  const auto present = station->input("part_present");
  const auto next = station->output("next_part");
  if (!present) return present.status();
  if (!next) return next.status();
  part_present_ = *present;
  next_part_ = *next;
  machine_.begin({.feeder = configuration.feeder,
                  .tray = configuration.tray,
                  .travel_height = configuration.travel_height,
                  .step_timeout = duration_of(configuration.step_timeout),
                  .homing_timeout = duration_of(configuration.homing_timeout)});
  return {};
}

void PickSequence::step(const Tick& tick) {
  const PickView view = look(tick);
  const PickWishes wished = wishes();
  if (runtime.clear_counters > 0) machine_.clear_counters();
  machine_.step(view, wished);
  command();
  tell(view, wished);
}

PickView PickSequence::look(const Tick& tick) noexcept {
  PickView view;
  view.now = tick.now;
  view.may_move = !tick.motion_inhibited;
  view.stop_requested = tick.stop_requested;
  if (gantry.latest().copy_to(gantry_now_)) view.gantry = &gantry_now_;
  view.gripper.detects = gripper->capabilities().detects_object;
  view.gripper.trouble = gripper->fault().is_ok() ? gripper->trouble().cause() : gripper->fault().cause();
  if (const auto state = gripper->state()) {
    view.gripper.known = true;
    view.gripper.activated = state->activated;
    view.gripper.moving = state->moving;
    view.gripper.object = state->object;
  }
  if (const ModbusValue part = station->read(part_present_)) {
    view.part = part.value > 0.5;
  } else {
    view.station = name_of(part.reason);
  }
  if (const auto seen = sight.latest()) view.sight = seen->seen;
  if (const auto stop = button.latest()) view.stop_is_pressed = !stop->released;
  return view;
}

PickWishes PickSequence::wishes() const noexcept {
  return {.start = runtime.start > 0,
          .hold = runtime.hold > 0,
          .home = runtime.home > 0,
          .reset = runtime.reset > 0,
          .next_step = runtime.next_step > 0,
          .open_gripper = runtime.open_gripper > 0,
          .close_gripper = runtime.close_gripper > 0,
          .mode = runtime.mode,
          .speed = runtime.speed,
          .batch = runtime.batch,
          .grip_attempts = runtime.grip_attempts,
          .patience = duration_of(runtime.patience),
          .ask_camera = runtime.ask_camera};
}

void PickSequence::command() noexcept {
  order.publish(machine_.order());
  switch (machine_.gripper_act()) {
    case GripperAct::none:
      break;
    case GripperAct::activate:
      gripper->activate();
      break;
    case GripperAct::open:
      gripper->open();
      break;
    case GripperAct::close:
      gripper->close();
      break;
  }
  station->set(next_part_, machine_.next_part() ? 1 : 0);
}

void PickSequence::tell(const PickView& view, const PickWishes& wished) noexcept {
  signal.publish(lamps(view));
  const PickMessage text = describe(machine_, view, wished);
  const PickMachine::Counters& counters = machine_.counters();
  feedback.state = machine_.state();
  feedback.set_message(text.message.data());
  feedback.set_remedy(text.remedy);
  feedback.parts = counters.parts;
  feedback.cycle_time = counters.cycle_time;
  feedback.missed_grips = counters.missed_grips;
  feedback.lost_parts = counters.lost_parts;
  feedback.faults = counters.faults;
  feedback.part_present = view.part.value_or(false);
  feedback.holds_part =
      view.gripper.object == GripperObject::gripped || view.gripper.object == GripperObject::gripped_inside;
}

/// Green: it works by itself. Yellow blinks: it waits for a part or a person; steady: a person works it.
/// Red: it cannot go on.
TowerSignal PickSequence::lamps(const PickView& view) const noexcept {
  TowerSignal shown{};
  const bool works = machine_.is_in_cycle() && !machine_.waits_long();
  const bool prepares = machine_.state() == PickState::homing || machine_.state() == PickState::recovering;
  if (machine_.state() == PickState::fault || view.stop_is_pressed) {
    shown.red = LampMode::on;
  } else if (works && runtime.mode == PickMode::automatic) {
    shown.green = LampMode::on;
  } else if (works || prepares) {
    shown.yellow = LampMode::on;
  } else {
    shown.yellow = LampMode::blink;
  }
  return shown;
}

}  // namespace flexrf::user
