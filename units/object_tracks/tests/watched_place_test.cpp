// The place into which the hand goes down next: when it is looked at, and what that says of obstacles.
#include <algorithm>
#include <memory>

#include "tests/cmocka.hpp"
#include "units/object_tracks/tests/tracks_world.hpp"
#include "units/vision/attention_genes.hpp"
#include "units/vision/camera_view.hpp"

namespace flexrf::watched_place_test {
namespace {

using namespace flexrf::user;

/// About x = 0.45, y = 0; the closing direction is along y, so that the hand's x points to -x.
TargetInHand watch_at(double x, double y) {
  TargetInHand hand{};
  hand.watch = {x, y};
  hand.watch_angle = 1.5707963267948966;
  hand.watch_from = {-0.03, -0.05};
  hand.watch_to = {0.03, 0.05};
  return hand;
}

bool a_watched_place_is_posted_while_all_of_it_is_seen() {
  const auto world = std::make_unique<World>();
  world->picture();
  if (!world->posted.empty()) return false;
  world->in_hand.publish(watch_at(0.45, 0), world->bench.now());
  world->picture();
  if (world->posted.size() != 1) return false;
  const VisionRegion region = world->posted[0];
  const CameraView view(camera_of_tests(), world->where);
  for (const double x : {0.42, 0.48}) {
    for (const double y : {-0.05, 0.05}) {
      Eigen::Vector2d pixel;
      if (!view.to_picture({x, y, 0}, pixel) || pixel.x() < region.left || pixel.y() < region.top ||
          pixel.x() >= region.left + region.width || pixel.y() >= region.top + region.height)
        return false;
    }
  }
  if (!region.watched || !region.whole || region.track != 0 || region.member != no_member) return false;
  // A corner of it is not in the picture.
  world->where = tool_above(0.45, 0.28, 0.45);
  world->picture();
  if (!world->posted.empty()) return false;
  world->where = tool;
  world->in_hand.publish(TargetInHand{}, world->bench.now());
  world->picture();
  return world->posted.empty();
}

/// A verdict about another place than the one that is watched now tells nothing.
bool it_counts_when_all_there_was_told() {
  const auto world = std::make_unique<World>();
  world->in_hand.publish(watch_at(0.45, 0), world->bench.now());
  world->picture();
  VisionVerdict nothing{};
  nothing.region = world->posted.at(0);
  nothing.parts = 1;
  world->tell(nothing);
  const auto told_at = [&] { return world->tracks.latest()->watched_at; };
  if (told_at() != 0) return false;
  nothing.complete = true;
  world->tell(nothing);
  if (told_at() != nothing.region.time) return false;
  world->in_hand.publish(watch_at(0.46, 0), world->bench.now());
  world->picture();
  if (told_at() != 0) return false;
  world->tell(nothing);  // of the place before
  return told_at() == 0 && world->tracks.latest()->watched[0] == 0.46;
}

/// Such an obstacle was seen wrongly, and the camera cannot see all of its own region again.
bool an_obstacle_in_a_watched_place_that_is_bare_is_gone() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.46, 0.04, no_kind);
  world->in_hand.publish(watch_at(0.45, 0), world->bench.now());
  const auto look = [&] {
    world->picture();
    VisionVerdict nothing{};
    nothing.region = *std::find_if(world->posted.begin(), world->posted.end(),
                                   [](const VisionRegion& region) { return region.watched; });
    nothing.parts = 1;
    nothing.complete = true;
    world->tell(nothing);
  };
  for (int i = 0; i < 7; ++i) look();
  const bool stays = world->count() == 1;
  look();
  if (!stays || world->count() != 0) return false;
  // Beside the place another one stays.
  world->follow(6, 0.50, 0.0, no_kind);
  for (int i = 0; i < 20; ++i) look();
  return world->count() == 1;
}

template <bool (*holds)()>
void check(void**) {
  assert_true(holds());
}

}  // namespace
}  // namespace flexrf::watched_place_test

int main() {
  using namespace flexrf::watched_place_test;
  const CMUnitTest tests[] = {
      {"it is posted while all of it is seen", check<a_watched_place_is_posted_while_all_of_it_is_seen>,
       nullptr, nullptr, nullptr},
      {"it counts when all there was told", check<it_counts_when_all_there_was_told>, nullptr, nullptr,
       nullptr},
      {"an obstacle in it that is not seen is gone",
       check<an_obstacle_in_a_watched_place_that_is_bare_is_gone>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests_name("a watched place", tests, nullptr, nullptr);
}
