#include "units/jog/jog.hpp"

#include "units/motion/key_motion.hpp"

namespace flexrf {
namespace {

// However fast keys come, a step ends.
constexpr int most_keys_per_step = 64;

}  // namespace

Status Jog::initialise() {
  target_.reset();
  return {};
}

void Jog::step(const Tick& tick) {
  if (tick.motion_inhibited) {
    // A key pressed while nothing may move is not kept for when it may, and the target stays with the arm.
    for (int n = 0; n < most_keys_per_step && keys.pop(); ++n) continue;
    target_.reset();
  }
  if (!target_) {
    const auto pose = actual.latest();
    if (!pose) return;  // keys wait until it is known where the arm is
    target_ = *pose;
  }
  for (int n = 0; n < most_keys_per_step; ++n) {
    const auto key = keys.pop();
    if (!key) break;
    if (move_by_key(*target_, *key, runtime.step, runtime.turn)) ++feedback.presses;
  }
  target.publish(*target_);
}

}  // namespace flexrf
