// Each way to take a part is tried out in the scene's world, and what is said to be free or not is judged by
// a sampler that knows nothing of how it was found.
#include "units/part_picker/grasp_choice.hpp"

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "hal/scene/world/tabletop_world.hpp"
#include "tests/cmocka.hpp"
#include "units/vision/tests/known_parts.hpp"

namespace flexrf::grasp_choice_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;
using Eigen::Vector2d;

constexpr double pi = std::numbers::pi;
const HandShape hand;
const HandRoom room;
constexpr double grasp_height = 0.008;

/// Of the catalogue, in its order; `part` is upright on the table.
ObjectTrack track_of(std::uint32_t identity, const SceneBody& body) {
  ObjectTrack track{};
  track.identity = identity;
  track.position = {body.position[0], body.position[1]};
  track.angle = body.angle;
  track.confirmed = true;
  track.radius = footprint_of(body).radius;
  track.found = VisualClass::obstacle;
  track.kind = 65535;
  for (std::size_t kind = 0; kind < part_catalogue.size(); ++kind) {
    if (part_catalogue[kind].kind != body.kind) continue;
    track.found = VisualClass::target;
    track.kind = static_cast<std::uint16_t>(kind);
    track.may_be_target = true;
  }
  return track;
}
/// Identities: parts from 1, obstacles from 101.
TrackList tracks_of(const SceneState& state) {
  TrackList list{};
  for (std::size_t i = 0; i < state.parts.size(); ++i)
    if (state.parts[i].kind != SceneKind::none)
      list.tracks[list.count++] = track_of(static_cast<std::uint32_t>(i + 1), state.parts[i]);
  for (std::size_t i = 0; i < state.obstacles.size(); ++i)
    if (state.obstacles[i].kind != SceneKind::none)
      list.tracks[list.count++] = track_of(static_cast<std::uint32_t>(i + 101), state.obstacles[i]);
  return list;
}

/// A hand that comes from behind and above, as the grasp says, closes and lifts.
class Trial {
 public:
  Trial(const SceneState& state, const Grasp& grasp) : grasp_(grasp) {
    world.begin(HandModel{}, 1);
    world.put(state);
    opening_ = grasp.opening;
    place_ = {-room.slant, 0, 0.108};
    step();
    go({0, 0, grasp_height + 0.08});
    go({0, 0, grasp_height});
  }
  bool touched_nothing() const { return world.counts().touches == 0 && world.counts().contacts == 0; }
  void close() {
    for (int i = 0; i < 100; ++i) {
      opening_ = std::max(opening_ - 0.001, world.state().grip_width);
      step();
    }
  }
  void lift() { go({0, 0, 0.12}); }
  double opening() const { return opening_; }

  TabletopWorld world;

 private:
  /// In the hand's frame at the grasp, z above the table.
  void go(const Eigen::Vector3d& to) {
    const Eigen::Vector3d from = place_;
    for (int i = 1; i <= 15; ++i) {
      place_ = from + (to - from) * i / 15;
      step();
    }
  }
  void step() {
    const Vector2d y(std::cos(grasp_.angle), std::sin(grasp_.angle));
    const Vector2d x(-y.y(), y.x());
    const Vector2d tip = grasp_.middle + x * place_.x();
    HandState now;
    now.tool = tool_above({tip.x(), tip.y(), place_.z()}, grasp_.angle, hand.reach);
    now.opening = opening_;
    world.step(now);
  }
  Grasp grasp_;
  Eigen::Vector3d place_;
  double opening_ = 0;
};

bool the_hand_is_the_scenes() {
  const HandModel model;
  return hand.reach == model.reach && hand.finger_width == model.finger_width &&
         hand.finger_thickness == model.finger_thickness && hand.palm_width == model.palm_width &&
         hand.palm_length == model.palm_length;
}

