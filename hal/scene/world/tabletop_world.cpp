#include "hal/scene/world/tabletop_world.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "hal/scene/world/table_layout.hpp"
#include "motion/pose_conversion.hpp"

namespace flexrf {
namespace {

constexpr double looked_at_each = 0.001;  // m
constexpr int most_looks = 16;
constexpr double flush = 3e-4;      // m that fingers may be away from a part that they hold
constexpr double let_go = 5e-4;     // m that they open until it falls
constexpr double above_it = 0.003;  // m that a part may be below the top of what it falls onto
constexpr double on_it = 2e-4;      // m that one has to lie over another to stand on it

// The straight way, with the orientation in between by the quaternions' mean: sums, products and a square
// root.
Eigen::Isometry3d on_the_way(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                             double part) noexcept {
  const Eigen::Quaterniond begin(from.linear());
  Eigen::Quaterniond end(to.linear());
  if (begin.coeffs().dot(end.coeffs()) < 0) end.coeffs() = -end.coeffs();
  Eigen::Quaterniond mean;
  mean.coeffs() = begin.coeffs() * (1 - part) + end.coeffs() * part;
  mean.normalize();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = mean.toRotationMatrix();
  pose.translation() = from.translation() * (1 - part) + to.translation() * part;
  return pose;
}

double farthest_move(const HandModel& hand, const Eigen::Isometry3d& from, double opened,
                     const Eigen::Isometry3d& to, double opening) noexcept {
  double most = 0;
  const auto before = hand_boxes(hand, opened);
  const auto after = hand_boxes(hand, opening);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto corners = corners_of(before[i], from);
    const auto moved = corners_of(after[i], to);
    for (std::size_t k = 0; k < corners.size(); ++k) most = std::max(most, (moved[k] - corners[k]).norm());
  }
  return most;
}

}  // namespace

void TabletopWorld::begin(const HandModel& hand, std::uint64_t seed) noexcept {
  *this = TabletopWorld();
  hand_ = hand;
  random_.seed(seed);
  set_light(1, 0.9, 1.1);
  lay_table();
}

void TabletopWorld::put(const SceneState& bodies) noexcept {
  state_.parts = bodies.parts;
  state_.obstacles = bodies.obstacles;
  state_.held = 0;
  bodies_.begin(state_);
  count_bodies();
}

void TabletopWorld::lay_table() noexcept {
  state_.grip_position = {};
  state_.grip_orientation = {};
  flexrf::lay_table(state_, random_, solids());
  bodies_.begin(state_);
  count_bodies();
}

void TabletopWorld::set_light(double intensity, double azimuth, double elevation) noexcept {
  const SineCosine about = sine_cosine(azimuth);
  const SineCosine up = sine_cosine(elevation);
  state_.light = {up.cosine * about.cosine, up.cosine * about.sine, up.sine};
  state_.light_intensity = intensity;
}

void TabletopWorld::step(const HandState& hand) noexcept {
  Links links;
  links.count = std::min(hand.links.size(), most_links);
  std::copy_n(hand.links.begin(), links.count, links.capsules.begin());
  touched_before_ = touched_;
  touched_ = {};
  if (!tool_ || links.count != links_.count) {
    tool_ = hand.tool;
    opening_ = hand.opening;
    links_ = links;
  }
  double way = farthest_move(hand_, *tool_, opening_, hand.tool, hand.opening);
  for (std::size_t i = 0; i < links.count; ++i) {
    way = std::max(way, (links.capsules[i].from - links_.capsules[i].from).norm());
    way = std::max(way, (links.capsules[i].to - links_.capsules[i].to).norm());
  }
  const int looks = static_cast<int>(std::min(way / looked_at_each, most_looks - 1.0)) + 1;
  for (int look = 1; look < looks; ++look) {
    const double part = static_cast<double>(look) / looks;
    Links there = links;
    for (std::size_t i = 0; i < links.count; ++i) {
      there.capsules[i].from = links_.capsules[i].from * (1 - part) + links.capsules[i].from * part;
      there.capsules[i].to = links_.capsules[i].to * (1 - part) + links.capsules[i].to * part;
    }
    move_to(on_the_way(*tool_, hand.tool, part), opening_ * (1 - part) + hand.opening * part, there);
  }
  move_to(hand.tool, hand.opening, links);
  tool_ = hand.tool;
  opening_ = hand.opening;
  links_ = links;
  state_.opening = hand.opening;
  empty_bins();
  count_contacts();
  count_bodies();
  for (std::size_t i = 0; i < most_parts; ++i)
    if (touched_[i] && !touched_before_[i]) ++counts_.touches;
}

