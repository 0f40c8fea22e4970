#include "units/part_picker/grasp_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexrf::user {
namespace {

using Eigen::Vector2d;

Vector2d along(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// A rectangle in the hand's frame at the grasp.
struct HandRectangle {
  Vector2d from;
  Vector2d to;

  HandRectangle grown(double by) const {
    return {from - Vector2d::Constant(by), to + Vector2d::Constant(by)};
  }
  double distance_to(const Vector2d& point) const {
    return (point - point.cwiseMax(from).cwiseMin(to)).norm();
  }
};

/// From the robot's frame into that of the hand at a grasp.
class HandFrame {
 public:
  explicit HandFrame(const Grasp& grasp)
      : middle_(grasp.middle), y_(along(grasp.angle)), x_(-y_.y(), y_.x()) {}
  Vector2d operator()(const Vector2d& point) const {
    return {(point - middle_).dot(x_), (point - middle_).dot(y_)};
  }

 private:
  Vector2d middle_;
  Vector2d y_;
  Vector2d x_;
};

/// A line from `one` to `next` comes into the rectangle (Liang and Barsky 1984).
bool crosses(const HandRectangle& rectangle, const Vector2d& one, const Vector2d& next) {
  double begin = 0;
  double end = 1;
  const Vector2d way = next - one;
  for (int i = 0; i < 2; ++i) {
    if (way[i] == 0) {
      if (one[i] <= rectangle.from[i] || one[i] >= rectangle.to[i]) return false;
      continue;
    }
    const double first = (rectangle.from[i] - one[i]) / way[i];
    const double second = (rectangle.to[i] - one[i]) / way[i];
    begin = std::max(begin, std::min(first, second));
    end = std::min(end, std::max(first, second));
  }
  return begin < end;
}

bool is_inside(std::span<const Vector2d> outline, const Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& one = outline[i];
    const Vector2d& next = outline[i + 1 == outline.size() ? 0 : i + 1];
    if ((one.y() > point.y()) == (next.y() > point.y())) continue;
    const double x = one.x() + (point.y() - one.y()) / (next.y() - one.y()) * (next.x() - one.x());
    if (point.x() < x) inside = !inside;
  }
  return inside;
}

bool overlaps(const HandRectangle& rectangle, std::span<const Vector2d> outline) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (crosses(rectangle, outline[i], outline[i + 1 == outline.size() ? 0 : i + 1])) return true;
  return is_inside(outline, (rectangle.from + rectangle.to) / 2);
}

// A hand that is turned farther from where it is by rule could not say which way to turn back.
constexpr double farthest_turn = std::numbers::pi - 0.2;

/// The two fingers, and behind them what they come past.
std::array<HandRectangle, 2> fingers_of(double opening, const HandShape& hand) {
  const double x = hand.finger_width / 2;
  const double inner = opening / 2;
  const double outer = inner + hand.finger_thickness;
  return {{{{-x, inner}, {x, outer}}, {{-x, -outer}, {x, -inner}}}};
}

bool fingers_meet_part(const Grasp& grasp, const ObjectTrack& other, const PartModel& model,
                       const HandShape& hand, const HandRoom& room) {
  const HandFrame into_hand{grasp};
  const Eigen::Rotation2Dd turn(other.angle);
  std::array<Vector2d, most_corners> corners;
  for (std::size_t i = 0; i < model.corner_count; ++i)
    corners[i] = into_hand(Vector2d(other.position_map()) + turn * model.corners[i]);
  const auto fingers = fingers_of(grasp.opening, hand);
  return std::any_of(fingers.begin(), fingers.end(), [&](const HandRectangle& finger) {
    return overlaps(finger.grown(room.to_parts), {corners.data(), model.corner_count});
  });
}

/// Obstacles are higher than the fingers are long, and the hand comes from behind.
bool hand_meets_obstacle(const Grasp& grasp, const ObjectTrack& obstacle, const HandShape& hand,
                         const HandRoom& room) {
  const double wanted = obstacle.radius + room.to_obstacles;
  const Vector2d place = HandFrame{grasp}(obstacle.position_map());
  for (HandRectangle finger : fingers_of(grasp.opening, hand)) {
    finger.from.x() -= room.slant;
    if (finger.distance_to(place) < wanted) return true;
  }
  // On the slanted part of the way the palm is still above all that stands on the table.
  const HandRectangle palm{{-hand.palm_width / 2, -hand.palm_length / 2},
                           {hand.palm_width / 2, hand.palm_length / 2}};
  return palm.distance_to(place) < wanted;
}

