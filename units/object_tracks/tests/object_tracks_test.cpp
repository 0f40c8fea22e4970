#include "units/object_tracks/object_tracks.hpp"

#include <cmath>
#include <memory>

#include "motion/pose_conversion.hpp"
#include "tests/cmocka.hpp"
#include "units/object_tracks/tests/tracks_world.hpp"
#include "units/vision/attention_genes.hpp"
#include "units/vision/camera_view.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

bool five_pictures_confirm() {
  const auto world = std::make_unique<World>();
  world->follow(4, 0.42, 0.03);
  const ObjectTrack before = world->first();
  world->follow(1, 0.42, 0.03);
  const ObjectTrack after = world->first();
  return world->initialised && !before.confirmed && !before.may_be_target && after.confirmed &&
         after.may_be_target && after.frames == 5 && after.identity == before.identity &&
         world->count() == 1 && after.member == 1 && after.member_identity == 6 &&
         std::abs(after.position[0] - 0.42) < 1e-9 && std::abs(after.angle - 0.3) < 1e-9;
}

bool a_picture_counts_once() {
  const auto world = std::make_unique<World>();
  world->picture();
  for (int i = 0; i < 10; ++i) world->tell(world->seen(0.42, 0.03));
  return world->first().frames == 1 && world->count() == 1;
}

/// It lies within the obstacle; one that was seen wholly stays where it is, and as large as it is.
bool a_piece_of_an_obstacle_does_not_move_it() {
  const auto world = std::make_unique<World>();
  const auto see = [&](double x, double radius, double support) {
    world->picture();
    VisionVerdict verdict = world->seen(x, 0.03, no_kind);
    verdict.radius = radius;
    verdict.support = support;
    world->tell(verdict);
  };
  see(0.45, 0.015, 0.7);
  const std::uint32_t identity = world->first().identity;
  // The whole of it is somewhere else by more than any gate, and it is that which counts.
  see(0.42, 0.035, 1);
  const ObjectTrack seen = world->first();
  const bool moved = world->count() == 1 && seen.identity == identity &&
                     std::abs(seen.position[0] - 0.42) < 1e-9 && std::abs(seen.radius - 0.035) < 1e-9;
  for (int i = 0; i < 5; ++i) see(0.45, 0.015, 0.7);
  const ObjectTrack after = world->first();
  return moved && world->count() == 1 && std::abs(after.position[0] - 0.42) < 1e-9 &&
         std::abs(after.radius - 0.035) < 1e-9 && after.frames == 7 && after.misses == 0;
}

/// 0.12 m high, and taken to be 0.09: each view has its far side too far away from the camera.
bool two_views_tell_how_high_an_obstacle_is() {
  const auto world = std::make_unique<World>();
  const auto see_from = [&](double aside) {
    world->picture();
    VisionVerdict verdict = world->seen(0.45 - 0.03 * aside, 0.03, no_kind);
    verdict.body_height = 0.09;
    verdict.lean = {aside, 0, -0.5 * std::abs(aside)};
    verdict.radius = 0.02 + 0.03 * 0.5 * std::abs(aside);
    verdict.support = 1;
    world->tell(verdict);
  };
  see_from(0.3);
  const ObjectTrack one_view = world->first();
  see_from(-0.3);
  const ObjectTrack two = world->first();
  return world->count() == 1 && std::abs(one_view.body_height - 0.09) < 1e-6 &&
         std::abs(one_view.position[0] - 0.441) < 1e-4 && std::abs(two.body_height - 0.12) < 0.003 &&
         std::abs(two.position[0] - 0.45) < 0.001 && std::abs(two.radius - 0.02) < 0.001;
}

bool probation_moves_nothing() {
  const auto world = std::make_unique<World>();
  world->follow(20, 0.42, 0.03, 0, true);
  const ObjectTrack untrusted = world->first();
  // It is measured at its predicted place as well, which makes it no better.
  world->picture();
  VisionVerdict predicted = world->seen(0.42, 0.03);
  predicted.region.member = no_member;
  predicted.region.track = untrusted.identity;
  world->tell(predicted);
  const ObjectTrack measured = world->first();
  world->follow(1, 0.42, 0.03);
  return untrusted.confirmed && !untrusted.may_be_target && !measured.may_be_target &&
         measured.frames == 21 && world->first().may_be_target;
}

