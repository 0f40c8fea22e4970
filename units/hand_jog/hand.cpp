#include "units/hand_jog/hand.hpp"

#include <algorithm>

namespace flexrf::user {
namespace {

constexpr double detent = 120;            // counts of the wheel
constexpr double catching_up = 0.1;       // s
constexpr double next_to_nothing = 1e-6;  // m

bool holds(const HeldKeys& held, char character) noexcept {
  return std::any_of(held.keys.begin(), held.keys.begin() + held.count, [character](const KeyEvent& one) {
    return one.key == Key::character && one.character == static_cast<std::uint32_t>(character);
  });
}

double towards(const HeldKeys& held, char plus, char minus) noexcept {
  return (holds(held, plus) ? 1.0 : 0.0) - (holds(held, minus) ? 1.0 : 0.0);
}

Eigen::Vector3d no_longer_than(const Eigen::Vector3d& vector, double most) noexcept {
  const double length = vector.norm();
  return length > most ? Eigen::Vector3d(vector * (most / length)) : vector;
}

}  // namespace

Hand hand_on_keys(const HeldKeys& held) noexcept {
  Hand hand;
  hand.present = held.present;
  hand.dead_man = holds(held, ' ');
  hand.direction =
      no_longer_than({towards(held, 'w', 's'), towards(held, 'a', 'd'), towards(held, 'q', 'e')}, 1);
  hand.at_rest = hand.direction.isZero(0);
  return hand;
}

Hand hand_on_joystick(const JoystickState& state, const JoystickUse& use) noexcept {
  Hand hand;
  hand.present = state.present;
  hand.dead_man = use.dead_man < state.presses.size() && (state.buttons >> use.dead_man & 1U) != 0;
  for (int i = 0; i < 3; ++i)
    if (use.axes[i] < state.axes.size()) hand.direction[i] = use.signs[i] * state.axes[use.axes[i]];
  hand.direction = no_longer_than(hand.direction, 1);
  hand.at_rest = hand.direction.isZero(0);
  return hand;
}

void PointerHand::let_go(const PointerState& state) noexcept {
  ahead_.setZero();
  seen_ = state;
}

Eigen::Vector3d PointerHand::follow(const PointerState& state, const Scale& scale, double speed,
                                    double elapsed) noexcept {
  const auto since = [](std::int64_t now, std::int64_t before) { return static_cast<double>(now - before); };
  ahead_ += Eigen::Vector3d(-scale.count * since(state.y, seen_.y), -scale.count * since(state.x, seen_.x),
                            scale.detent * since(state.wheel, seen_.wheel) / detent);
  seen_ = state;
  ahead_ = no_longer_than(ahead_, speed * catching_up);
  if (ahead_.norm() < next_to_nothing) ahead_.setZero();
  const Eigen::Vector3d velocity = ahead_ / catching_up;
  ahead_ -= velocity * std::clamp(elapsed, 0.0, catching_up);
  return velocity;
}

}  // namespace flexrf::user
