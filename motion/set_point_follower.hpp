// SetPointFollower: from where an axis is commanded to the set-points of a controller that follows them as
// they are, one each cycle.
#pragma once

#include <limits>

namespace flexrf {

/// The axis keeps to its range, its velocity and its acceleration; what moves within them is met exactly,
/// what jumps is approached and not passed. Positions in rad, m or whatever else; velocities a second of it.
/// One thread; never blocks, never allocates.
class SetPointFollower {
 public:
  struct Limits {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    double velocity = 1;      ///< above 0
    double acceleration = 1;  ///< above 0
  };

  SetPointFollower() noexcept = default;
  explicit SetPointFollower(const Limits& limits) noexcept : limits_{limits} {}

  /// At rest here, and nothing else is wanted.
  void seed(double at) noexcept;
  /// Finite; kept to the range. Ends a braking.
  void command(double wanted) noexcept;
  /// Comes to rest, and is wanted there, until the next command.
  void brake() noexcept { brakes_ = true; }
  /// The controller may have missed a cycle, in which its axis stood still: from now on it begins at rest.
  void stand() noexcept { velocity_ = 0; }

  /// The set-point `time` seconds after the one before; the same again where that is not above 0.
  double next(double time) noexcept;

  double set_point() const noexcept { return set_point_; }
  /// Where it is on its way to.
  double wanted() const noexcept { return wanted_; }
  bool is_at_rest() const noexcept { return velocity_ == 0; }

 private:
  double pursue(double time) const noexcept;
  double within_range(double velocity, double time) const noexcept;

  Limits limits_;
  bool brakes_ = false;
  double set_point_ = 0;
  double velocity_ = 0;  // of the last cycle
  double wanted_ = 0;
  double wanted_before_ = 0;  // in the last cycle
};

}  // namespace flexrf
