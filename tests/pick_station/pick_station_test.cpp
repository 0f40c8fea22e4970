// A hundred picks in virtual time, on mock and on simulated hardware, the same each time; and how a person
// works the station. What goes wrong with it: trouble_test.cpp, cable_test.cpp.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/applications/running.hpp"
#include "tests/pick_station/cable_test.hpp"
#include "tests/pick_station/hardware.hpp"
#include "tests/pick_station/trouble_test.hpp"

namespace flexrf::pick_station {
namespace {

// ---- a hundred picks

// Sanitizers find in twenty what they find in a hundred.
#ifdef FLEXRF_SANITIZER
constexpr std::uint32_t picks = 20;
#else
constexpr std::uint32_t picks = 100;
#endif

struct Outcome {
  std::uint64_t digest = 0;
  std::uint64_t parts = 0;
  double cycle_time = 0;
};

/// Checks by itself that all went well.
Outcome pick_many(Hardware hardware) {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  station.make_ready()
      .when(
          "ready to begin", [] { return true; },
          [&] {
            station.set("batch", picks);
            station.set("speed", 1.0);
            station.press("start");
          })
      .when("all parts",
            [&] { return station.seen().parts == picks && station.seen().state == PickState::ready; });
  const RunSummary summary = cell.run(long_enough);
  CHECK_EQUAL(summary.exit_code, 0);
  CHECK_EQUAL(station.seen().faults, 0U);
  CHECK_EQUAL(station.seen().missed_grips, 0U);
  CHECK_EQUAL(station.seen().lost_parts, 0U);
  // Ordinary motion is not held back, nor said to be.
  CHECK_EQUAL(station.restraints(), 0U);
  CHECK_EQUAL(station.message(), "Ready: the batch is done.");
  if (MockWorld* world = cell.world()) {
    CHECK_EQUAL(world->taken(), static_cast<int>(picks));
    CHECK_EQUAL(world->laid_down(), static_cast<int>(picks));
    CHECK_EQUAL(world->dropped_elsewhere(), 0);
  }
  CHECK(summary.digest.has_value());
  return {*summary.digest, station.seen().parts, station.seen().cycle_time};
}

/// In a process of its own, as an application runs once in each.
Outcome pick_many_apart(Hardware hardware) {
  int ends[2];
  CHECK(pipe(ends) == 0);
  std::fflush(nullptr);
  const pid_t child = fork();
  CHECK(child >= 0);
  if (child == 0) {
    try {
      const Outcome outcome = pick_many(hardware);
      _exit(write(ends[1], &outcome, sizeof(outcome)) == sizeof(outcome) ? 0 : 3);
    } catch (const fixture::CheckFailed& failed) {
      std::fprintf(stderr, "%s\n", failed.message.c_str());
      _exit(1);
    }
  }
  close(ends[1]);
  Outcome outcome;
  const bool told = read(ends[0], &outcome, sizeof(outcome)) == sizeof(outcome);
  close(ends[0]);
  int status = 0;
  CHECK_EQUAL(waitpid(child, &status, 0), child);
  CHECK(told);
  return outcome;
}

void check_repeats(Hardware hardware) {
  const Outcome first = pick_many_apart(hardware);
  const Outcome second = pick_many_apart(hardware);
  CHECK_EQUAL(first.parts, picks);
  CHECK_EQUAL(first.digest, second.digest);
  CHECK_EQUAL(first.cycle_time, second.cycle_time);
  CHECK(first.cycle_time > 0);
}

void many_picks_on_mocks_are_the_same_each_time() {
  check_repeats(Hardware::mock);
}
void many_picks_on_simulators_are_the_same_each_time() {
  check_repeats(Hardware::simulated);
}

// ---- a person at the panel

template <Hardware hardware>
void nothing_moves_before_start_and_home() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  station.after(std::chrono::seconds(2))
      .when(
          "it says that nothing may move", [&] { return station.message() == "Nothing may move."; },
          [&] {
            CHECK_EQUAL(station.seen().state, PickState::off);
            CHECK_CONTAINS(station.remedy(), "give Start");
            station.press_in_vain("home", "needs motion to be permitted; give Start");
          })
      .after(std::chrono::seconds(1), [&] { CHECK_EQUAL(station.seen().state, PickState::off); })
      .clear_and_start()
      .when_in(PickState::not_homed,
               [&] {
                 CHECK_CONTAINS(station.remedy(), "press Home");
                 station.press_in_vain("start", "needs state to be ready or held");
               })
      .after(std::chrono::seconds(1),
             [&] {
               CHECK_EQUAL(station.seen().state, PickState::not_homed);
               station.press("home");
             })
      .when_in(PickState::homing)
      .when_in(PickState::ready, [&] { CHECK_EQUAL(station.message(), "Ready."); });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
}

template <Hardware hardware>
void a_change_to_manual_mode_holds_after_the_step() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&] { station.press("start"); })
      .when_in(PickState::lowering, [&] { station.set("mode", PickMode::manual); })
      .when_in(PickState::held,
               [&] {
                 CHECK_EQUAL(station.message(), "Held before closing the gripper.");
                 CHECK_CONTAINS(station.remedy(), "Step does it");
                 station.press_in_vain("start", "needs mode to be automatic");
               })
      .after(std::chrono::seconds(1),
             [&] {
               // Start is for the automatic mode.
               CHECK_EQUAL(station.seen().state, PickState::held);
               station.press("next_step");
             })
      .when(
          "the next step is held", [&] { return station.message() == "Held before lifting the part."; },
          [&] {
            CHECK(station.seen().holds_part);
            station.set("mode", PickMode::automatic);
            station.press("start");
          })
      .when("a part", [&] { return station.seen().parts == 1; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
}

template <Hardware hardware>
void held_it_brakes_and_goes_on_from_there() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  double held_at = 0;
  station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&] { station.press("start"); })
      .when(
          "on the way",
          [&] { return station.seen().state == PickState::to_tray && cell.position_of("axis_x") > 0.2; },
          [&] { station.press("hold"); })
      .when_in(PickState::held)
      .after(std::chrono::seconds(2),
             [&] {
               held_at = cell.position_of("axis_x");
               CHECK(held_at > 0.2 && held_at < 0.49);
               CHECK_EQUAL(station.message(), "Held before going to the tray.");
             })
      .after(std::chrono::seconds(1),
             [&] {
               CHECK(std::abs(cell.position_of("axis_x") - held_at) < 1e-4);
               station.press("start");
             })
      .when("a part", [&] { return station.seen().parts == 1; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
}

template <Hardware hardware>
void an_empty_feeder_is_waited_for() {
  Cell cell(hardware, {.stock = 2});
  StationInVirtualTime& station = cell.station();
  int lit = 0;
  int dark = 0;
  station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&] { station.press("start"); })
      .when(
          "it says that the feeder is empty", [&] { return station.message() == "The feeder is empty."; },
          [&] {
            CHECK_EQUAL(station.seen().parts, 2U);
            CHECK_EQUAL(station.seen().state, PickState::waiting_for_part);
            CHECK_CONTAINS(station.remedy(), "Fill the feeder");
          })
      .after(std::chrono::milliseconds(100))
      .when(
          "yellow has blinked",
          [&] {
            ++(station.is_lit("LAMP_YELLOW") ? lit : dark);
            return lit + dark == 300;
          },
          [&] {
            CHECK(lit > 100 && dark > 100);
            CHECK(!station.is_lit("LAMP_GREEN") && !station.is_lit("LAMP_RED"));
            cell.fill_feeder(1);
          })
      .when("the third part", [&] { return station.seen().parts == 3; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
}

template <Hardware hardware>
void green_is_steady_while_it_picks() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  int dark = 0;
  station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&] { station.press("start"); })
      .when_in(PickState::to_feeder)
      .after(std::chrono::milliseconds(100))
      .when("two parts", [&] {
        if (!station.is_lit("LAMP_GREEN")) ++dark;
        return station.seen().parts == 2;
      });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
  CHECK_EQUAL(dark, 0);
}

}  // namespace
}  // namespace flexrf::pick_station

