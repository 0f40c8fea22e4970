// HandJog: a keyboard, a mouse or a joystick in a person's hand gives the tool a velocity.
//
// Nothing moves unless a dead-man button is held, and none counts that was down before: when the thing was
// plugged in, or motion was permitted, or while a key, an axis or another button asked for motion already.
// What is unplugged, or is not heard of for a tenth of a second, has let go.
#pragma once

#include <array>

#include "hand_jog_unit.hpp"
#include "units/hand_jog/hand.hpp"

namespace flexrf::user {

class HandJog final : public HandJogUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  static constexpr std::size_t hand_count = 3;

  std::array<Hand, hand_count> hands() noexcept;
  void choose(const std::array<Hand, hand_count>& hands, bool permitted) noexcept;

  std::array<bool, hand_count> ready_{};  // its dead-man button was up, and nothing asked for motion
  HandSource source_ = HandSource::none;
  PointerHand pointer_hand_;
};

}  // namespace flexrf::user
