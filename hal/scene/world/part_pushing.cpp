#include "hal/scene/world/part_pushing.hpp"

#include <algorithm>
#include <limits>

namespace flexrf {
namespace {

// Less than this is no overlap: what lies on each other touches.
constexpr double touching = 1e-6;  // m
constexpr int not_pushed = 1000;

bool heights_overlap(double low, double high, const Footprint& other) noexcept {
  constexpr double least = 1e-4;  // m; what stands on something does not collide with it
  return std::min(high, other.high) - std::max(low, other.low) > least;
}

bool may_overlap(PlaneVector middle, double radius, const Footprint& other) noexcept {
  const PlaneVector apart = other.middle - middle;
  const double reach = radius + other.radius;
  return dot(apart, apart) < reach * reach;
}

double square_of_gyration_of(SceneKind kind) noexcept {
  constexpr auto squares = [] {
    std::array<double, part_kinds> found{};
    for (std::size_t i = 0; i < part_kinds; ++i) found[i] = square_of_gyration(part_catalogue[i].outline);
    return found;
  }();
  for (std::size_t i = 0; i < part_kinds; ++i)
    if (part_catalogue[i].kind == kind) return squares[i];
  return 1;
}

void keep_deepest(Separation& found, const Separation& one) noexcept {
  if (one.gap < found.gap) found = one;
}

bool is_same_push(const Separation& one, const Separation& other) noexcept {
  return std::abs(one.gap - other.gap) < touching && dot(one.normal, other.normal) > 0.9999;
}

Separation far_apart() noexcept {
  Separation found;
  found.gap = std::numeric_limits<double>::max();
  return found;
}

}  // namespace

Footprint footprint_of(const SceneBody& body) noexcept {
  Footprint footprint;
  if (body.kind == SceneKind::none) return footprint;
  footprint.middle = {body.position[0], body.position[1]};
  footprint.pieces = pieces_of(body);
  for (std::size_t i = 0; i < footprint.pieces.count; ++i) {
    Outline& piece = footprint.pieces.pieces[i];
    for (const PlaneVector corner : piece.all())
      footprint.radius = std::max(footprint.radius, length(corner));
    piece = placed(piece, footprint.middle, body.angle);
  }
  footprint.low = body.position[2];
  footprint.high = body.position[2] + body.size[2];
  if (body.tilt[0] != 0 || body.tilt[1] != 0) {
    const Eigen::Isometry3d pose = pose_of(body);
    footprint.low = std::numeric_limits<double>::max();
    footprint.high = -footprint.low;
    const Outline outline = outline_of(body);
    for (const PlaneVector corner : outline.all()) {
      for (const double height : {0.0, body.size[2]}) {
        const double z = (pose * Eigen::Vector3d(corner.x, corner.y, height)).z();
        footprint.low = std::min(footprint.low, z);
        footprint.high = std::max(footprint.high, z);
      }
    }
  }
  return footprint;
}

Separation separation_of(const Outline& first, const Footprint& second, double enough) noexcept {
  Separation found = far_apart();
  for (const Outline& piece : second.pieces.all()) keep_deepest(found, separation_of(first, piece, enough));
  return found;
}

Separation separation_of(const Footprint& first, const Footprint& second, double enough) noexcept {
  Separation found = far_apart();
  for (const Outline& piece : first.pieces.all()) keep_deepest(found, separation_of(piece, second, enough));
  return found;
}

void PartPushing::begin(const SceneState& state) noexcept {
  for (std::size_t i = 0; i < most_parts; ++i) refresh_part(state, i);
  for (std::size_t i = 0; i < most_obstacles; ++i) obstacles_[i] = footprint_of(state.obstacles[i]);
}

void PartPushing::refresh_part(const SceneState& state, std::size_t part) noexcept {
  parts_[part] = footprint_of(state.parts[part]);
}

void PartPushing::resolve(SceneState& state, std::span<const Solid> solids,
                          std::array<bool, most_parts>& touched, std::size_t pushed) noexcept {
  rank_.fill(not_pushed);
  if (pushed < most_parts) rank_[pushed] = 1;
  if (state.held > 0) rank_[state.held - 1] = 0;
  bool moved = true;
  for (int turn = 0; moved && turn < most_turns; ++turn) {
    moved = push_by_solids(state, solids, touched);
    moved = push_each_other(state, false) || moved;
    moved = push_out_of_obstacles(state) || moved;
  }
  // Something is pressed against an obstacle: from there back to what pushes, which alone may overlap then.
  for (int turn = 0; moved && turn < most_turns; ++turn) {
    moved = push_out_of_obstacles(state);
    moved = push_each_other(state, true) || moved;
  }
}

bool PartPushing::push_by_solids(SceneState& state, std::span<const Solid> solids,
                                 std::array<bool, most_parts>& touched) noexcept {
  bool moved = false;
  for (std::size_t i = 0; i < most_parts; ++i) {
    if (!is_loose(state, i)) continue;
    const Footprint& part = parts_[i];
    Separation deepest = far_apart();
    PlaneVector points;
    int count = 0;
    for (const Solid& solid : solids) {
      if (!heights_overlap(solid.low(), solid.high(), part) ||
          !may_overlap(solid.middle(), solid.reach(), part))
        continue;
      const Outline section = solid.section(part.low, part.high);
      if (section.count < 3) continue;
      const Separation found = separation_of(section, part);
      if (found.gap >= -touching) continue;
      // Two fingers side by side push in the middle between them, and do not turn the part by turns.
      if (count > 0 && is_same_push(found, deepest)) {
        points = points + found.point;
        ++count;
      } else if (count == 0 || found.gap < deepest.gap) {
        deepest = found;
        points = found.point;
        count = 1;
      }
    }
    if (count == 0) continue;
    deepest.point = points * (1.0 / count);
    move(state, i, deepest, 1);
    rank_[i] = 1;
    touched[i] = true;
    moved = true;
  }
  return moved;
}

bool PartPushing::push_each_other(SceneState& state, bool back) noexcept {
  bool moved = false;
  for (std::size_t i = 0; i < most_parts; ++i) {
    for (std::size_t j = i + 1; j < most_parts; ++j) {
      const Footprint& one = parts_[i];
      const Footprint& other = parts_[j];
      if (!one.exists() || !other.exists() || !heights_overlap(one.low, one.high, other) ||
          !may_overlap(one.middle, one.radius, other))
        continue;
      Separation found = separation_of(one, other);
      if (found.gap >= -touching) continue;
      Separation reversed = found;
      reversed.normal = -found.normal;
      moved = true;
      if (rank_[i] == rank_[j]) {
        move(state, j, found, 0.5);
        move(state, i, reversed, 0.5);
      } else if (state.held == i + 1 || (state.held != j + 1 && (rank_[i] < rank_[j]) != back)) {
        move(state, j, found, 1);
        rank_[j] = std::min(rank_[j], rank_[i] + 1);
      } else {
        move(state, i, reversed, 1);
        rank_[i] = std::min(rank_[i], rank_[j] + 1);
      }
    }
  }
  return moved;
}

bool PartPushing::push_out_of_obstacles(SceneState& state) noexcept {
  bool moved = false;
  for (std::size_t i = 0; i < most_parts; ++i) {
    if (!is_loose(state, i)) continue;
    for (const Footprint& obstacle : obstacles_) {
      const Footprint& part = parts_[i];
      if (!obstacle.exists() || !heights_overlap(obstacle.low, obstacle.high, part) ||
          !may_overlap(obstacle.middle, obstacle.radius, part))
        continue;
      const Separation found = separation_of(obstacle, part);
      if (found.gap >= -touching) continue;
      move(state, i, found, 1);
      moved = true;
    }
  }
  return moved;
}

void PartPushing::move(SceneState& state, std::size_t part, const Separation& by, double share) noexcept {
  SceneBody& body = state.parts[part];
  const PlaneVector middle{body.position[0], body.position[1]};
  const double lever = cross(by.point - middle, by.normal);
  const double gyration = square_of_gyration_of(body.kind);
  const double way = -by.gap * share / (1 + lever * lever / gyration);
  body.position[0] += by.normal.x * way;
  body.position[1] += by.normal.y * way;
  body.angle += way * lever / gyration;
  refresh_part(state, part);
}

}  // namespace flexrf
