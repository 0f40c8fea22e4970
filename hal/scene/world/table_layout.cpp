#include "hal/scene/world/table_layout.hpp"

#include <algorithm>
#include <limits>

namespace flexrf {
namespace {

constexpr double whole_turn = 6.28318530717958647693;  // rad
constexpr double least_distance = 0.006;               // m between what stands by itself
/// m from obstacles to a part that comes anew: a hand finds a way to it, or parts that it cannot take would
/// become ever more, until all that lies there is one.
constexpr double room_for_a_hand = 0.045;
constexpr int most_tries = 300;
constexpr int most_tables = 20;

double gap(const Footprint& one, const Footprint& other, double enough) noexcept {
  return separation_of(one, other, enough).gap;
}

bool is_far_from_obstacles(const SceneState& state, const Footprint& placed, double distance) noexcept {
  return std::all_of(state.obstacles.begin(), state.obstacles.end(), [&](const SceneBody& obstacle) {
    return obstacle.kind == SceneKind::none || gap(placed, footprint_of(obstacle), distance) > distance;
  });
}

bool is_far_from_solids(std::span<const Solid> solids, const Footprint& placed) noexcept {
  return std::all_of(solids.begin(), solids.end(), [&](const Solid& solid) {
    const Outline section = solid.section(placed.low, placed.high);
    return section.count < 3 || separation_of(section, placed, least_distance).gap > least_distance;
  });
}

/// Farther than `distance` from all but itself and `neighbour`, from which it only is apart.
bool is_free(const SceneState& state, const Footprint& placed, std::size_t part, double distance,
             std::size_t neighbour = most_parts) noexcept {
  for (std::size_t i = 0; i < most_parts; ++i) {
    if (i == part || state.parts[i].kind == SceneKind::none) continue;
    const double least = i == neighbour ? 0 : distance;
    if (gap(placed, footprint_of(state.parts[i]), least) <= least) return false;
  }
  return is_far_from_obstacles(state, placed, distance);
}

bool is_in_area(const Footprint& placed) noexcept {
  constexpr PlaneVector size = parts_area_to - parts_area_from;
  constexpr PlaneVector middle = (parts_area_from + parts_area_to) * 0.5;
  for (const Outline& piece : placed.pieces.all())
    if (!is_within(piece, middle, size)) return false;
  return true;
}

PlaneVector any_place(SceneRandom& random, double margin) noexcept {
  // One after the other: which of a call's arguments is computed first is not said.
  const double x = random.between(parts_area_from.x + margin, parts_area_to.x - margin);
  const double y = random.between(parts_area_from.y + margin, parts_area_to.y - margin);
  return {x, y};
}

bool lay_by_itself(SceneState& state, std::size_t part, SceneKind kind, SceneRandom& random,
                   double to_obstacles = least_distance) noexcept {
  for (int i = 0; i < most_tries; ++i) {
    const PlaneVector place = any_place(random, 0.025);
    const SceneBody body = part_at(kind, place, random.between(0, whole_turn));
    const Footprint placed = footprint_of(body);
    if (!is_in_area(placed) || !is_free(state, placed, part, least_distance) ||
        !is_far_from_obstacles(state, placed, to_obstacles))
      continue;
    state.parts[part] = body;
    return true;
  }
  return false;
}

/// It comes from outside towards one that lies there already, until they touch.
bool lay_touching(SceneState& state, std::size_t part, SceneKind kind, SceneRandom& random) noexcept {
  constexpr double closest = 1e-5;  // m
  for (int i = 0; i < most_tries; ++i) {
    const std::size_t neighbour = random.below(static_cast<std::uint32_t>(part));
    const SceneBody& other = state.parts[neighbour];
    const double from = random.between(0, whole_turn);
    const double angle = random.between(0, whole_turn);
    const SineCosine way = sine_cosine(from);
    const PlaneVector direction{way.cosine, way.sine};
    const PlaneVector middle{other.position[0], other.position[1]};
    const Footprint there = footprint_of(other);
    double near = 0;
    double far = there.radius + footprint_of(part_at(kind, middle, angle)).radius + closest;
    while (far - near > closest / 2) {
      const double tried = (near + far) / 2;
      const Footprint placed = footprint_of(part_at(kind, middle + direction * tried, angle));
      (gap(placed, there, closest) > closest ? far : near) = tried;
    }
    const SceneBody body = part_at(kind, middle + direction * far, angle);
    const Footprint placed = footprint_of(body);
    if (!is_in_area(placed) || gap(placed, there, 4 * closest) > 4 * closest ||
        !is_free(state, placed, part, least_distance, neighbour))
      continue;
    state.parts[part] = body;
    return true;
  }
  return false;
}

/// Behind an obstacle as seen from where the arm stands, so close that its far side is still seen over it.
bool lay_hidden(SceneState& state, std::size_t part, SceneKind kind, SceneRandom& random) noexcept {
  constexpr double close = 0.002;  // m
  for (int i = 0; i < most_tries; ++i) {
    const SceneBody& obstacle = state.obstacles[random.below(laid_obstacles)];
    const double behind = obstacle.size[0] / 2 + random.between(0.018, 0.035);
    const double beside = random.between(-0.02, 0.02);
    const double angle = random.between(0, whole_turn);
    const SceneBody body =
        part_at(kind, {obstacle.position[0] + behind, obstacle.position[1] + beside}, angle);
    const Footprint placed = footprint_of(body);
    if (!is_in_area(placed) || !is_free(state, placed, part, close)) continue;
    state.parts[part] = body;
    return true;
  }
  return false;
}

bool lay_obstacles(SceneState& state, SceneRandom& random) noexcept {
  constexpr double apart = 0.08;  // m, so that parts have a place between them
  for (std::size_t i = 0; i < laid_obstacles; ++i) {
    SceneBody obstacle{};
    const double height = random.between(0.06, 0.12);
    if (i % 2 == 0) {
      const double diameter = random.between(0.03, 0.045);
      obstacle.kind = SceneKind::post;
      obstacle.size = {diameter, diameter, height};
    } else {
      obstacle.kind = SceneKind::box;
      obstacle.size[0] = random.between(0.03, 0.04);
      obstacle.size[1] = random.between(0.05, 0.07);
      obstacle.size[2] = height;
    }
    bool found = false;
    for (int tries = 0; !found && tries < most_tries; ++tries) {
      const PlaneVector place = any_place(random, 0.045);
      obstacle.position = {place.x, place.y, 0};
      obstacle.angle = i % 2 == 0 ? 0 : random.between(-0.4, 0.4);
      found = is_free(state, footprint_of(obstacle), most_parts, apart);
    }
    if (!found) return false;
    state.obstacles[i] = obstacle;
  }
  return true;
}

bool lay_all(SceneState& state, SceneRandom& random) noexcept {
  state.parts = {};
  state.obstacles = {};
  if (!lay_obstacles(state, random)) return false;
  for (std::size_t i = 0; i < most_parts; ++i) {
    const SceneKind kind = part_catalogue[(i + i / part_kinds) % part_kinds].kind;
    // Every third: one by turns touches another, or stands behind an obstacle.
    const bool found = i % 6 == 2   ? lay_touching(state, i, kind, random)
                       : i % 6 == 5 ? lay_hidden(state, i, kind, random)
                                    : lay_by_itself(state, i, kind, random);
    if (!found) return false;
  }
  return true;
}

}  // namespace

void lay_table(SceneState& state, SceneRandom& random, std::span<const Solid> solids) noexcept {
  state.held = 0;
  const auto meets = [&](const SceneBody& body) {
    return body.kind != SceneKind::none && !is_far_from_solids(solids, footprint_of(body));
  };
  const auto meet = [&](const auto& bodies) { return std::any_of(bodies.begin(), bodies.end(), meets); };
  // What was laid when the last table did not become full is good all the same.
  for (int i = 0; i < most_tables; ++i)
    if (lay_all(state, random) && !meet(state.parts) && !meet(state.obstacles)) return;
  std::replace_if(state.parts.begin(), state.parts.end(), meets, SceneBody{});
  std::replace_if(state.obstacles.begin(), state.obstacles.end(), meets, SceneBody{});
}

bool lay_part(SceneState& state, std::size_t part, std::span<const Solid> solids,
              SceneRandom& random) noexcept {
  const SceneBody before = state.parts[part];
  if (!lay_by_itself(state, part, before.kind, random, room_for_a_hand)) return false;
  if (is_far_from_solids(solids, footprint_of(state.parts[part]))) return true;
  state.parts[part] = before;
  return false;
}

const char* lay_post(SceneState& state, std::size_t obstacle, PlaneVector place, double diameter,
                     double height, std::span<const Solid> solids) noexcept {
  SceneBody post{};
  post.kind = SceneKind::post;
  post.position = {place.x, place.y, 0};
  post.size = {diameter, diameter, height};
  if (!is_free(state, footprint_of(post), most_parts, 0))
    return "something stands there; choose another place";
  if (!is_far_from_solids(solids, footprint_of(post)))
    return "the arm is there; wait, or choose another place";
  state.obstacles[obstacle] = post;
  return nullptr;
}

}  // namespace flexrf
