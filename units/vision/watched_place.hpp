// WatchedPlace: the rectangle on the table into which the hand goes down next, as TargetInHand tells of it.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "types/target_in_hand.hpp"
#include "types/vision_region.hpp"

namespace flexrf::user {

/// Lengths in m. Any thread.
class WatchedPlace {
 public:
  explicit WatchedPlace(const TargetInHand& hand) noexcept
      : middle_(hand.watch_map()),
        y_(std::cos(hand.watch_angle), std::sin(hand.watch_angle)),
        angle_(hand.watch_angle),
        room_(Eigen::Vector2d(hand.watch_from_map()), Eigen::Vector2d(hand.watch_to_map())) {}

  bool exists() const noexcept { return room_.min() != room_.max(); }
  /// The rectangle that hand and part take up, along the tool's x and y from the middle between the
  /// fingertips.
  const Eigen::AlignedBox2d& room() const noexcept { return room_; }
  /// The point on the table, in the robot's frame, for coordinates along the tool's x and y.
  Eigen::Vector3d on_table(const Eigen::Vector2d& own) const noexcept {
    const Eigen::Vector2d at = middle_ + own.x() * x() + own.y() * y_;
    return {at.x(), at.y(), 0};
  }
  bool holds(const Eigen::Vector2d& point) const noexcept {
    const Eigen::Vector2d apart = point - middle_;
    return room_.contains(Eigen::Vector2d(apart.dot(x()), apart.dot(y_)));
  }
  /// A job about this place, and not one that was watched before.
  bool is_of(const VisionRegion& region) const noexcept {
    return region.watched && region.expected[0] == middle_.x() && region.expected[1] == middle_.y() &&
           region.expected[2] == angle_;
  }

 private:
  Eigen::Vector2d x() const noexcept { return {-y_.y(), y_.x()}; }

  Eigen::Vector2d middle_;
  Eigen::Vector2d y_;  // the tool's
  double angle_;
  Eigen::AlignedBox2d room_;
};

}  // namespace flexrf::user
