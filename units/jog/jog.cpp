#include "units/jog/jog.hpp"

#include <utility>

#include "base/text.hpp"
#include "units/arm_motion/key_motion.hpp"

namespace flexrf::user {
namespace {

// However fast keys come, a step ends.
constexpr int most_keys_per_step = 64;

double towards(bool plus, bool minus) {
  return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0);
}

}  // namespace

Status Jog::initialise() {
  target_.reset();
  left_behind_ = was_inhibited_ = false;
  return {};
}

void Jog::step(const Tick& tick) {
  const bool held = publish_velocity(tick);
  if (tick.motion_inhibited || held) {
    // A key pressed while nothing may move, or a hand moves the arm, is not kept for afterwards.
    for (int n = 0; n < most_keys_per_step && keys.pop(); ++n) continue;
  }
  // The target stays with an arm that may not move. One that is moved by hand leaves its target behind,
  // until a key asks for a new one.
  left_behind_ = left_behind_ || held;
  // The first step after an inhibition resets it too: the arm may have been moved by hand since the step
  // before.
  const bool was_inhibited = std::exchange(was_inhibited_, tick.motion_inhibited);
  if (tick.motion_inhibited || was_inhibited || (left_behind_ && !keys.is_empty())) target_.reset();
  if (!target_) {
    const auto pose = actual.latest();
    if (!pose) return;  // keys wait until it is known where the arm is
    target_ = *pose;
    left_behind_ = false;
  }
  heed_answer();
  KeyEvent key{};
  ItemHeader pressed{};
  for (int n = 0; n < most_keys_per_step && keys.pop(key, pressed); ++n) {
    if (!tick.may_follow(pressed.sampled_at)) continue;
    if (move_by_key(*target_, key, runtime.step, runtime.turn)) ++feedback.presses;
  }
  target.publish(*target_);
}

/// Further presses must not lead ever farther out of reach, from where as many are needed to come back.
void Jog::heed_answer() {
  const auto said = answer.latest();
  if (!said || !said.is_new()) return;
  feedback.set_refusal(text_view(said->reason));
  if (said->accepted) return;
  ++feedback.refusals;
  target_ = said->kept;
}

/// Whether any arrow is held.
bool Jog::publish_velocity(const Tick& tick) {
  const Eigen::Vector3d direction{towards(runtime.plus_x, runtime.minus_x),
                                  towards(runtime.plus_y, runtime.minus_y),
                                  towards(runtime.plus_z, runtime.minus_z)};
  const bool held = !direction.isZero(0) && !tick.motion_inhibited && !tick.stop_requested;
  Velocity wanted{};
  if (held) wanted.linear_map() = runtime.speed * direction.normalized();
  velocity.publish(wanted);
  return held;
}

}  // namespace flexrf::user