bool the_tool_points_down_where_it_shall() {
  for (double angle = -4; angle < 4; angle += 0.37) {
    const Eigen::Isometry3d tool = tool_above({0.4, -0.1, 0.03}, angle, hand.reach);
    const FingerSpace space = finger_space(HandModel{}, tool);
    if (!space.upright || std::abs(tool.linear().determinant() - 1) > 1e-12) return false;
    if (std::abs(space.middle.x - 0.4) > 1e-12 || std::abs(space.middle.y + 0.1) > 1e-12) return false;
    if (std::abs(space.low - 0.03) > 1e-12) return false;
    if (std::abs(space.closing.x - std::cos(angle)) > 1e-12) return false;
    if (std::abs(space.closing.y - std::sin(angle)) > 1e-12) return false;
  }
  return std::abs(turn_between(3, -3) - (2 * pi - 6)) < 1e-12 &&
         std::abs(turn_between(-1, 1.5) - 2.5) < 1e-12;
}

/// Nothing is touched on the way; the part is held flush, where the track said, and as wide as was said.
bool every_grasp_holds_its_part() {
  for (std::size_t place = 0; place < part_catalogue.size(); ++place) {
    const auto kind = static_cast<std::uint16_t>(place);
    if (grasps_of(parts_of_tests(), kind).empty()) return false;
    for (std::size_t number = 0; number < grasps_of(parts_of_tests(), kind).size(); ++number) {
      for (int turn = 0; turn < 24; ++turn) {
        const double angle = turn * pi / 12 + 0.03 - pi;
        SceneState state{};
        state.parts[0] = part_at(part_catalogue[kind].kind, {0.45, 0.02}, angle);
        const TrackList list = tracks_of(state);
        const double preferred = turn * 0.4 - 3;
        Grasp grasp = grasp_of(parts_of_tests(), list.tracks[0], number, preferred);
        if (what_blocks(parts_of_tests(), grasp, list.tracks[0], list, hand, room) != nullptr) return false;
        if (std::abs(grasp.angle - preferred) > pi / 2 + 1e-9 || grasp.number != number) return false;
        if (grasp.opening != std::min(grasp.width + 2 * room.beside_part, hand.widest)) return false;
        Trial trial(state, grasp);
        if (!trial.touched_nothing()) return false;
        trial.close();
        if (trial.world.state().held != 1 || std::abs(trial.opening() - grasp.width) > 6e-4) return false;
        trial.lift();
        const SceneBody& part = trial.world.state().parts[0];
        const double moved = std::hypot(part.position[0] - 0.45, part.position[1] - 0.02);
        // A disc has corners in the world, and turns until two of its sides lie flush.
        const double turned = part_catalogue[kind].symmetry == 0 ? 0 : turn_between(part.angle, angle);
        if (trial.world.state().held != 1 || moved > 1e-3 || std::abs(turned) > 0.01) return false;
      }
    }
  }
  return true;
}

/// The camera is off by as much as an exact pick may be: on its way down no finger touches the part, however
/// far it is open.
bool every_grasp_forgives_what_the_camera_is_off() {
  constexpr double off = 0.003;
  constexpr double turned = 1.5 * pi / 180;
  for (std::size_t place = 0; place < part_catalogue.size(); ++place) {
    const auto kind = static_cast<std::uint16_t>(place);
    for (std::size_t number = 0; number < grasps_of(parts_of_tests(), kind).size(); ++number) {
      for (int direction = 0; direction < 16; ++direction) {
        SceneState state{};
        state.parts[0] = part_at(part_catalogue[kind].kind, {0.45, 0.02}, 0.3);
        const TrackList list = tracks_of(state);
        Grasp grasp = grasp_of(parts_of_tests(), list.tracks[0], number, 0.3);
        const double way = direction * pi / 8;
        grasp.middle += off * Vector2d(std::cos(way), std::sin(way));
        grasp.angle += direction % 2 == 0 ? turned : -turned;
        for (const double beside : {room.least_beside, room.beside_part}) {
          grasp.opening = grasp.width + 2 * beside;
          if (!Trial(state, grasp).touched_nothing()) {
            print_message("kind %zu, grasp %zu, off towards %.0f degrees, %.0f mm beside it\n", place, number,
                          way * 180 / pi, 1000 * beside);
            return false;
          }
        }
      }
    }
  }
  return true;
}

