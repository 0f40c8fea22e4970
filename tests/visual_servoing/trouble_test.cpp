// The cell of apps/visual-servoing in trouble with its population, its parts and its arm, in virtual time:
// what its operator reads, that the arm holds where it should, and how it goes on.
#include "tests/visual_servoing/trouble.hpp"

#include <cmath>
#include <limits>
// Drivers have functions of their own that are called fail, for which CMocka has a macro.
#pragma push_macro("fail")
#undef fail
#include "hal/robot_arm/simulated/simulated_arm.hpp"
#pragma pop_macro("fail")

namespace flexrf::visual_servoing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// ---- the population

void make_unfit(Trouble& trouble, int member) {
  constexpr double nothing = 0;
  const std::string name = "attention[" + std::to_string(member) + "]";
  ParameterRequest request;
  request.kind = RequestKind::set;
  request.component = trouble.cell.component(name.c_str());
  for (const char* const weight : {"colour", "contrast", "motion", "size", "edges", "expectation"}) {
    const std::uint16_t parameter = trouble.cell.parameter(request.component, weight);
    CHECK(request.add(parameter, 0, &nothing, sizeof(nothing)));
  }
  trouble.cell.send(request);
}

/// Without a weight no window stands out, and nobody has a region.
// [trouble-8]
void all_members_are_unfit() {
  Trouble trouble;
  trouble.cell
      .when(
          "it surveys", [&] { return trouble.cell.elapsed() > 0.5; },
          [&] {
            const auto now = trouble.cell.newest<AttentionGeneration>("generation");
            for (std::size_t i = 0; i < now.members.size(); ++i)
              if (now.members[i].active) make_unfit(trouble, static_cast<int>(i));
          })
      .after(milliseconds(200), [&] { trouble.cell.press("tracks", "forget"); })
      .when(
          "it is told", [&] { return !trouble.evolution.warning_view().empty(); },
          [&] {
            CHECK_CONTAINS(trouble.evolution.warning_view(), "no member found anything for 5 generations");
            CHECK_EQUAL(trouble.picker.approaches, 0U);
          })
      .when("it goes to a part", [&] { return trouble.picker.approaches > 0; })
      .when("the warning is gone", [&] { return trouble.evolution.warning_view().empty(); });
  CHECK_EQUAL(trouble.run(), 0);
  CHECK(was_said("no member found anything for 5 generations"));
}

/// Others begin in free places.
// [trouble-9]
void the_active_members_are_in_fault() {
  Trouble trouble;
  std::uint32_t before = 0;
  trouble.cell.when_in(PickerState::approaching)
      .after(milliseconds(100),
             [&] {
               const auto now = trouble.cell.newest<AttentionGeneration>("generation");
               for (std::size_t i = 0; i < now.members.size(); ++i) {
                 if (!now.members[i].active) continue;
                 trouble.fault_member(static_cast<int>(i));
                 ++before;
               }
             })
      .when(
          "it is told", [&] { return trouble.evolution.out_of_service == before; },
          [&] { trouble.remember(); })
      .when("another one works", [&] { return trouble.evolution.active > 0; })
      .when(
          "a child joins it", [&] { return trouble.evolution.active > 1; },
          [&] {
            CHECK_EQUAL(trouble.evolution.out_of_service, before);
            CHECK_EQUAL(trouble.evolution.refused, 0U);
          })
      .when("the arm goes on", [&] { return trouble.has_gone_on(); });
  CHECK_EQUAL(trouble.run(), with_a_fault);
  CHECK(was_said("one begins anew with the weights of the table's row"));
}

/// A part in hand is brought away, and no other is gone to: nobody sees what is new.
// [trouble-10]
void every_member_is_in_fault() {
  Trouble trouble;
  trouble.cell
      .when_in(PickerState::carrying,
               [&] {
                 trouble.remember();
                 for (int i = 0; i < 16; ++i) trouble.fault_member(i);
               })
      .when("it is told", [&] { return trouble.evolution.out_of_service == 16; })
      .when(
          "the part is brought away", [&] { return trouble.has_binned(); }, [&] { trouble.remember(); })
      .when_in(PickerState::waiting, [&] { trouble.begin_stillness(); })
      .after(seconds(1),
             [&] {
               trouble.check_stillness();
               CHECK(!trouble.has_gone_on());
               trouble.check_message("Waiting: no member of attention runs", "the members of attention");
               CHECK_CONTAINS(trouble.evolution.warning_view(), "all members are in fault or stopped");
               trouble.cell.initialise("attention[3]");
             })
      .when_in(PickerState::off,
               [&] {
                 trouble.check_message("Not moving: nothing may move", "give Start");
                 CHECK(trouble.cell.control().start_motion().is_ok());
               })
      .when("the arm goes on", [&] { return trouble.has_gone_on(); });
  CHECK_EQUAL(trouble.run(), with_a_fault);
  CHECK(was_said("all members are in fault or stopped"));
}

