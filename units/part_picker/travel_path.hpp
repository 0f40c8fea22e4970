// TravelPath: the shortest way of the hand from one place to another at the height at which it travels,
// around the boxes into which it may not come.
//
// Among corners of boxes that see each other (visibility graph: Lozano-Perez and Wesley 1979), the shortest
// by Dijkstra. At most 8 boxes, thus 34 points; bounded time, no allocation.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "types/keep_out.hpp"

namespace flexrf::user {

inline constexpr std::size_t most_keep_outs = 8;

class TravelPath {
 public:
  /// Boxes that reach above `height` (m) count, each wider by `room` (m) to all sides.
  void use(std::span<const KeepOut> boxes, double height, double room) noexcept;

  /// Plans. False, and no point to go to: the way is blocked, why() says by what.
  bool plan(const Eigen::Vector2d& from, const Eigen::Vector2d& to) noexcept;
  /// The points to go to, one after the other; the last is `to`.
  std::span<const Eigen::Vector2d> points() const noexcept { return {points_.data(), count_}; }
  /// Lives for ever.
  const char* why() const noexcept { return why_; }

  /// The place lies within a box, or nearer to it than there has to be room.
  bool is_kept_out(const Eigen::Vector2d& place) const noexcept;

 private:
  struct Rectangle {
    Eigen::Vector2d from;
    Eigen::Vector2d to;
  };
  static constexpr std::size_t most_points = 4 * most_keep_outs + 2;

  bool is_free(const Eigen::Vector2d& one, const Eigen::Vector2d& other) const noexcept;

  std::array<Rectangle, most_keep_outs> boxes_{};
  std::size_t box_count_ = 0;
  std::array<Eigen::Vector2d, most_points> points_{};
  std::size_t count_ = 0;
  const char* why_ = "";
};

}  // namespace flexrf::user