int main() {
  using namespace flexrf::pick_station;
  using enum Hardware;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(many_picks_on_mocks_are_the_same_each_time),
      CONTAINED_TEST(many_picks_on_simulators_are_the_same_each_time),
      TEST_APART(nothing_moves_before_start_and_home<mock>),
      TEST_APART(nothing_moves_before_start_and_home<simulated>),
      TEST_APART(a_change_to_manual_mode_holds_after_the_step<mock>),
      TEST_APART(a_change_to_manual_mode_holds_after_the_step<simulated>),
      TEST_APART(held_it_brakes_and_goes_on_from_there<mock>),
      TEST_APART(held_it_brakes_and_goes_on_from_there<simulated>),
      TEST_APART(an_empty_feeder_is_waited_for<mock>),
      TEST_APART(an_empty_feeder_is_waited_for<simulated>),
      TEST_APART(green_is_steady_while_it_picks<mock>),
      TEST_APART(green_is_steady_while_it_picks<simulated>),
      TEST_APART(an_emergency_stop_in_mid_pick_is_recovered_from<mock>),
      TEST_APART(an_emergency_stop_in_mid_pick_is_recovered_from<simulated>),
      TEST_APART(a_drive_that_faults_in_motion_is_initialised_and_homed<mock>),
      TEST_APART(a_drive_that_faults_in_motion_is_initialised_and_homed<simulated>),
      TEST_APART(a_drive_of_another_vendor_is_refused_until_the_right_one_is_connected),
      TEST_APART(a_station_that_falls_silent_is_waited_for<mock>),
      TEST_APART(a_station_that_falls_silent_is_waited_for<simulated>),
      TEST_APART(a_part_that_is_lost_on_the_way_is_a_fault<mock>),
      TEST_APART(a_part_that_is_lost_on_the_way_is_a_fault<simulated>),
      TEST_APART(a_part_that_is_not_where_it_should_be_is_a_fault),
      TEST_APART(a_can_cable_that_is_pulled_out_in_motion_stops_the_axes<mock>),
      TEST_APART(a_can_cable_that_is_pulled_out_in_motion_stops_the_axes<simulated>),
      TEST_APART(a_gripper_that_is_not_heard_any_more_is_a_fault<mock>),
      TEST_APART(a_gripper_that_is_not_heard_any_more_is_a_fault<simulated>),
      TEST_APART(a_gripper_with_a_fault_of_its_own_is_activated_again<mock>),
      TEST_APART(a_gripper_with_a_fault_of_its_own_is_activated_again<simulated>),
      TEST_APART(an_io_connection_that_is_cut_is_waited_for<mock>),
      TEST_APART(an_io_connection_that_is_cut_is_waited_for<simulated>),
      TEST_APART(a_camera_that_is_unplugged_is_waited_for_where_it_is_asked<mock>),
      TEST_APART(a_camera_that_is_unplugged_is_waited_for_where_it_is_asked<simulated>),
      TEST_APART(a_camera_that_is_not_asked_may_be_unplugged<mock>),
      TEST_APART(a_camera_that_is_not_asked_may_be_unplugged<simulated>),
      TEST_APART(parts_are_taken_only_when_the_camera_sees_them<mock>),
      TEST_APART(parts_are_taken_only_when_the_camera_sees_them<simulated>),
      TEST_APART(a_box_that_is_unplugged_is_an_emergency_stop<mock>),
      TEST_APART(a_box_that_is_unplugged_is_an_emergency_stop<simulated>),
  };
  return cmocka_run_group_tests_name("pick station", tests, nullptr, nullptr);
}