bool counts(const ObjectTrack& other, const HandRoom& room) {
  return other.identity != 0 && other.found != VisualClass::nothing &&
         (other.confirmed || (room.wary && other.found == VisualClass::obstacle));
}

}  // namespace

double turn_between(double from, double to) noexcept {
  return std::remainder(to - from, 2 * std::numbers::pi);
}

std::span<const PartGrasp> grasps_of(const KnownParts& parts, std::uint16_t kind) noexcept {
  const PartModel* const part = parts.find(kind);
  return part != nullptr ? part->all_grasps() : std::span<const PartGrasp>{};
}

Grasp grasp_of(const KnownParts& parts, const ObjectTrack& track, std::size_t number,
               double preferred) noexcept {
  const PartGrasp& known = grasps_of(parts, track.kind)[number];
  Grasp grasp;
  grasp.middle =
      Vector2d(track.position_map()) + Eigen::Rotation2Dd(track.angle) * Vector2d(known.x, known.y);
  const double turn = turn_between(preferred, track.angle + known.angle);
  grasp.angle = preferred + std::remainder(turn, std::numbers::pi);
  grasp.width = known.width;
  grasp.opening = known.width;
  grasp.number = static_cast<std::uint8_t>(number);
  return grasp;
}

const char* what_blocks(const KnownParts& parts, Grasp& grasp, const ObjectTrack& track, const TrackList& all,
                        const HandShape& hand, const HandRoom& room) noexcept {
  const double widest = std::min(grasp.width + 2 * room.beside_part, hand.widest);
  const double least = grasp.width + 2 * room.least_beside;
  if (least > widest) return "it is wider than the fingers open";
  constexpr int tries = 4;
  const char* reason = nullptr;
  for (int i = 0; i < tries; ++i) {
    grasp.opening = widest + (least - widest) * i / (tries - 1);
    reason = nullptr;
    for (const ObjectTrack& other : all.tracks) {
      if (other.identity == track.identity || !counts(other, room)) continue;
      if (other.found == VisualClass::obstacle) {
        if (hand_meets_obstacle(grasp, other, hand, room)) reason = in_way_of_hand;
      } else if (const PartModel* const model = parts.find(other.kind);
                 model != nullptr && fingers_meet_part(grasp, other, *model, hand, room)) {
        reason = "another part is in the way of the fingers";
      }
      if (reason != nullptr) break;
    }
    if (reason == nullptr) return nullptr;
  }
  return reason;
}

bool meets_obstacle(const Grasp& grasp, const TrackList& all, const HandShape& hand,
                    const HandRoom& room) noexcept {
  return std::any_of(all.tracks.begin(), all.tracks.end(), [&](const ObjectTrack& other) {
    return other.found == VisualClass::obstacle && counts(other, room) &&
           hand_meets_obstacle(grasp, other, hand, room);
  });
}

std::optional<Grasp> free_grasp(const KnownParts& parts, const ObjectTrack& track, const TrackList& all,
                                double preferred, const HandShape& hand, const HandRoom& room,
                                const char*& blocked_by) noexcept {
  std::optional<Grasp> best;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t ways = grasps_of(parts, track.kind).size();
  if (ways == 0) blocked_by = "no way to take such a part is known";
  for (std::size_t n = 0; n < 2 * ways; ++n) {
    const std::size_t i = n % ways;
    Grasp grasp = grasp_of(parts, track, i, preferred);
    // The other way round the fingers come from the other side.
    if (n >= ways) grasp.angle += grasp.angle > preferred ? -std::numbers::pi : std::numbers::pi;
    if (std::abs(grasp.angle - preferred) > farthest_turn) continue;
    if (const char* const reason = what_blocks(parts, grasp, track, all, hand, room); reason != nullptr) {
      blocked_by = reason;
      continue;
    }
    // In the order of the list among those that turn the hand alike; little room counts as much as a turn.
    const double narrow = grasp.width + 2 * room.beside_part - grasp.opening;
    const double cost =
        std::abs(turn_between(preferred, grasp.angle)) + 50 * narrow + 0.01 * static_cast<double>(i);
    if (cost < least) {
      least = cost;
      best = grasp;
    }
  }
  return best;
}

Eigen::Isometry3d tool_above(const Eigen::Vector3d& tip, double angle, double reach) noexcept {
  const Vector2d y = along(angle);
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
  tool.linear() << -y.y(), y.x(), 0, y.x(), y.y(), 0, 0, 0, -1;
  tool.translation() = tip + Eigen::Vector3d(0, 0, reach);
  return tool;
}

}  // namespace flexrf::user
