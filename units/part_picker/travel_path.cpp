#include "units/part_picker/travel_path.hpp"

#include <algorithm>
#include <limits>

namespace flexrf::user {
namespace {

using Eigen::Vector2d;

// Corners lie so far outside of their own box that a way along its side is free.
constexpr double outside = 1e-4;  // m

}  // namespace

void TravelPath::use(std::span<const KeepOut> boxes, double height, double room) noexcept {
  box_count_ = 0;
  for (const KeepOut& box : boxes) {
    const bool is_one = box.from[0] < box.to[0] && box.from[1] < box.to[1] && box.from[2] < box.to[2];
    if (!is_one || box.to[2] <= height || box_count_ == most_keep_outs) continue;
    boxes_[box_count_++] = {Vector2d(box.from[0] - room, box.from[1] - room),
                            Vector2d(box.to[0] + room, box.to[1] + room)};
  }
}

bool TravelPath::is_kept_out(const Vector2d& place) const noexcept {
  return std::any_of(boxes_.begin(), boxes_.begin() + box_count_, [&](const Rectangle& box) {
    return (place.array() > box.from.array()).all() && (place.array() < box.to.array()).all();
  });
}

/// No box between the two (Liang and Barsky 1984).
bool TravelPath::is_free(const Vector2d& one, const Vector2d& other) const noexcept {
  const Vector2d way = other - one;
  return std::none_of(boxes_.begin(), boxes_.begin() + box_count_, [&](const Rectangle& box) {
    double begin = 0;
    double end = 1;
    for (int i = 0; i < 2; ++i) {
      if (way[i] == 0) {
        if (one[i] <= box.from[i] || one[i] >= box.to[i]) return false;
        continue;
      }
      const double first = (box.from[i] - one[i]) / way[i];
      const double second = (box.to[i] - one[i]) / way[i];
      begin = std::max(begin, std::min(first, second));
      end = std::min(end, std::max(first, second));
    }
    return begin < end;
  });
}

bool TravelPath::plan(const Vector2d& from, const Vector2d& to) noexcept {
  count_ = 0;
  if (is_kept_out(from)) {
    why_ = "the hand is where it may not be: move it out by hand";
    return false;
  }
  if (is_kept_out(to)) {
    why_ = "the place is kept free";
    return false;
  }
  std::array<Vector2d, most_points> places;
  std::array<double, most_points> length;
  std::array<std::size_t, most_points> before{};
  std::array<bool, most_points> done{};
  length.fill(std::numeric_limits<double>::infinity());
  places[0] = from;
  places[1] = to;
  std::size_t count = 2;
  for (std::size_t i = 0; i < box_count_; ++i) {
    const Vector2d low = boxes_[i].from - Vector2d::Constant(outside);
    const Vector2d high = boxes_[i].to + Vector2d::Constant(outside);
    places[count++] = low;
    places[count++] = {high.x(), low.y()};
    places[count++] = high;
    places[count++] = {low.x(), high.y()};
  }
  length[0] = 0;
  for (std::size_t round = 0; round < count; ++round) {
    std::size_t nearest = count;
    for (std::size_t i = 0; i < count; ++i)
      if (!done[i] && (nearest == count || length[i] < length[nearest])) nearest = i;
    if (nearest == 1 || length[nearest] == std::numeric_limits<double>::infinity()) break;
    done[nearest] = true;
    for (std::size_t i = 0; i < count; ++i) {
      if (done[i] || is_kept_out(places[i]) || !is_free(places[nearest], places[i])) continue;
      const double along = length[nearest] + (places[i] - places[nearest]).norm();
      if (along >= length[i]) continue;
      length[i] = along;
      before[i] = nearest;
    }
  }
  if (length[1] == std::numeric_limits<double>::infinity()) {
    why_ = "there is no way around what is kept free";
    return false;
  }
  for (std::size_t i = 1; i != 0; i = before[i]) points_[count_++] = places[i];
  std::reverse(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(count_));
  why_ = "";
  return true;
}

}  // namespace flexrf::user