// ---- the sampler

double distance_to_side(const Vector2d& point, const Vector2d& one, const Vector2d& next) {
  const Vector2d side = next - one;
  const double along = std::clamp((point - one).dot(side) / side.squaredNorm(), 0.0, 1.0);
  return (point - one - along * side).norm();
}
/// To what a body covers of the table; 0 within.
double distance_to(const Vector2d& point, const SceneBody& body) {
  const Outline outline = placed(outline_of(body), {body.position[0], body.position[1]}, body.angle);
  double least = 1;
  double winding = 0;
  for (std::size_t i = 0; i < outline.count; ++i) {
    const PlaneVector one = outline.corners[i];
    const PlaneVector next = outline.corners[(i + 1) % outline.count];
    const Vector2d from(one.x, one.y);
    const Vector2d to(next.x, next.y);
    least = std::min(least, distance_to_side(point, from, to));
    winding += turn_between(std::atan2(from.y() - point.y(), from.x() - point.x()),
                            std::atan2(to.y() - point.y(), to.x() - point.x()));
  }
  return std::abs(winding) > pi ? 0 : least;
}
constexpr double spacing = 0.001;
/// Points of a rectangle in the hand's frame at the grasp, in the robot's.
void add_samples(std::vector<Vector2d>& samples, const Grasp& grasp, const Vector2d& from, const Vector2d& to,
                 double step) {
  const Vector2d y(std::cos(grasp.angle), std::sin(grasp.angle));
  const Vector2d x(-y.y(), y.x());
  const int rows = static_cast<int>(std::ceil((to.x() - from.x()) / step));
  const int columns = static_cast<int>(std::ceil((to.y() - from.y()) / step));
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double along = from.x() + (to.x() - from.x()) * i / rows;
      const double across = from.y() + (to.y() - from.y()) * j / columns;
      samples.emplace_back(grasp.middle + x * along + y * across);
    }
  }
}
/// How much nearer than wanted the hand comes to anything; below 0: it keeps more room than is wanted.
double trespass(const Grasp& grasp, double opening, std::size_t part, const SceneState& state) {
  std::vector<Vector2d> fingers;
  std::vector<Vector2d> hand_and_way;
  const double x = hand.finger_width / 2;
  const double inner = opening / 2;
  for (const double side : {-1.0, 1.0}) {
    const double one = side * inner;
    const double other = side * (inner + hand.finger_thickness);
    add_samples(fingers, grasp, {-x, std::min(one, other)}, {x, std::max(one, other)}, spacing);
    add_samples(hand_and_way, grasp, {-x - room.slant, std::min(one, other)}, {x, std::max(one, other)},
                0.004);
  }
  // The palm comes down straight: on the slanted way it is above all that stands there.
  add_samples(hand_and_way, grasp, {-hand.palm_width / 2, -hand.palm_length / 2},
              {hand.palm_width / 2, hand.palm_length / 2}, 0.004);
  double worst = -1;
  for (std::size_t i = 0; i < state.parts.size(); ++i) {
    const SceneBody& body = state.parts[i];
    if (i == part || body.kind == SceneKind::none) continue;
    if (std::hypot(body.position[0] - grasp.middle.x(), body.position[1] - grasp.middle.y()) > 0.1) continue;
    for (const Vector2d& point : fingers) worst = std::max(worst, room.to_parts - distance_to(point, body));
  }
  for (const SceneBody& body : state.obstacles) {
    if (body.kind == SceneKind::none) continue;
    const double radius = footprint_of(body).radius;
    for (const Vector2d& point : hand_and_way) {
      const double distance = (point - Vector2d(body.position[0], body.position[1])).norm() - radius;
      worst = std::max(worst, room.to_obstacles - distance);
    }
  }
  return worst;
}