void TabletopWorld::move_to(const Eigen::Isometry3d& tool, double opening, const Links& links) noexcept {
  solid_count_ = 0;
  for (const HandBox& box : hand_boxes(hand_, opening))
    solids_[solid_count_++] = Solid(corners_of(box, tool));
  for (std::size_t i = 0; i < links.count; ++i) solids_[solid_count_++] = Solid(links.capsules[i]);
  if (state_.held > 0 && opening > held_opening_ + let_go) release();
  if (state_.held > 0) {
    carry_held_part(state_, tool);
    bodies_.refresh_part(state_, state_.held - 1);
  }
  bodies_.resolve(state_, solids(), touched_);
  fall();
  hold(tool, opening);
}

void TabletopWorld::hold(const Eigen::Isometry3d& tool, double opening) noexcept {
  if (state_.held > 0) {
    state_.grip_width = held_opening_;
    return;
  }
  const FingerSpace space = finger_space(hand_, tool);
  const Between found = find_between(state_, bodies_, space, opening);
  state_.grip_width = found.stop_width;
  // Both fingers lie on it, as flush as it becomes.
  if (found.parts == 1 && opening <= found.stop_width + flush) grip(found, space, tool, opening);
}

void TabletopWorld::grip(const Between& between, const FingerSpace& space, const Eigen::Isometry3d& tool,
                         double opening) noexcept {
  SceneBody& part = state_.parts[between.part];
  part.angle += between.stop_turn;
  const double aside = (between.extent.low + between.extent.high) / 2;
  part.position[0] -= space.closing.x * aside;
  part.position[1] -= space.closing.y * aside;
  bodies_.refresh_part(state_, between.part);
  const Pose grip = to_pose(tool.inverse() * pose_of(part));
  state_.grip_position = grip.position;
  state_.grip_orientation = grip.orientation;
  state_.held = static_cast<std::uint32_t>(between.part + 1);
  held_opening_ = std::max(opening, between.stop_width);
  state_.grip_width = held_opening_;
}

void TabletopWorld::release() noexcept {
  SceneBody& part = state_.parts[state_.held - 1];
  part.tilt = {};
  bodies_.refresh_part(state_, state_.held - 1);
  state_.held = 0;
  state_.grip_position = {};
  state_.grip_orientation = {};
}

// What stands on nothing sinks to what is below it; from below upwards, as each then stands still.
void TabletopWorld::fall() noexcept {
  std::array<std::size_t, most_parts> order{};
  for (std::size_t i = 0; i < most_parts; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [this](std::size_t one, std::size_t other) {
    const double low = state_.parts[one].position[2];
    const double other_low = state_.parts[other].position[2];
    return low < other_low || (low == other_low && one < other);
  });
  for (const std::size_t part : order) {
    if (state_.parts[part].kind == SceneKind::none || state_.held == part + 1) continue;
    const double support = support_below(part);
    if (support == state_.parts[part].position[2]) continue;
    state_.parts[part].position[2] = support;
    bodies_.refresh_part(state_, part);
  }
}

double TabletopWorld::support_below(std::size_t part) const noexcept {
  const Footprint& falling = bodies_.part(part);
  double support = 0;
  const auto stand_on = [&](const Footprint& other) {
    if (other.exists() && other.high > support && other.high <= falling.low + above_it &&
        separation_of(falling, other).gap < -on_it)
      support = other.high;
  };
  if (falling.low == 0) return 0;
  for (std::size_t i = 0; i < most_parts; ++i)
    if (i != part && state_.held != i + 1) stand_on(bodies_.part(i));
  for (std::size_t i = 0; i < most_obstacles; ++i) stand_on(bodies_.obstacle(i));
  return support;
}

void TabletopWorld::empty_bins() noexcept {
  for (std::size_t i = 0; i < most_parts; ++i) {
    const SceneBody& part = state_.parts[i];
    if (part.kind == SceneKind::none || state_.held == i + 1 || part.position[2] > 0) continue;
    for (std::size_t bin = 0; bin < part_kinds; ++bin) {
      const BinModel& model = part_bins[bin];
      const OutlinePieces& pieces = bodies_.part(i).pieces;
      if (model.kind != part.kind ||
          !std::all_of(pieces.all().begin(), pieces.all().end(),
                       [&](const Outline& piece) { return is_within(piece, model.middle, model.size); }))
        continue;
      // Until there is a place for the next one it stays, and counts then.
      if (!lay_part(state_, i, solids(), random_)) continue;
      bodies_.refresh_part(state_, i);
      ++counts_.binned[bin];
    }
  }
}

