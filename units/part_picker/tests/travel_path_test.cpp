// Ways among random boxes, against a search on a fine grid that knows nothing of corners.
#include "units/part_picker/travel_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <random>
#include <string>
#include <vector>

#include "tests/cmocka.hpp"

namespace flexrf::travel_path_test {
namespace {

using namespace flexrf::user;
using Eigen::Vector2d;

constexpr double height = 0.15;
constexpr double room = 0.03;

KeepOut box(double x, double y, double to_x, double to_y, double high = 0.4) {
  KeepOut made{};
  made.from = {x, y, 0};
  made.to = {to_x, to_y, high};
  return made;
}

/// In a box that counts, by more than rounding.
bool is_within(const Vector2d& place, std::span<const KeepOut> boxes) {
  constexpr double rounding = 1e-9;
  return std::any_of(boxes.begin(), boxes.end(), [&](const KeepOut& one) {
    return one.to[2] > height && place.x() > one.from[0] - room + rounding &&
           place.x() < one.to[0] + room - rounding && place.y() > one.from[1] - room + rounding &&
           place.y() < one.to[1] + room - rounding;
  });
}
/// A box that counts lies across a line: neither the axes nor the line's normal part them.
bool is_parted(const Vector2d& one, const Vector2d& other, std::span<const KeepOut> boxes) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const KeepOut& it) {
    if (it.to[2] <= height) return false;
    const Vector2d half((it.to[0] - it.from[0]) / 2 + room, (it.to[1] - it.from[1]) / 2 + room);
    const Vector2d middle((it.to[0] + it.from[0]) / 2, (it.to[1] + it.from[1]) / 2);
    const Vector2d reach = (other - one).cwiseAbs() / 2;
    const Vector2d apart = (one + other) / 2 - middle;
    if (((apart.cwiseAbs() - half - reach).array() >= -1e-12).any()) return false;
    const Vector2d normal(-(other - one).y(), (other - one).x());
    return std::abs(normal.dot(apart)) < half.dot(normal.cwiseAbs()) - 1e-12;
  });
}
double length_of(const Vector2d& from, std::span<const Vector2d> points) {
  double length = 0;
  Vector2d last = from;
  for (const Vector2d& point : points) {
    length += (point - last).norm();
    last = point;
  }
  return length;
}
bool stays_out(const Vector2d& from, std::span<const Vector2d> points, std::span<const KeepOut> boxes) {
  Vector2d last = from;
  for (const Vector2d& point : points) {
    const int samples = 1 + static_cast<int>((point - last).norm() / 0.0005);
    for (int i = 0; i <= samples; ++i)
      if (is_within(last + (point - last) * i / samples, boxes)) return false;
    last = point;
  }
  return true;
}

/// Of whole steps of the grid, around the square in which boxes lie.
class GridSearch {
 public:
  static constexpr int size = 72;
  static constexpr double spacing = 0.025;
  static Vector2d place(int cell) {
    const int column = cell % size;
    const int row = cell / size;
    return {(column - 16) * spacing, (row - 16) * spacing};
  }

  /// Infinite: none is found.
  static double shortest(int from, int to, std::span<const KeepOut> boxes) {
    std::vector<double> best(std::size_t{size} * size, std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    best[static_cast<std::size_t>(from)] = 0;
    open.emplace(0, from);
    while (!open.empty()) {
      const auto [length, cell] = open.top();
      open.pop();
      if (cell == to) return length;
      if (length > best[static_cast<std::size_t>(cell)]) continue;
      for (int dy = -3; dy <= 3; ++dy) {
        for (int dx = -3; dx <= 3; ++dx) {
          const int x = cell % size + dx;
          const int y = cell / size + dy;
          if (std::gcd(dx, dy) != 1 || x < 0 || y < 0 || x >= size || y >= size) continue;
          const int next = y * size + x;
          const double along = length + std::hypot(dx, dy) * spacing;
          if (along >= best[static_cast<std::size_t>(next)] - 1e-12) continue;
          if (is_within(place(next), boxes) || is_parted(place(cell), place(next), boxes)) continue;
          best[static_cast<std::size_t>(next)] = along;
          open.emplace(along, next);
        }
      }
    }
    return std::numeric_limits<double>::infinity();
  }
};

bool random_ways_are_free_and_short() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(0.05, 0.75);
  std::uniform_real_distribution<double> any_side(0.02, 0.3);
  int around = 0;
  int inside = 0;
  int low = 0;
  for (int round = 0; round < 250; ++round) {
    std::vector<KeepOut> boxes(1 + random() % most_keep_outs);
    for (KeepOut& one : boxes) {
      const double x = anywhere(random);
      const double y = anywhere(random);
      one = box(x, y, x + any_side(random), y + any_side(random), random() % 4 == 0 ? height : 0.4);
      low += one.to[2] == height ? 1 : 0;
    }
    TravelPath path;
    path.use(boxes, height, room);
    const auto cell = [&] {
      return static_cast<int>(16 + random() % 40 + (16 + random() % 40) * GridSearch::size);
    };
    const int start = cell();
    const int goal = cell();
    const Vector2d from = GridSearch::place(start);
    const Vector2d to = GridSearch::place(goal);
    const bool is_out = !is_within(from, boxes) && !is_within(to, boxes);
    if (path.is_kept_out(from) != is_within(from, boxes)) return false;
    if (path.is_kept_out(to) != is_within(to, boxes)) return false;
    const bool planned = path.plan(from, to);
    const bool tells_why = path.why()[0] != '\0';
    if (planned == tells_why || planned == path.points().empty()) return false;
    if (!is_out) {
      ++inside;
      if (planned) return false;
      continue;
    }
    const double shortest = GridSearch::shortest(start, goal, boxes);
    if (!planned) {
      if (std::isfinite(shortest)) return false;
      continue;
    }
    const auto points = path.points();
    if (points.back() != to || !stays_out(from, points, boxes)) return false;
    const double length = length_of(from, points);
    if (length > 1.01 * shortest || length < (to - from).norm() - 1e-12) return false;
    // No shorter way straight from one point to one after the next.
    std::vector<Vector2d> all{from};
    all.insert(all.end(), points.begin(), points.end());
    for (std::size_t i = 0; i + 2 < all.size(); ++i)
      for (std::size_t j = i + 2; j < all.size(); ++j)
        if (!is_parted(all[i], all[j], boxes)) return false;
    around += points.size() > 1 ? 1 : 0;
  }
  return around > 40 && inside > 40 && low > 100;
}

