// What a person's hand wants, of each thing that it may hold.
#pragma once

#include <Eigen/Core>

#include "types/held_keys.hpp"
#include "types/joystick_state.hpp"
#include "types/pointer_state.hpp"

namespace flexrf::user {

struct Hand {
  bool present = false;
  bool dead_man = false;  ///< the button is held
  bool at_rest = true;    ///< but for the button, nothing asks for motion
  /// Parts of full speed along x, y and z of the base frame; no longer than 1.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// The space bar, and w/s, a/d, q/e as for the unit jog.
Hand hand_on_keys(const HeldKeys& held) noexcept;

struct JoystickUse {
  std::size_t dead_man = 0;
  std::size_t axes[3] = {1, 0, 4};
  double signs[3] = {-1, -1, -1};
};
Hand hand_on_joystick(const JoystickState& state, const JoystickUse& use) noexcept;

/// A mouse moves the tool by distances. They are caught up with smoothly, within a tenth of a second and at
/// most at full speed; what is too much for that is dropped, so that nothing runs on when the hand rests.
class PointerHand {
 public:
  /// m for a count, and for a detent of the wheel.
  struct Scale {
    double count = 0;
    double detent = 0;
  };

  /// Nothing is asked for, and what came until now is not made up for.
  void let_go(const PointerState& state) noexcept;
  /// In m/s, after `elapsed` s.
  Eigen::Vector3d follow(const PointerState& state, const Scale& scale, double speed,
                         double elapsed) noexcept;

 private:
  Eigen::Vector3d ahead_ = Eigen::Vector3d::Zero();  // m, the hand of the tool
  PointerState seen_{};
};

}  // namespace flexrf::user