/// Crowded, without overlaps.
SceneState random_table(std::mt19937& random) {
  std::uniform_real_distribution<double> anywhere(-0.09, 0.09);
  std::uniform_real_distribution<double> any_angle(-pi, pi);
  SceneState state{};
  std::vector<Footprint> there;
  const auto fits = [&](const SceneBody& body) {
    const Footprint print = footprint_of(body);
    for (const Footprint& other : there)
      if (separation_of(print, other).gap < 5e-4) return false;
    there.push_back(print);
    return true;
  };
  const std::size_t obstacles = random() % 3;
  for (std::size_t i = 0; i < obstacles; ++i) {
    SceneBody body{};
    body.kind = random() % 2 == 0 ? SceneKind::post : SceneKind::box;
    body.position = {0.45 + anywhere(random), anywhere(random), 0};
    body.angle = any_angle(random);
    body.size = body.kind == SceneKind::post ? std::array<double, 3>{0.04, 0.04, 0.09}
                                             : std::array<double, 3>{0.06, 0.03, 0.07};
    if (fits(body)) state.obstacles[i] = body;
  }
  const std::size_t parts = 1 + random() % most_parts;
  for (std::size_t i = 0; i < parts; ++i) {
    const SceneBody body = part_at(part_catalogue[random() % part_catalogue.size()].kind,
                                   {0.45 + anywhere(random), anywhere(random)}, any_angle(random));
    if (fits(body)) state.parts[i] = body;
  }
  return state;
}

/// Free: the world's hand touches nothing and takes the part. Not free: the sampler finds what is too near,
/// in each of the declared ways.
bool what_is_free_is_free_and_what_is_not_is_not() {
  std::mt19937 random(7);
  int free = 0;
  int blocked = 0;
  int narrow = 0;
  // What a rectangle that is grown by the wanted room has more than a rounded one, and what lies between
  // samples.
  constexpr double between_samples = 0.0018;
  for (int table = 0; table < 300; ++table) {
    const SceneState state = random_table(random);
    const TrackList list = tracks_of(state);
    const double preferred = std::uniform_real_distribution<double>(-pi, pi)(random);
    for (const ObjectTrack& track : list.tracks) {
      if (track.found != VisualClass::target) continue;
      const std::size_t part = track.identity - 1;
      const char* blocked_by = nullptr;
      const auto found = free_grasp(parts_of_tests(), track, list, preferred, hand, room, blocked_by);
      if (!found) {
        ++blocked;
        if (blocked_by == nullptr) return false;
      } else {
        ++free;
        const double least = found->width + 2 * room.least_beside;
        const double most = std::min(found->width + 2 * room.beside_part, hand.widest);
        if (found->opening < least - 1e-12 || found->opening > most + 1e-12) return false;
        if (trespass(*found, found->opening, part, state) > 1e-9) return false;
        Trial trial(state, *found);
        if (!trial.touched_nothing()) return false;
        trial.close();
        if (trial.world.state().held != part + 1 || trial.world.counts().contacts != 0) return false;
        // As wide as there is room for, within what is worth a difference.
        const double wider = found->opening + 0.0045;
        if (wider < most) {
          ++narrow;
          if (trespass(*found, wider, part, state) < -between_samples) return false;
        }
      }
      for (std::size_t number = 0; number < grasps_of(parts_of_tests(), track.kind).size(); ++number) {
        Grasp grasp = grasp_of(parts_of_tests(), track, number, preferred);
        const char* const reason = what_blocks(parts_of_tests(), grasp, track, list, hand, room);
        if (!found && reason == nullptr) return false;
        const double least = grasp.width + 2 * room.least_beside;
        const bool obstacle = reason != nullptr && std::strstr(reason, "obstacle") != nullptr;
        const double slack = obstacle ? 0.003 : between_samples;
        if (reason != nullptr && trespass(grasp, least, part, state) < -slack) return false;
      }
    }
  }
  return free > 200 && blocked > 100 && narrow > 10;
}