/// What a person can compute: around one box, past the nearer of its corners.
bool around_one_box_it_is_the_shorter_side() {
  const KeepOut one[] = {box(0.4, -0.2, 0.5, 0.1)};
  TravelPath path;
  path.use(one, height, room);
  const Vector2d from(0.2, 0);
  const Vector2d to(0.7, 0);
  if (!path.plan(from, to) || path.points().size() != 3) return false;
  const double expected = 2 * std::hypot(0.17, 0.13) + 0.16;
  return std::abs(length_of(from, path.points()) - expected) < 1e-3;
}

/// From where there has to be room, along a side, and through a narrow gap.
bool along_a_side_and_through_a_gap_is_free() {
  const KeepOut two[] = {box(0.4, 0.1, 0.6, 0.4), box(0.4, -0.4, 0.6, 0.1 - 2 * room - 0.001)};
  TravelPath path;
  path.use(two, height, room);
  const Vector2d side(0.2, 0.1 - room);
  if (path.is_kept_out(side) || !path.plan(side, {0.8, 0.1 - room}) || path.points().size() != 1)
    return false;
  const Vector2d from(0.2, 0.2);
  const Vector2d to(0.8, -0.3);
  if (!path.plan(from, to) || !stays_out(from, path.points(), two)) return false;
  const double through = std::hypot(0.17, 0.13) + 0.26 + std::hypot(0.17, 0.37);
  return std::abs(length_of(from, path.points()) - through) < 2e-3;
}

bool what_is_wrong_is_told() {
  const KeepOut fence[] = {box(0.3, 0.3, 0.7, 0.35), box(0.3, 0.65, 0.7, 0.7), box(0.3, 0.3, 0.35, 0.7),
                           box(0.65, 0.3, 0.7, 0.7), box(0.1, 0.1, 0.1, 0.1)};
  TravelPath path;
  path.use(fence, height, room);
  const Vector2d within(0.5, 0.5);
  const Vector2d outside(0, 0);
  if (path.plan(outside, within) || !path.points().empty()) return false;
  const std::string fenced = path.why();
  if (path.plan(within, outside) || path.why() != fenced) return false;
  if (path.plan({0.32, 0.5}, outside) || !path.points().empty()) return false;
  const std::string starts_inside = path.why();
  if (path.plan(outside, {0.32, 0.5})) return false;
  const std::string ends_inside = path.why();
  if (fenced.empty() || starts_inside.empty() || ends_inside.empty()) return false;
  if (starts_inside == ends_inside || starts_inside == fenced || ends_inside == fenced) return false;
  // The last one is no box: a way through its place is free. What was said before is forgotten.
  if (!path.plan(outside, {0.2, 0.2}) || path.points().size() != 1 || path.why()[0] != '\0') return false;
  // Lower ones are travelled over.
  path.use(fence, 0.4, room);
  if (!path.plan(outside, within) || path.is_kept_out({0.32, 0.5})) return false;
  path.use({}, height, room);
  return path.plan(outside, within) && path.points().size() == 1 && path.points()[0] == within;
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::travel_path_test

int main() {
  using namespace flexrf::travel_path_test;
  const CMUnitTest tests[] = {
      {"random ways are free and short", passes<random_ways_are_free_and_short>, nullptr, nullptr, nullptr},
      {"around one box", passes<around_one_box_it_is_the_shorter_side>, nullptr, nullptr, nullptr},
      {"along a side and through a gap", passes<along_a_side_and_through_a_gap_is_free>, nullptr, nullptr,
       nullptr},
      {"what is wrong is told", passes<what_is_wrong_is_told>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