bool who_passes_probation_is_trusted_afterwards() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03, 0, true);
  AttentionGeneration population{};
  population.members[1].active = true;
  population.members[1].identity = 7;  // another one in the same place
  world->generation.publish(population, world->bench.now());
  world->step();
  const bool other = world->first().may_be_target;
  population.members[1].identity = 6;
  population.members[1].probation = true;
  world->generation.publish(population, world->bench.now());
  world->step();
  const bool still = world->first().may_be_target;
  population.members[1].probation = false;
  world->generation.publish(population, world->bench.now());
  world->step();
  return !other && !still && world->first().may_be_target;
}

/// What is found beside a track in its predicted region is trusted as that is.
bool trust_is_lent() {
  const auto world = std::make_unique<World>();
  world->follow(5, 0.42, 0.03, 0, true);
  const ObjectTrack known = world->first();
  world->picture();
  VisionVerdict beside = world->seen(0.46, 0.03);
  beside.region.member = no_member;
  beside.region.track = known.identity;
  world->tell(beside);
  const auto now = world->tracks.latest();
  return now && now->count == 2 && !now->tracks[1].trusted && now->tracks[1].member == 1;
}

bool what_is_gone_is_lost() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  for (int i = 0; i < 8; ++i) {
    if (world->count() != 1) return false;
    world->picture();
    VisionVerdict nothing = world->seen(0, 0);
    nothing.verdict = VisualClass::nothing;
    nothing.region.member = no_member;
    nothing.region.track = world->first().identity;
    world->tell(nothing);
    world->tell(nothing);  // once a picture
  }
  return world->count() == 0 && world->bench.feedback().lost == 1;
}

bool what_nobody_looked_for_is_not_lost() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  for (int i = 0; i < 100; ++i) world->picture();
  const bool there = world->count() == 1 && world->first().misses == 0;
  world->picture(std::chrono::seconds(3600));
  return there && world->count() == 1;
}

bool what_is_not_confirmed_is_forgotten() {
  const auto world = std::make_unique<World>();
  world->follow(2, 0.42, 0.03);
  const bool there = world->count() == 1;
  world->picture(std::chrono::seconds(61));
  return there && world->count() == 0;
}

/// A doubtful look, by light or by a piece of something else, does not say that it is gone.
bool an_obstacle_is_gone_only_where_nothing_is_in_doubt() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03, no_kind);
  const auto tell_nothing = [&](bool complete, bool whole) {
    world->picture();
    VisionVerdict verdict{};
    verdict.region.time = world->of.time;
    verdict.region.member = no_member;
    verdict.region.track = 1;
    verdict.region.whole = whole;
    verdict.complete = complete;
    verdict.parts = 1;
    world->tell(verdict);
  };
  for (int i = 0; i < 50; ++i) {
    tell_nothing(false, true);
    tell_nothing(true, false);
  }
  const bool stays = world->count() == 1 && world->first().misses == 0;
  for (int i = 0; i < 8; ++i) tell_nothing(true, true);
  return stays && world->count() == 0;
}

bool its_place_in_the_next_picture_is_posted() {
  const auto world = std::make_unique<World>();
  world->bench.runtime().rest = 0;
  world->follow(6, 0.42, 0.03);
  world->where = tool_above(0.47, 0.02, 0.4);
  world->picture();
  if (world->posted.size() != 1) return false;
  const VisionRegion region = world->posted[0];
  Eigen::Vector2d pixel(0, 0);
  CameraView(camera_of_tests(), world->where).to_picture({0.42, 0.03, 0.025}, pixel);
  const bool at_place = std::abs(pixel.x() - region.left - 0.5 * region.width) < 2 &&
                        std::abs(pixel.y() - region.top - 0.5 * region.height) < 2;
  world->where = tool_above(0.1, 0.8, 0.4);  // looks elsewhere
  world->picture();
  return at_place && region.frame == world->of.frame - 1 && region.member == no_member && region.track == 1 &&
         region.kind == 0 && region.score >= 1 && region.score < 1.2 &&
         std::abs(region.expected[0] - 0.42) < 1e-9 && world->posted.empty() && world->count() == 1;
}