/// On an empty table all are free; the list's order decides only between turns that are nearly alike.
bool the_hand_turns_little() {
  constexpr double nearly_alike = 0.17;
  for (std::size_t place = 0; place < part_catalogue.size(); ++place) {
    const auto kind = static_cast<std::uint16_t>(place);
    for (double angle = -pi; angle < pi; angle += 0.11) {
      SceneState state{};
      state.parts[0] = part_at(part_catalogue[kind].kind, {0.45, 0}, angle);
      const TrackList list = tracks_of(state);
      const char* blocked_by = nullptr;
      const auto found = free_grasp(parts_of_tests(), list.tracks[0], list, 1.5, hand, room, blocked_by);
      if (!found) return false;
      double least = pi;
      for (std::size_t number = 0; number < grasps_of(parts_of_tests(), kind).size(); ++number)
        least =
            std::min(least, std::abs(grasp_of(parts_of_tests(), list.tracks[0], number, 1.5).angle - 1.5));
      if (std::abs(found->angle - 1.5) > least + nearly_alike) return false;
    }
  }
  return true;
}

bool what_does_not_count_is_not_in_the_way() {
  SceneState state{};
  state.parts[0] = part_at(SceneKind::disc, {0.45, 0}, 0);
  state.obstacles[0].kind = SceneKind::post;
  state.obstacles[0].position = {0.45, 0.044, 0};
  state.obstacles[0].size = {0.04, 0.04, 0.09};
  TrackList list = tracks_of(state);
  const char* blocked_by = nullptr;
  if (free_grasp(parts_of_tests(), list.tracks[0], list, 0, hand, room, blocked_by) || blocked_by == nullptr)
    return false;
  const ObjectTrack obstacle = list.tracks[1];
  list.tracks[1].confirmed = false;
  if (!free_grasp(parts_of_tests(), list.tracks[0], list, 0, hand, room, blocked_by)) return false;
  list.tracks[1] = obstacle;
  list.tracks[1].found = VisualClass::nothing;
  if (!free_grasp(parts_of_tests(), list.tracks[0], list, 0, hand, room, blocked_by)) return false;
  // Beside a part that is not sure to be there either.
  state.obstacles[0].kind = SceneKind::none;
  return free_grasp(parts_of_tests(), list.tracks[0], tracks_of(state), 0, hand, room, blocked_by)
      .has_value();
}

bool what_is_too_wide_or_unknown_is_told() {
  SceneState state{};
  state.parts[0] = part_at(SceneKind::disc, {0.45, 0}, 0);
  TrackList list = tracks_of(state);
  HandShape small = hand;
  small.widest = 0.047;  // 40 mm and 4 on each side are more
  const char* blocked_by = nullptr;
  if (free_grasp(parts_of_tests(), list.tracks[0], list, 0, small, room, blocked_by) || blocked_by == nullptr)
    return false;
  small.widest = 0.0485;
  const auto narrow = free_grasp(parts_of_tests(), list.tracks[0], list, 0, small, room, blocked_by);
  if (!narrow || narrow->opening > small.widest) return false;
  list.tracks[0].kind = 65535;
  blocked_by = nullptr;
  return grasps_of(parts_of_tests(), 4).empty() && grasps_of(parts_of_tests(), 65535).empty() &&
         !free_grasp(parts_of_tests(), list.tracks[0], list, 0, hand, room, blocked_by) &&
         blocked_by != nullptr;
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::grasp_choice_test

int main() {
  using namespace flexrf::grasp_choice_test;
  const CMUnitTest tests[] = {
      {"the hand is the scene's", passes<the_hand_is_the_scenes>, nullptr, nullptr, nullptr},
      {"the tool points down where it shall", passes<the_tool_points_down_where_it_shall>, nullptr, nullptr,
       nullptr},
      {"every grasp holds its part", passes<every_grasp_holds_its_part>, nullptr, nullptr, nullptr},
      {"every grasp forgives what the camera is off", passes<every_grasp_forgives_what_the_camera_is_off>,
       nullptr, nullptr, nullptr},
      {"free is free, blocked is blocked", passes<what_is_free_is_free_and_what_is_not_is_not>, nullptr,
       nullptr, nullptr},
      {"the hand turns little", passes<the_hand_turns_little>, nullptr, nullptr, nullptr},
      {"what does not count", passes<what_does_not_count_is_not_in_the_way>, nullptr, nullptr, nullptr},
      {"too wide, or unknown", passes<what_is_too_wide_or_unknown_is_told>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
