#include "apps/pick-station/units/pick_sequence/pick_messages.hpp"

#include <cstdarg>
#include <cstdio>

namespace flexrf::user {
namespace {

const char* words_of(PickState state) {
  switch (state) {
    case PickState::homing:
      return "finding the homes";
    case PickState::recovering:
      return "going up and opening the gripper";
    case PickState::to_feeder:
      return "going to the feeder";
    case PickState::waiting_for_part:
      return "looking for a part";
    case PickState::lowering:
      return "going down to the part";
    case PickState::gripping:
      return "closing the gripper";
    case PickState::lifting:
      return "lifting the part";
    case PickState::to_tray:
      return "going to the tray";
    case PickState::placing:
      return "going down to the tray";
    case PickState::releasing:
      return "opening the gripper";
    case PickState::rising:
      return "going up";
    default:
      return "beginning";
  }
}

class Writer {
 public:
  [[gnu::format(printf, 3, 4)]] void say(const char* remedy, const char* format, ...) noexcept {
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text_.message.data(), text_.message.size(), format, arguments);
    va_end(arguments);
    text_.remedy = remedy;
  }
  const PickMessage& text() const noexcept { return text_; }

 private:
  PickMessage text_;
};

void describe_off(Writer& writer, const PickMachine& machine, const PickView& view) {
  if (view.stop_is_pressed) {
    writer.say("Release the emergency stop, clear the stop and give Start.",
               "The emergency stop is pressed, or its line is cut.");
  } else if (view.may_move && view.gantry != nullptr && view.gantry->trouble[0] != '\0') {
    writer.say("See to the drive and initialise it on its page; then give Start.",
               "The axes do not follow: %.199s", view.gantry->trouble.data());
  } else if (view.may_move) {
    writer.say("Wait; if it lasts, see to the drives' supply.", "The drives are being enabled.");
  } else if (machine.trouble() != PickTrouble::none) {
    writer.say("See to the cause, then give Start and press Reset.", "Stopped; before that: %s",
               *machine.cause() == '\0' ? "a fault" : machine.cause());
  } else {
    writer.say("See that nobody is in the way; clear a stop, and give Start.", "Nothing may move.");
  }
}

void describe_fault(Writer& writer, const PickMachine& machine) {
  switch (machine.trouble()) {
    case PickTrouble::gantry:
      writer.say(
          "See to the drive and initialise it on its page; then give Start, press Reset, and Home if asked.",
          "The axes cannot go on: %s", machine.cause());
      break;
    case PickTrouble::gripper:
      writer.say("See to the gripper and press Reset: it may open and drop its part.",
                 "The gripper cannot go on: %s", machine.cause());
      break;
    case PickTrouble::nothing_gripped:
      writer.say("See how the part lies and press Reset; then Start.",
                 "The gripper closed on nothing although the feeder says that there is a part.");
      break;
    case PickTrouble::part_lost:
      writer.say("Take the part out of the way and press Reset; then Start.",
                 "The part was lost on the way to the tray.");
      break;
    case PickTrouble::too_slow:
      writer.say("See what is in the way and press Reset.", "It took too long, %s.",
                 words_of(machine.resumes_with()));
      break;
    case PickTrouble::none:
      break;
  }
}

void describe_waiting(Writer& writer, const PickMachine& machine, const PickView& view,
                      const PickWishes& wishes) {
  if (!machine.waits_long()) return writer.say("", "Looking for a part at the feeder.");
  if (!view.part) {
    writer.say("See to the station's supply and its cable; it goes on by itself.",
               "The IO station does not answer: %s", view.station);
  } else if (!*view.part) {
    writer.say("Fill the feeder; it goes on by itself.", "The feeder is empty.");
  } else if (machine.next_part()) {
    writer.say("See to the feeder; it goes on when the part sensor was free.",
               "The feeder was told to bring a part and does not move.");
  } else if (wishes.ask_camera && !view.sight) {
    writer.say("See to the camera, or do without it: ask_camera.", "The camera gives no pictures.");
  } else {
    writer.say("See to the feeder, or to the camera's window and threshold.",
               "The feeder says that there is a part, and the camera does not see it.");
  }
}

}  // namespace

PickMessage describe(const PickMachine& machine, const PickView& view, const PickWishes& wishes) noexcept {
  Writer writer;
  const bool automatic = wishes.mode == PickMode::automatic;
  switch (machine.state()) {
    case PickState::off:
      describe_off(writer, machine, view);
      break;
    case PickState::not_homed:
      writer.say("See that the way up is free and press Home.",
                 "The axes have not found their homes, or the gripper is not activated.");
      break;
    case PickState::homing:
      if (*view.gripper.trouble == '\0') {
        writer.say("", "Finding the homes: first up, then across.");
      } else {
        writer.say("If it lasts, see to the gripper.", "Waiting for the gripper: %s", view.gripper.trouble);
      }
      break;
    case PickState::ready:
      writer.say(automatic ? "Start picking begins." : "Step does the first step.", "%s",
                 machine.batch_is_done() ? "Ready: the batch is done." : "Ready.");
      break;
    case PickState::held:
      writer.say(automatic ? "Start picking goes on; Reset lifts the gripper and begins anew."
                           : "Step does it; Reset lifts the gripper and begins anew.",
                 "Held before %s.", words_of(machine.resumes_with()));
      break;
    case PickState::interrupted:
      writer.say("See that the way up is free and press Reset; then Start picking.",
                 "Stopped in the middle of something.");
      break;
    case PickState::recovering:
      writer.say("", "Going up, and opening the gripper unless it holds a part.");
      break;
    case PickState::waiting_for_part:
      describe_waiting(writer, machine, view, wishes);
      break;
    case PickState::fault:
      describe_fault(writer, machine);
      break;
    default:
      writer.say("", "Picking: %s.", words_of(machine.state()));
      break;
  }
  return writer.text();
}

}  // namespace flexrf::user