/// For who draws it: where the list's own picture shows it.
bool its_place_in_this_picture_is_told() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  world->where = tool_above(0.47, 0.02, 0.4);
  world->picture();
  const ObjectTrack seen = world->first();
  const CameraView view(camera_of_tests(), world->where);
  const Eigen::Vector3d place(0.42, 0.03, 0.025);
  Eigen::Vector2d pixel(0, 0);
  view.to_picture(place, pixel);
  const double side = 2 * 0.03 * view.pixels_per_metre(place);
  const bool at_place = std::abs(pixel.x() - seen.left - 0.5 * seen.width) < 2 &&
                        std::abs(pixel.y() - seen.top - 0.5 * seen.height) < 2 &&
                        std::abs(seen.width - side) < 2 && std::abs(seen.height - side) < 2;
  // A little later it was measured elsewhere in the same picture.
  world->tell(world->seen(0.43, 0.03));
  const bool moved = world->first().left != seen.left && world->first().width == seen.width;
  // At the picture's end half of it is seen, farther on nothing; and without the tool's pose nothing is
  // known.
  world->where = tool_above(0.47 + pixel.x() / view.pixels_per_metre(place), 0.02, 0.4);
  world->picture();
  const ObjectTrack half = world->first();
  world->where = tool_above(0.1, 0.8, 0.4);
  world->picture();
  const ObjectTrack away = world->first();
  world->where = tool_above(0.47, 0.02, 0.4);
  world->picture();
  const bool again = world->first().width > 0;
  world->tells_pose = false;
  world->picture(std::chrono::milliseconds(200));
  return at_place && moved && half.left == 0 && half.width > 0 && half.width < 0.7 * side &&
         std::abs(half.height - side) < 2 && away.width == 0 && away.height == 0 && again &&
         world->first().width == 0 && world->count() == 1;
}

bool a_part_that_is_held_is_not_on_the_table() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  world->follow(6, 0.47, -0.06, 1);
  TargetInHand hand{};
  hand.track = world->first().identity;
  world->in_hand.publish(hand, world->bench.now());
  world->picture();
  const bool gone_too_soon = world->count() != 2;
  hand.holds = true;
  world->in_hand.publish(hand, world->bench.now());
  world->picture();
  return !gone_too_soon && world->count() == 1 && world->first().kind == 1;
}

/// A part in the hand covers the lower half of the picture.
bool nothing_is_looked_for_behind_what_is_held() {
  const auto world = std::make_unique<World>();
  world->bench.runtime().rest = 0;
  world->follow(6, 0.42, 0.03);
  world->picture();
  const bool was_posted = world->posted.size() == 1;
  const VisionRegion region = was_posted ? world->posted[0] : VisionRegion{};
  TargetInHand hand{};
  const CameraModel camera = camera_of_tests();
  // Before the region's middle, 0.1 m from the lens.
  const CameraView view(camera, Pose{});
  if (!was_posted) return false;
  const double column = region.left + 0.5 * region.width;
  const double row = region.top + 0.5 * region.height;
  const Eigen::Vector3d& lens = view.position();
  const double ahead = 0.1;
  const Eigen::Isometry3d mount = to_isometry(camera.mount);
  const Eigen::Vector3d middle =
      mount * Eigen::Vector3d((column - camera.principal_point[0]) / camera.focal_length * ahead,
                              (row - camera.principal_point[1]) / camera.focal_length * ahead, ahead);
  if ((middle - lens).norm() < ahead) return false;
  hand.held_from_map() = middle - Eigen::Vector3d::Constant(0.03);
  hand.held_to_map() = middle + Eigen::Vector3d::Constant(0.03);
  world->in_hand.publish(hand, world->bench.now());
  world->picture();
  return world->posted.empty() && world->count() == 1;
}