// ---- the part, and the arm

/// From 1, as the table counts them.
std::uint32_t part_gone_to(Trouble& trouble) {
  const auto scene = trouble.cell.newest<SceneState>("scene");
  const auto& place = trouble.picker.target_place;
  std::uint32_t nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    const auto& part = scene.parts[i];
    if (part.kind == SceneKind::none) continue;
    const double distance = std::hypot(part.position[0] - place[0], part.position[1] - place[1]);
    if (distance >= least) continue;
    least = distance;
    nearest = i + 1;
  }
  return nearest;
}

// [trouble-11]
void the_part_is_pushed_far_away() {
  Trouble trouble;
  std::uint64_t lost = 0;
  trouble.cell.when_in(PickerState::approaching)
      .after(milliseconds(100),
             [&] {
               lost = trouble.picker.lost_targets;
               trouble.cell.set("table", "part", part_gone_to(trouble));
               trouble.cell.set("table", "push_way", 0.1);
               trouble.cell.press("table", "push_part");
             })
      .when_in(PickerState::target_lost,
               [&] {
                 CHECK_EQUAL(trouble.cell.table().refusal_view(), "");
                 trouble.check_message("The part was lost: ", "");
                 CHECK_EQUAL(trouble.picker.lost_targets, lost + 1);
                 trouble.remember();
               })
      .when("it goes on", [&] { return trouble.has_gone_on(); });
  CHECK_EQUAL(trouble.run(), 0);
  CHECK_EQUAL(trouble.cell.table().contacts, 0U);
}

// [trouble-12]
void the_table_is_laid_anew() {
  Trouble trouble;
  trouble.cell.when_in(PickerState::approaching)
      .after(milliseconds(100), [&] { trouble.cell.press("table", "lay_table"); })
      .when(
          "the approach ends",
          [&] {
            return trouble.picker.state == PickerState::target_lost ||
                   trouble.picker.state == PickerState::blocked;
          },
          [&] { trouble.remember(); })
      .when("it goes on", [&] { return trouble.has_gone_on(); });
  CHECK_EQUAL(trouble.run(), 0);
}

/// The fingers keep what they closed on; after Start it is brought away.
// [trouble-13]
void the_arm_fails_as_the_fingers_close() {
  Trouble trouble;
  trouble.cell
      .when_in(PickerState::closing,
               [&] {
                 Component& arm = trouble.cell.executive().cell().component(trouble.cell.component("arm"));
                 dynamic_cast<SimulatedArm&>(arm).inject(SimulatedArm::Fault::drives_trip);
               })
      .when_in(PickerState::off, [&] { trouble.remember(); })
      .after(braking,
             [&] {
               trouble.begin_stillness();
               trouble.check_message("Not moving: the arm is in fault: the simulated drives tripped",
                                     "initialise it on its page, and give Start");
               CHECK_CONTAINS(trouble.robot.holding_view(), "the arm is in fault");
             })
      .after(seconds(1), [&] { trouble.cell.initialise("arm"); })
      .after(seconds(1),
             [&] {
               trouble.check_stillness();
               trouble.check_message("Not moving: nothing may move", "give Start");
               CHECK(trouble.cell.table().held_part != 0);
               CHECK(trouble.cell.control().start_motion().is_ok());
             })
      .when("the part is in its bin", [&] { return trouble.has_binned(); });
  CHECK_EQUAL(trouble.run(), with_a_fault);
  CHECK_EQUAL(trouble.cell.table().contacts, 0U);
  CHECK(was_said("the simulated drives tripped"));
}

}  // namespace
}  // namespace flexrf::visual_servoing

int main() {
  using namespace flexrf::visual_servoing;
  const CMUnitTest tests[] = {
      TEST_APART(all_members_are_unfit),    TEST_APART(the_active_members_are_in_fault),
      TEST_APART(every_member_is_in_fault), TEST_APART(the_part_is_pushed_far_away),
      TEST_APART(the_table_is_laid_anew),   TEST_APART(the_arm_fails_as_the_fingers_close),
  };
  return cmocka_run_group_tests_name("visual servoing in trouble", tests, nullptr, nullptr);
}
