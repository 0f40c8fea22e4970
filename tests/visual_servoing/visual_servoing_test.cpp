// The cell of apps/visual-servoing in virtual time: it keeps picking, a person changes light, parts and
// obstacles meanwhile, and covers the lens. Judged by the truth of its scene.
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "hal/scene/interface/part_catalogue.hpp"
#include "tests/visual_servoing/pick_judge.hpp"
#include "tests/visual_servoing/way_judge.hpp"
#include "types/joint_state.hpp"
#include "types/pose.hpp"

namespace flexrf::visual_servoing {
namespace {

using std::chrono::seconds;

// Where each instruction costs several there is less of it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(FLEXRF_CHECKED)
constexpr Duration whole_run = seconds(15);
constexpr std::uint64_t least_binned = 2;
#else
constexpr Duration whole_run = seconds(60);
constexpr std::uint64_t least_binned = 8;
#endif

std::uint64_t truly_binned(const ServoingCell& cell) {
  std::uint64_t count = 0;
  for (const std::uint32_t one : cell.table().binned) count += one;
  return count;
}

double largest_joint_speed(ServoingCell& cell) {
  return cell.newest<JointState>("joints").velocity_map().cwiseAbs().maxCoeff();
}

// [picker-1] [picker-2] [picker-6]
void the_arm_keeps_picking() {
  ServoingCell cell(1);
  PickJudge judge(cell);
  WayJudge ways(cell);
  double most_beside = 0;  // m from the straight way down, where obstacles may stand 4 mm beside the hand
  cell.run(whole_run, [&] {
    judge.look();
    ways.look();
    const auto tool = cell.newest<Pose>("tool_pose");
    const PartPickerFeedback& picker = cell.picker();
    if (picker.state != PickerState::descending || tool.position[2] > 0.24) return;
    most_beside = std::max(most_beside, std::hypot(tool.position[0] - picker.grasp_place[0],
                                                   tool.position[1] - picker.grasp_place[1]));
  });
  CHECK(most_beside > 0 && most_beside < 0.004);
  CHECK(cell.picker().binned >= least_binned);
  CHECK_EQUAL(truly_binned(cell), cell.picker().binned);
  CHECK_EQUAL(cell.table().contacts, 0U);
  CHECK_EQUAL(cell.picker().lost_parts, 0U);
  CHECK_EQUAL(cell.picker().failed_grasps, 0U);
  CHECK(ways.ways().size() >= 10 * least_binned);
  for (const Way& way : ways.ways()) CHECK(way.farthest < most_beside_way);
  for (const Approach& one : judge.approaches())
    if (one.binned) CHECK(one.is_good());
}

std::uint64_t digest_of_a_run() {
  void* const shared =
      mmap(nullptr, sizeof(std::uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  static std::uint64_t* digest = nullptr;
  digest = static_cast<std::uint64_t*>(shared);
  whole::in_a_process([] {
    ServoingCell cell(3);
    cell.run(seconds(9));
    *digest = cell.digest();
  });
  const std::uint64_t found = *digest;
  munmap(shared, sizeof(std::uint64_t));
  return found;
}

void two_runs_have_the_same_digest(void**) {
  const std::uint64_t first = digest_of_a_run();
  assert_true(first != 0);
  assert_true(digest_of_a_run() == first);
}

// [picker-3]
void a_person_changes_light_parts_and_obstacles() {
  ServoingCell cell(2);
  PickJudge judge(cell);
  std::uint64_t binned = 0;
  std::uint32_t obstacles = 0;
  cell.when_in(PickerState::approaching, [&] {
    cell.set("table", "light_intensity", 0.6);
    cell.set("table", "light_azimuth", -1.0);
  });
  cell.when_in(PickerState::lifting);
  // A post beside the part that it goes to next, or where there is room.
  cell.when_in(PickerState::approaching, [&] {
    obstacles = cell.table().obstacles;
    const std::array<double, 2> place{cell.picker().target_place[0] - 0.07, cell.picker().target_place[1]};
    cell.set("table", "place", place);
  });
  cell.after(std::chrono::milliseconds(50), [&] { cell.press("table", "add_obstacle"); });
  cell.after(std::chrono::milliseconds(50),
             [&] { CHECK(cell.table().obstacles == obstacles + 1 || !cell.table().refusal_view().empty()); });
  cell.when_in(PickerState::carrying);
  cell.when_in(PickerState::approaching, [&] {
    const std::array<double, 2> place{cell.picker().target_place[0], cell.picker().target_place[1]};
    cell.set("table", "place", place);
    cell.set("table", "push_way", 0.04);
  });
  cell.after(std::chrono::milliseconds(50), [&] {
    cell.press("table", "push_part");
    binned = cell.picker().binned;
  });
  cell.when("two more parts are in their bins", [&] { return cell.picker().binned >= binned + 2; });
  cell.run(seconds(60), [&] { judge.look(); });
  CHECK_EQUAL(cell.table().contacts, 0U);
  for (const Approach& one : judge.approaches())
    if (one.binned) CHECK(one.is_good());
}

/// Beside the middle of the bin that a part is being brought to, so far along its x.
void put_an_obstacle_into_the_bin(ServoingCell& cell, double aside) {
  cell.when_in(PickerState::carrying);
  cell.after(std::chrono::milliseconds(600), [&cell, aside] {
    const PlaneVector bin = part_bins[cell.picker().target_kind].middle;
    cell.set("table", "place", std::array<double, 2>{bin.x + aside, bin.y});
  });
  cell.after(std::chrono::milliseconds(50), [&cell] { cell.press("table", "add_obstacle"); });
}

// [picker-5]
void an_obstacle_in_the_bin_is_seen_and_remembered() {
  ServoingCell cell(1);
  std::uint64_t binned = 0;
  put_an_obstacle_into_the_bin(cell, 0);
  cell.when_in(PickerState::blocked, [&] {
    CHECK(cell.message().find("obstacle stands in the bin") != std::string::npos);
    binned = cell.picker().binned;
  });
  cell.after(whole_run, [&] {
    CHECK(cell.picker().state == PickerState::blocked);
    CHECK_EQUAL(cell.picker().binned, binned);
    cell.press("table", "remove_obstacles");
  });
  cell.when("the part is in its bin", [&] { return cell.picker().binned > binned; });
  cell.run(2 * whole_run);
  CHECK_EQUAL(cell.table().contacts, 0U);
  CHECK_EQUAL(cell.picker().lost_parts, 0U);
}

/// `after`: ms from the end of the look until the obstacle is put there; the hand is above the part after
/// 550.
// [picker-5]
template <int after>
void an_obstacle_that_comes_before_the_blind_way_is_avoided() {
  ServoingCell cell(1);
  std::uint32_t laid = 0;
  cell.when_in(PickerState::descending, [&] {
    laid = cell.table().obstacles;
    const auto& grasp = cell.picker().grasp_place;
    cell.set(
        "table", "place",
        std::array<double, 2>{grasp[0] + 0.06 * std::cos(grasp[2]), grasp[1] + 0.06 * std::sin(grasp[2])});
  });
  cell.after(std::chrono::milliseconds(after), [&] { cell.press("table", "add_obstacle"); });
  cell.when_in(PickerState::blocked, [&] { CHECK_EQUAL(cell.table().obstacles, laid + 1); });
  cell.after(seconds(3));
  cell.run(seconds(30));
  CHECK_EQUAL(cell.table().contacts, 0U);
}

// [picker-5]
void beside_an_obstacle_in_the_bin_there_is_room() {
  ServoingCell cell(1);
  std::uint64_t binned = 0;
  put_an_obstacle_into_the_bin(cell, 0.06);
  cell.after(Duration{}, [&] { binned = cell.picker().binned; });
  cell.when("the part is in its bin", [&] { return cell.picker().binned > binned; });
  cell.run(whole_run);
  CHECK_EQUAL(cell.table().contacts, 0U);
  CHECK_EQUAL(cell.picker().lost_parts, 0U);
}

// [picker-4]
void the_lens_is_covered_and_the_arm_holds() {
  ServoingCell cell(4);
  const auto cover = [&](bool covered) { cell.set("table", "cover_lens", covered); };
  std::uint64_t binned = 0;
  for (const PickerState state : {PickerState::approaching, PickerState::carrying}) {
    cell.when_in(state, [&] { cover(true); });
    cell.when_in(PickerState::no_sight);
    cell.after(seconds(1), [&] {
      CHECK(largest_joint_speed(cell) < 0.02);  // the sensors' noise
      CHECK(cell.picker().state == PickerState::no_sight);
      CHECK(cell.message().find("the arm holds") != std::string::npos);
      CHECK(cell.told_by<FeatureExtractionFeedback>("features").state == PictureState::black);
      binned = cell.picker().binned;
      cover(false);
    });
    cell.when("another part is in its bin", [&] { return cell.picker().binned > binned; });
  }
  cell.run(seconds(60));
  CHECK_EQUAL(cell.table().contacts, 0U);
  CHECK_EQUAL(cell.picker().lost_parts, 0U);
}

}  // namespace
}  // namespace flexrf::visual_servoing

int main() {
  using namespace flexrf::visual_servoing;
  const CMUnitTest tests[] = {
      TEST_APART(the_arm_keeps_picking),
      cmocka_unit_test(two_runs_have_the_same_digest),
      TEST_APART(a_person_changes_light_parts_and_obstacles),
      TEST_APART(an_obstacle_in_the_bin_is_seen_and_remembered),
      TEST_APART(an_obstacle_that_comes_before_the_blind_way_is_avoided<100>),
      TEST_APART(an_obstacle_that_comes_before_the_blind_way_is_avoided<250>),
      TEST_APART(an_obstacle_that_comes_before_the_blind_way_is_avoided<400>),
      TEST_APART(beside_an_obstacle_in_the_bin_there_is_room),
      TEST_APART(the_lens_is_covered_and_the_arm_holds),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