bool what_is_confirmed_is_left_in_peace_for_a_while(std::uint16_t kind) {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03, kind);
  world->picture();
  const bool rests = world->posted.empty() && world->first().confirmed;
  for (int i = 0; i < 7; ++i) world->picture();
  return rests && world->posted.size() == 1;
}

/// The arm goes by what is known of it.
bool the_part_that_the_arm_goes_to_is_measured_in_each_picture() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  TargetInHand hand{};
  hand.track = world->first().identity;
  world->in_hand.publish(hand, world->bench.now());
  world->picture();
  const bool is_measured = world->posted.size() == 1;
  hand.track = 0;
  world->in_hand.publish(hand, world->bench.now());
  world->tell(world->seen(0.42, 0.03));
  world->picture();
  return is_measured && world->posted.empty();
}

bool what_was_missed_is_looked_for_in_each_picture() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  for (int i = 0; i < 7; ++i) world->picture();
  if (world->posted.size() != 1) return false;
  VisionVerdict gone = world->seen(0.42, 0.03);
  gone.verdict = VisualClass::nothing;
  gone.region = world->posted.front();
  world->tell(gone);
  world->picture();
  return world->first().misses == 1 && world->posted.size() == 1;
}

bool without_the_tools_pose_nothing_is_predicted() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  world->tells_pose = false;
  world->picture(std::chrono::milliseconds(200));
  return world->posted.empty() && !world->bench.feedback().trouble_view().empty() && world->count() == 1;
}

bool kinds_and_places_are_told_apart() {
  const auto world = std::make_unique<World>();
  world->picture();
  world->add(world->seen(0.42, 0.03, 0));
  world->add(world->seen(0.42, 0.03, 1));
  world->add(world->seen(0.42, 0.03, no_kind));
  world->add(world->seen(0.46, 0.03, 0));
  world->tell();
  const bool four = world->count() == 4;
  world->picture();
  world->add(world->seen(0.461, 0.03, 0));
  world->add(world->seen(0.421, 0.03, 0));
  world->tell();
  return four && world->count() == 4;
}

bool a_full_list_takes_no_more_and_says_so() {
  const auto world = std::make_unique<World>();
  world->picture();
  for (int i = 0; i < 40; ++i) {
    const int row = i / 8;
    world->add(world->seen(0.3 + 0.05 * (i % 8), -0.2 + 0.05 * row));
    if (i % 20 == 19) world->tell();
  }
  return world->count() == 32 && world->bench.feedback().refused == 8 &&
         world->bench.unit().take_restraint().reason != nullptr;
}

bool verdicts_that_were_overwritten_are_counted() {
  const auto world = std::make_unique<World>();
  world->picture();
  for (int i = 0; i < 40; ++i) world->add(world->seen(0.42, 0.03));
  world->tell();
  const bool counted = world->bench.feedback().unread == 8;
  // A recogniser that begins anew is heard from its first verdict on.
  world->list = {};
  world->tell(world->seen(0.5, -0.1));
  return counted && world->count() == 2;
}

bool what_is_no_number_is_no_track() {
  const auto world = std::make_unique<World>();
  world->picture();
  world->tell(world->seen(std::nan(""), 0.03));
  VisionVerdict verdict = world->seen(0.42, 0.03);
  verdict.angle = INFINITY;
  world->tell(verdict);
  return world->count() == 0;
}

bool forgetting_empties_the_list() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  world->bench.runtime().forget = 1;
  world->step();
  world->bench.runtime().forget = 0;
  const bool empty = world->count() == 0;
  world->follow(1, 0.42, 0.03);
  return empty && world->first().identity == 2;
}

/// A camera whose clock jumped.
bool a_picture_ahead_of_time_ends_nothing() {
  const auto world = std::make_unique<World>();
  world->follow(6, 0.42, 0.03);
  world->of.time += nanoseconds(world->bench.now()) + 3600'000'000'000;
  ++world->of.frame;
  world->features.publish(world->of, world->bench.now());
  world->step();
  const bool kept = world->count() == 1 && world->first().identity == 1;
  world->follow(1, 0.42, 0.03);
  return kept && world->count() == 1 && world->first().identity == 1 && world->first().frames == 7;
}