void TabletopWorld::count_contacts() noexcept {
  constexpr std::uint16_t table = 1U << most_obstacles;
  constexpr double sunk = 2e-4;  // m
  Contacts now{};
  const auto look = [&](std::size_t which, double low, double high, PlaneVector middle, double reach,
                        bool stands, const auto& gap_to) {
    if (low < -sunk && !stands) now[which] |= table;
    for (std::size_t i = 0; i < most_obstacles; ++i) {
      const Footprint& obstacle = bodies_.obstacle(i);
      const PlaneVector apart = obstacle.middle - middle;
      const double near = obstacle.radius + reach;
      if (!obstacle.exists() || low >= obstacle.high || high <= obstacle.low ||
          dot(apart, apart) > near * near || gap_to(obstacle) >= 0)
        continue;
      now[which] |= static_cast<std::uint16_t>(1U << i);
    }
  };
  for (std::size_t i = 0; i < solid_count_; ++i) {
    const Solid& solid = solids_[i];
    look(i, solid.low(), solid.high(), solid.middle(), solid.reach(), solid.stands(),
         [&](const Footprint& obstacle) {
           const Outline section = solid.section(obstacle.low, obstacle.high);
           return section.count < 3 ? 1.0 : separation_of(section, obstacle).gap;
         });
  }
  if (state_.held > 0) {
    const Footprint& held = bodies_.part(state_.held - 1);
    look(most_solids, held.low, held.high, held.middle, held.radius, false,
         [&](const Footprint& obstacle) { return separation_of(held, obstacle).gap; });
  }
  for (std::size_t i = 0; i < now.size(); ++i)
    counts_.contacts +=
        static_cast<std::uint64_t>(std::popcount(static_cast<unsigned>(now[i] & ~contacts_[i])));
  contacts_ = now;
}

void TabletopWorld::count_bodies() noexcept {
  counts_.parts_on_table = 0;
  counts_.obstacles = 0;
  for (std::size_t i = 0; i < most_parts; ++i) {
    const SceneBody& part = state_.parts[i];
    const bool binned = std::any_of(part_bins.begin(), part_bins.end(), [&](const BinModel& bin) {
      return std::abs(part.position[0] - bin.middle.x) <= bin.size.x / 2 &&
             std::abs(part.position[1] - bin.middle.y) <= bin.size.y / 2;
    });
    if (part.kind != SceneKind::none && state_.held != i + 1 && !binned) ++counts_.parts_on_table;
  }
  for (const SceneBody& obstacle : state_.obstacles)
    if (obstacle.kind != SceneKind::none) ++counts_.obstacles;
}

const char* TabletopWorld::push_part(std::uint32_t part, PlaneVector place, double way,
                                     double azimuth) noexcept {
  if (part == 0) {
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < most_parts; ++i) {
      if (state_.parts[i].kind == SceneKind::none || state_.held == i + 1) continue;
      const double distance = length(bodies_.part(i).middle - place);
      if (distance >= nearest) continue;
      nearest = distance;
      part = static_cast<std::uint32_t>(i + 1);
    }
  }
  if (part == 0 || part > most_parts || state_.parts[part - 1].kind == SceneKind::none)
    return "there is no such part";
  if (state_.held == part) return "the hand holds this part; a person does not push it";
  const SineCosine direction = sine_cosine(azimuth);
  SceneBody& body = state_.parts[part - 1];
  const int steps = std::max(1, static_cast<int>(way / looked_at_each));
  std::array<bool, most_parts> touched{};
  // It is pushed as a whole, as by a hand on it; what it meets is pushed by it.
  for (int i = 0; i < steps; ++i) {
    body.position[0] += direction.cosine * way / steps;
    body.position[1] += direction.sine * way / steps;
    bodies_.refresh_part(state_, part - 1);
    bodies_.resolve(state_, solids(), touched, part - 1);
    fall();
  }
  count_bodies();
  return nullptr;
}

const char* TabletopWorld::add_obstacle(PlaneVector place) noexcept {
  for (std::size_t i = laid_obstacles; i < most_obstacles; ++i) {
    if (state_.obstacles[i].kind != SceneKind::none) continue;
    if (const char* const refusal = lay_post(state_, i, place, 0.04, 0.09, solids()); refusal != nullptr)
      return refusal;
    bodies_.begin(state_);
    count_bodies();
    return nullptr;
  }
  return "there are as many obstacles as there may be; remove those that were added";
}

const char* TabletopWorld::remove_obstacles() noexcept {
  bool removed = false;
  for (std::size_t i = laid_obstacles; i < most_obstacles; ++i) {
    removed = removed || state_.obstacles[i].kind != SceneKind::none;
    state_.obstacles[i] = {};
  }
  bodies_.begin(state_);
  count_bodies();
  return removed ? nullptr : "none was added";
}

}  // namespace flexrf
