// ServoDrive: a drive with one axis that follows positions or velocities cyclically.
#pragma once

#include <optional>

#include "servo_drive_interface.hpp"

namespace flexrf {

/// Positions in rad of a rotary axis, in m of a linear one; velocities a second of it.
struct ServoState {
  double position = 0;
  double velocity = 0;
  double following_error = 0;  ///< set-point less position
  bool enabled = false;        ///< it follows; else it is off, or on its way to either
  bool at_internal_limit = false;
};

/// Everything: the thread the drive lives in. With the permission to move, the drive enables itself, with its
/// set-point where it is; that takes as long as the drive takes. Without it, it stops and is off.
class ServoDrive : public ServoDriveInterface {
 public:
  /// What the drive said last, as of this cycle; nothing while it says nothing.
  virtual std::optional<ServoState> state() const noexcept = 0;

  /// Where the axis shall be, sent at the end of the cycle and held until the next command. Kept to the range
  /// and the velocity of the configuration. What is not finite puts the drive in fault. Without effect while
  /// the drive is not enabled, or takes velocities, and not remembered.
  virtual void command_position(double position) noexcept = 0;
  /// Likewise, how fast it shall be; zero once the axis is beyond its range and would go on. Without effect
  /// while the drive takes positions.
  virtual void command_velocity(double velocity) noexcept = 0;
};

}  // namespace flexrf