bool on_a_belt_it_is_expected_further_on() {
  const auto world = std::make_unique<World>();
  world->bench.runtime().belt = true;
  double x = 0.36;
  for (int i = 0; i < 30; ++i) {
    world->picture();
    world->tell(world->seen(x, 0));
    x += 0.003;  // about 91 mm/s
  }
  world->picture();
  return world->count() == 1 && std::abs(world->first().velocity[0] - 0.091) < 0.01 &&
         world->posted.size() == 1 && std::abs(world->posted[0].expected[0] - x) < 0.001;
}

/// A thing on a belt, 0.3 m/s fast, in pictures whose verdicts come later and in any order.
struct Belt {
  static constexpr double step = 0.3 * 0.033;  // m, from picture to picture

  Belt() { world->bench.runtime().belt = true; }
  void picture() {
    world->picture();
    VisionVerdict verdict = world->seen(0.3 + step * static_cast<double>(verdicts.size()), 0);
    verdict.region.probation = false;
    verdicts.push_back(verdict);
  }
  void tell(std::size_t picture) { world->tell(verdicts[picture]); }
  double place_now() const { return 0.3 + step * static_cast<double>(verdicts.size() - 1); }

  std::unique_ptr<World> world = std::make_unique<World>();
  std::vector<VisionVerdict> verdicts;
};

/// Each verdict so many pictures after its own.
bool follows_by_verdicts_that_are_late(std::size_t late) {
  Belt belt;
  for (std::size_t i = 0; i < 20 + late; ++i) {
    belt.picture();
    if (i >= late) belt.tell(i - late);
  }
  belt.picture();
  const ObjectTrack track = belt.world->first();
  const bool good = belt.world->count() == 1 && belt.world->posted.size() == 1 &&
                    std::abs(belt.world->posted[0].expected[0] - belt.place_now()) < 0.001 &&
                    std::abs(track.position[0] - belt.place_now()) < 0.001 &&
                    std::abs(track.velocity[0] - 0.3) < 0.01;
  if (!good)
    print_message("%zu late: at %g, is at %g, %u tracks\n", late, belt.place_now(), track.position[0],
                  belt.world->count());
  return good;
}

bool a_verdict_counts_when_its_picture_was_taken() {
  for (const std::size_t late : {0U, 1U, 2U, 4U})
    if (!follows_by_verdicts_that_are_late(late)) return false;
  return true;
}

/// Of two recognisers one is slower: its verdict is about an older picture than the last that was told.
bool an_older_picture_shows_the_same_thing_farther_back() {
  Belt belt;
  for (std::size_t i = 0; i < 20; ++i) {
    belt.picture();
    if (i != 16) belt.tell(i);
  }
  const ObjectTrack before = belt.world->first();
  belt.tell(16);
  const ObjectTrack after = belt.world->first();
  return belt.world->count() == 1 && after.frames == before.frames &&
         after.position[0] == before.position[0] && after.measured_at == before.measured_at;
}

/// The thing was measured in the first of two pictures and is gone in the second, in each order of telling.
bool a_picture_without_it_counts_in_any_order() {
  for (const bool in_order : {true, false}) {
    const auto world = std::make_unique<World>();
    world->follow(6, 0.42, 0.03);
    world->picture();
    const VisionVerdict seen = world->seen(0.42, 0.03);
    world->picture();
    VisionVerdict gone = world->seen(0, 0);
    gone.verdict = VisualClass::nothing;
    gone.region.member = no_member;
    gone.region.track = world->first().identity;
    world->tell(in_order ? seen : gone);
    world->tell(in_order ? gone : seen);
    if (world->first().misses != 1 || world->first().frames != 7) return false;
  }
  return true;
}

