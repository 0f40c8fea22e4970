#include "units/hand_jog/hand_jog.hpp"

namespace flexrf::user {
namespace {

/// In the order of the hands; of several, the first one that asks has it.
constexpr HandSource sources[] = {HandSource::keyboard, HandSource::pointer, HandSource::joystick};

}  // namespace

Status HandJog::initialise() {
  ready_ = {};
  source_ = HandSource::none;
  pointer_hand_ = {};
  return {};
}

void HandJog::step(const Tick& tick) {
  const std::array<Hand, hand_count> all = hands();
  choose(all, !tick.motion_inhibited && !tick.stop_requested);

  Velocity wanted{};
  const auto mouse = pointer.latest();
  if (mouse && source_ == HandSource::pointer) {
    wanted.linear_map() = pointer_hand_.follow(*mouse, {.count = runtime.count, .detent = runtime.detent},
                                               runtime.speed, seconds(tick.elapsed));
  } else if (mouse) {
    pointer_hand_.let_go(*mouse);
  }
  for (std::size_t i = 0; i < hand_count; ++i)
    if (sources[i] == source_ && source_ != HandSource::pointer)
      wanted.linear_map() = runtime.speed * all[i].direction;
  velocity.publish(wanted);
  feedback.source = source_;
}

std::array<Hand, HandJog::hand_count> HandJog::hands() noexcept {
  std::array<Hand, hand_count> all{};
  if (const auto keys = keyboard.latest()) all[0] = hand_on_keys(*keys);
  if (const auto mouse = pointer.latest()) {
    all[1].present = mouse->present;
    all[1].dead_man = (mouse->buttons >> configuration.pointer_dead_man & 1U) != 0;
  }
  if (const auto stick = joystick.latest()) {
    JoystickUse use{.dead_man = configuration.joystick_dead_man};
    for (std::size_t i = 0; i < 3; ++i) {
      use.axes[i] = configuration.joystick_axes[i];
      use.signs[i] = configuration.joystick_signs[i];
    }
    all[2] = hand_on_joystick(*stick, use);
  }
  return all;
}

/// Which hand, if any, moves the tool in this step.
void HandJog::choose(const std::array<Hand, hand_count>& hands, bool permitted) noexcept {
  HandSource next = HandSource::none;
  bool without_effect = false;
  for (std::size_t i = 0; i < hand_count; ++i) {
    if (!permitted || !hands[i].present) {
      ready_[i] = false;
    } else if (!hands[i].dead_man) {
      ready_[i] = hands[i].at_rest;
    }
    if (!hands[i].present || !hands[i].dead_man) continue;
    without_effect = without_effect || !ready_[i];
    // Who has it keeps it, until the button is let go.
    if (ready_[i] && (next == HandSource::none || sources[i] == source_)) next = sources[i];
  }
  source_ = next;
  if (!without_effect || next != HandSource::none) {
    feedback.set_holding({});
  } else if (!permitted) {
    feedback.set_holding("motion is inhibited, or stop requested");
  } else {
    feedback.set_holding("let go of the dead-man button and of all else, then hold it anew");
  }
}

}  // namespace flexrf::user
