#include "units/part_picker/picker_messages.hpp"

#include <cstdarg>
#include <cstdio>
#include <string_view>

#include "units/vision/part_model.hpp"

namespace flexrf::user {
namespace {

class Writer {
 public:
  [[gnu::format(printf, 3, 4)]] void say(const char* remedy, const char* format, ...) noexcept {
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text_.message.data(), text_.message.size(), format, arguments);
    va_end(arguments);
    text_.remedy = remedy;
  }
  const PickerMessage& text() const noexcept { return text_; }

 private:
  PickerMessage text_;
};

const char* part_name(const PickerMachine& machine) {
  const PartModel* const part = machine.parts().find(machine.part().kind);
  return part != nullptr ? part->name.data() : "part";
}

/// Of states in which it gave something up, or has nothing to do.
void describe_trouble(Writer& writer, const PickerMachine& machine, const PickerView& view) {
  const char* const cause = machine.cause();
  switch (machine.state()) {
    case PickerState::target_lost:
      return writer.say("", "The part was lost: %s. Going up to choose another.", cause);
    case PickerState::unreachable:
      if (*view.arm_holds != '\0')
        return writer.say("See to the arm's page.", "Out of reach: %s (%.120s).", cause, view.arm_holds);
      if (machine.is_stuck())
        return writer.say("See what holds the arm; it goes on by itself.", "Stuck: %s.", cause);
      return writer.say("Lay the part nearer, or see to the arm's page.", "Out of reach: %s.", cause);
    case PickerState::blocked:
      return writer.say("Take away what is in the way; it goes on by itself.", "The way is blocked: %s.",
                        cause);
    case PickerState::grasp_failed:
      return writer.say("If it happens again, see to the calibration of the camera.",
                        "The grasp failed: %s. Going up to try again.", cause);
    case PickerState::part_lost:
      return writer.say("See where the part lies; it goes on by itself.", "The part is lost: %s.", cause);
    case PickerState::unknown_in_hand:
      return writer.say("Hold a hand below it and press Open gripper.",
                        "The fingers hold something that was not picked by this program.");
    case PickerState::gripper_trouble:
      return writer.say("See to the gripper; Open gripper activates it anew.",
                        "The gripper cannot go on: %.180s", view.gripper.trouble);
    default:
      return;
  }
}

}  // namespace

PickerMessage describe(const PickerMachine& machine, const PickerView& view, const char* sight) noexcept {
  Writer writer;
  const char* const part = part_name(machine);
  switch (machine.state()) {
    case PickerState::off:
      if (view.arm_is_in_fault) {
        writer.say("See to the arm, initialise it on its page, and give Start.", "Not moving: %.220s.",
                   view.arm_holds);
        break;
      }
      writer.say(view.may_move ? "Wait; if it lasts, see to the arm and the gripper."
                               : "See that nobody is in the way; clear a stop, and give Start.",
                 "Not moving: %s.", machine.cause());
      break;
    case PickerState::paused:
      writer.say("Switch Pick on to go on.", "Paused: %s.", machine.cause());
      break;
    case PickerState::no_sight: {
      const std::string_view why = *machine.cause() != '\0' ? machine.cause()
                                   : *sight != '\0'         ? sight
                                                    : "pictures come again, and a few more are waited for";
      writer.say(
          "See to the camera, the lens and the light, and what the unit of its pictures says; it goes on by "
          "itself.",
          "The camera tells nothing, the arm holds: %.150s%s", why.data(), why.ends_with('?') ? "" : ".");
      break;
    }
    case PickerState::led_by_others:
      writer.say("It goes on half a second after the arm is let go in mode shared or automatic.",
                 "The arm is led by hand, or its mode is manual.");
      break;
    case PickerState::surveying:
      writer.say("", machine.is_in_doubt()
                         ? "Looking whether the part lies in its bin: its release was interrupted."
                         : "Looking at the whole table.");
      break;
    case PickerState::waiting:
      writer.say(view.nobody_looks ? "See to the members of attention, and what their evolution says."
                                   : "Lay parts onto the table; it goes on by itself.",
                 "Waiting: %s.", machine.cause());
      break;
    case PickerState::approaching:
      writer.say("", "Going to a %s.", part);
      break;
    case PickerState::looking:
      writer.say("", "Measuring the %s from near by.", part);
      break;
    case PickerState::descending:
      writer.say("", "Going down to the %s.", part);
      break;
    case PickerState::closing:
      writer.say("", "Closing the fingers on the %s.", part);
      break;
    case PickerState::lifting:
      writer.say("", "Lifting the %s.", part);
      break;
    case PickerState::carrying:
      writer.say("", "Bringing the %s to its bin.", part);
      break;
    case PickerState::looking_into_bin:
      writer.say("", "Looking into the bin before it goes down with the %s.", part);
      break;
    case PickerState::lowering:
      writer.say("", "Going down into the bin with the %s.", part);
      break;
    case PickerState::releasing:
      if (*machine.cause() != '\0') {
        writer.say("See what holds the fingers; they are opened again and again.",
                   "Letting go of the %s: %s.", part, machine.cause());
      } else {
        writer.say("", "Letting go of the %s.", part);
      }
      break;
    case PickerState::retreating:
      writer.say("", "Going up to begin anew.");
      break;
    default:
      describe_trouble(writer, machine, view);
      break;
  }
  return writer.text();
}

}  // namespace flexrf::user