/// In here, so that a failing assertion jumps over no destructor.
template <bool (*holds)()>
void check(void**) {
  assert_true(holds());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      {"five pictures confirm", check<five_pictures_confirm>, nullptr, nullptr, nullptr},
      {"two views tell how high an obstacle is", check<two_views_tell_how_high_an_obstacle_is>, nullptr,
       nullptr, nullptr},
      {"a piece of an obstacle does not move it", check<a_piece_of_an_obstacle_does_not_move_it>, nullptr,
       nullptr, nullptr},
      {"a picture counts once", check<a_picture_counts_once>, nullptr, nullptr, nullptr},
      {"probation moves nothing", check<probation_moves_nothing>, nullptr, nullptr, nullptr},
      {"who passes probation is trusted afterwards", check<who_passes_probation_is_trusted_afterwards>,
       nullptr, nullptr, nullptr},
      {"trust is lent", check<trust_is_lent>, nullptr, nullptr, nullptr},
      {"what is gone is lost", check<what_is_gone_is_lost>, nullptr, nullptr, nullptr},
      {"what nobody looked for is not lost", check<what_nobody_looked_for_is_not_lost>, nullptr, nullptr,
       nullptr},
      {"what is not confirmed is forgotten", check<what_is_not_confirmed_is_forgotten>, nullptr, nullptr,
       nullptr},
      {"an obstacle is gone only where nothing is in doubt",
       check<an_obstacle_is_gone_only_where_nothing_is_in_doubt>, nullptr, nullptr, nullptr},
      {"its place in the next picture is posted", check<its_place_in_the_next_picture_is_posted>, nullptr,
       nullptr, nullptr},
      {"its place in this picture is told", check<its_place_in_this_picture_is_told>, nullptr, nullptr,
       nullptr},
      {"a part that is held is not on the table", check<a_part_that_is_held_is_not_on_the_table>, nullptr,
       nullptr, nullptr},
      {"nothing is looked for behind what is held", check<nothing_is_looked_for_behind_what_is_held>, nullptr,
       nullptr, nullptr},
      {"an obstacle that is confirmed is left in peace for a while",
       [](void**) { assert_true(what_is_confirmed_is_left_in_peace_for_a_while(no_kind)); }, nullptr, nullptr,
       nullptr},
      {"a part that is confirmed is left in peace for a while",
       [](void**) { assert_true(what_is_confirmed_is_left_in_peace_for_a_while(0)); }, nullptr, nullptr,
       nullptr},
      {"the part that the arm goes to is measured in each picture",
       check<the_part_that_the_arm_goes_to_is_measured_in_each_picture>, nullptr, nullptr, nullptr},
      {"what was missed is looked for in each picture", check<what_was_missed_is_looked_for_in_each_picture>,
       nullptr, nullptr, nullptr},
      {"without the tools pose nothing is predicted", check<without_the_tools_pose_nothing_is_predicted>,
       nullptr, nullptr, nullptr},
      {"kinds and places are told apart", check<kinds_and_places_are_told_apart>, nullptr, nullptr, nullptr},
      {"a full list takes no more and says so", check<a_full_list_takes_no_more_and_says_so>, nullptr,
       nullptr, nullptr},
      {"verdicts that were overwritten are counted", check<verdicts_that_were_overwritten_are_counted>,
       nullptr, nullptr, nullptr},
      {"what is no number is no track", check<what_is_no_number_is_no_track>, nullptr, nullptr, nullptr},
      {"forgetting empties the list", check<forgetting_empties_the_list>, nullptr, nullptr, nullptr},
      {"a picture ahead of time ends nothing", check<a_picture_ahead_of_time_ends_nothing>, nullptr, nullptr,
       nullptr},
      {"on a belt it is expected further on", check<on_a_belt_it_is_expected_further_on>, nullptr, nullptr,
       nullptr},
      {"a verdict counts when its picture was taken", check<a_verdict_counts_when_its_picture_was_taken>,
       nullptr, nullptr, nullptr},
      {"an older picture shows the same thing farther back",
       check<an_older_picture_shows_the_same_thing_farther_back>, nullptr, nullptr, nullptr},
      {"a picture without it counts in any order", check<a_picture_without_it_counts_in_any_order>, nullptr,
       nullptr, nullptr},
  };
  return cmocka_run_group_tests_name("object tracks", tests, nullptr, nullptr);
}
