// How the axis of a simulated drive moves, in the drive's increments.
#pragma once

#include <algorithm>
#include <cmath>

namespace flexrf {

/// One axis without inertia but for what its profiles have. Times in s, above 0.
class DriveMotion {
 public:
  explicit DriveMotion(double position) : position_{position} {}

  double position() const { return position_; }
  double velocity() const { return velocity_; }
  bool is_at_rest() const { return velocity_ == 0; }

  void set_position(double position) { position_ = position; }
  /// The brake is closed.
  void brake() { velocity_ = 0; }
  /// Something is in the way.
  void stop_at(double position) {
    position_ = position;
    velocity_ = 0;
  }
  /// Towards `target` with this speed, without a profile.
  void follow(double target, double speed, double time) {
    const double distance = target - position_;
    const double most = speed * time;
    // A hair more is in reach: what is divided into steps does not end beside its target.
    const bool reached = std::abs(distance) <= most + 1e-6;
    velocity_ = std::clamp(distance, -most, most) / time;
    position_ = reached ? target : position_ + std::clamp(distance, -most, most);
  }
  /// Changes its velocity to this one.
  void ramp(double velocity, double acceleration, double time) {
    const double step = std::clamp(velocity - velocity_, -acceleration * time, acceleration * time);
    velocity_ = std::abs(velocity - velocity_) <= acceleration * time ? velocity : velocity_ + step;
    position_ += velocity_ * time;
  }
  /// To rest at `target` with a profile. True when it is there.
  bool travel(double target, double fastest, double acceleration, double time) {
    const double distance = target - position_;
    const double most = std::min(fastest, std::sqrt(2 * acceleration * std::abs(distance)));
    if (std::abs(distance) <= most * time || std::abs(distance) < 0.5) {
      position_ = target;
      velocity_ = 0;
      return true;
    }
    ramp(distance > 0 ? most : -most, acceleration, time);
    return false;
  }

 private:
  double position_;
  double velocity_ = 0;
};

}  // namespace flexrf
