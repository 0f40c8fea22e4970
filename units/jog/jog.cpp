#include "units/jog/jog.hpp"

#include "units/motion/key_motion.hpp"

namespace flexrf {

Status Jog::initialise() {
  target_.reset();
  return {};
}

void Jog::step(const Tick& tick) {
  if (tick.motion_inhibited) {
    // A key pressed while nothing may move is not kept for when it may, and the target stays with the arm.
    while (keys.pop()) continue;
    target_.reset();
  }
  if (!target_) {
    const auto pose = actual.latest();
    if (!pose) return;  // keys wait until it is known where the arm is
    target_ = *pose;
  }
  while (const auto key = keys.pop()) {
    if (move_by_key(*target_, *key, runtime.step, runtime.turn)) ++feedback.presses;
  }
  target.publish(*target_);
}

}  // namespace flexrf
