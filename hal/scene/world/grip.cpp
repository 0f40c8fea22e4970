#include "hal/scene/world/grip.hpp"

#include <algorithm>
#include <limits>

namespace flexrf {
namespace {

constexpr double least_hold = 0.002;  // m that a finger has to reach over a part
// What a part may overlap a finger by that is about to push it.
constexpr double slack = 0.0015;  // m

/// How far what is between the fingers' edges reaches along the closing direction, from the middle, and how
/// much of the fingers' width it takes. False: nothing is there.
struct Slice {
  bool exists = false;
  Extent along;
  double hold = 0;
};
Slice slice_of(const SceneBody& body, const FingerSpace& space, double turn) noexcept {
  Slice slice;
  const PlaneVector across = left_of(space.closing);
  const PlaneVector place = PlaneVector{body.position[0], body.position[1]} - space.middle;
  Extent held{std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
  slice.along = held;
  const OutlinePieces pieces = pieces_of(body);
  for (const Outline& piece : pieces.all()) {
    Outline between = placed(piece, place, body.angle + turn);
    between = cut_by(between, across * space.half_width, across);
    between = cut_by(between, across * -space.half_width, -across);
    if (between.count < 3) continue;
    slice.exists = true;
    const Extent along = extent_along(between, space.closing);
    const Extent over = extent_along(between, across);
    slice.along = {std::min(slice.along.low, along.low), std::max(slice.along.high, along.high)};
    held = {std::min(held.low, over.low), std::max(held.high, over.high)};
  }
  slice.hold = slice.exists ? held.high - held.low : 0;
  return slice;
}

double width_of(const SceneBody& body, const FingerSpace& space, double turn) noexcept {
  const Slice slice = slice_of(body, space, turn);
  return slice.exists ? slice.along.high - slice.along.low : std::numeric_limits<double>::max();
}

/// Downhill to where turning either way makes it wider. Fingers turn a part by an eighth of a turn at most.
void settle(const SceneBody& body, const FingerSpace& space, Between& between) noexcept {
  constexpr double most_turn = 0.8;
  constexpr double first_step = 0.02;
  constexpr double last_step = 1e-5;
  between.stop_width = width_of(body, space, 0);
  for (double step = first_step; step > last_step;) {
    const double more = width_of(body, space, between.stop_turn + step);
    const double less = width_of(body, space, between.stop_turn - step);
    const double found = std::min(more, less);
    if (found >= between.stop_width - 1e-12 || std::abs(between.stop_turn) > most_turn) {
      step *= 0.3;
      continue;
    }
    between.stop_width = found;
    between.stop_turn += more < less ? step : -step;
  }
}

}  // namespace

FingerSpace finger_space(const HandModel& hand, const Eigen::Isometry3d& tool) noexcept {
  constexpr double upright = 0.7071;
  FingerSpace space;
  const Eigen::Vector3d tip = tool * Eigen::Vector3d(0, 0, hand.reach);
  const Eigen::Vector3d root = tool * Eigen::Vector3d(0, 0, hand.reach - hand.finger_length);
  const PlaneVector closing{tool.linear()(0, 1), tool.linear()(1, 1)};
  space.upright = -tool.linear()(2, 2) > upright && dot(closing, closing) > upright * upright;
  if (!space.upright) return space;
  space.middle = {tip.x(), tip.y()};
  space.closing = unit(closing);
  space.half_width = hand.finger_width / 2;
  space.low = tip.z();
  space.high = root.z();
  return space;
}

Between find_between(const SceneState& state, const PartPushing& bodies, const FingerSpace& space,
                     double opening) noexcept {
  Between between;
  if (!space.upright) return between;
  double together = 0;
  for (std::size_t i = 0; i < most_parts; ++i) {
    const Footprint& part = bodies.part(i);
    if (!part.exists() || std::min(part.high, space.high) - std::max(part.low, space.low) < least_hold)
      continue;
    const PlaneVector apart = part.middle - space.middle;
    const double near = part.radius + opening / 2 + space.half_width;
    if (dot(apart, apart) > near * near) continue;
    const Slice slice = slice_of(state.parts[i], space, 0);
    if (!slice.exists || slice.hold < least_hold) continue;
    const double outermost = opening / 2 + slack;
    if (slice.along.low < -outermost || slice.along.high > outermost) continue;
    ++between.parts;
    between.part = i;
    between.extent = slice.along;
    together += slice.along.high - slice.along.low;
  }
  if (between.parts == 1) settle(state.parts[between.part], space, between);
  if (between.parts > 1) between.stop_width = together;
  return between;
}

}  // namespace flexrf
