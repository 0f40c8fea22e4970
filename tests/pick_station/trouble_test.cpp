#include "tests/pick_station/trouble_test.hpp"

#include <cmath>

namespace flexrf::pick_station {
template <Hardware hardware>
void an_emergency_stop_in_mid_pick_is_recovered_from() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  double stopped_at = 0;
  station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&] { station.press("start"); })
      .when(
          "on the way with a part",
          [&] { return station.seen().state == PickState::to_tray && cell.position_of("axis_x") > 0.2; },
          [&] { station.press_emergency_stop(true); })
      .when_in(PickState::off, [&] { CHECK(station.control().safe_state_latched()); })
      .after(std::chrono::seconds(2),
             [&] {
               stopped_at = cell.position_of("axis_x");
               CHECK(stopped_at < 0.49);
               CHECK_CONTAINS(station.message(), "emergency stop is pressed");
               CHECK_CONTAINS(station.remedy(), "Release the emergency stop");
               CHECK(station.is_lit("LAMP_RED") && !station.is_lit("LAMP_GREEN"));
               station.control().clear_stop_motion();
               CHECK(!station.control().start_motion());
               station.press_emergency_stop(false);
             })
      .after(std::chrono::seconds(1),
             [&] {
               // Released is not started.
               CHECK_EQUAL(station.seen().state, PickState::off);
               CHECK(std::abs(cell.position_of("axis_x") - stopped_at) < 1e-4);
             })
      .clear_and_start()
      .when_in(PickState::interrupted,
               [&] {
                 CHECK_EQUAL(station.message(), "Stopped in the middle of something.");
                 CHECK_CONTAINS(station.remedy(), "press Reset");
                 // Not before a person has looked.
                 station.press_in_vain("start", "needs state to be ready or held");
               })
      .after(std::chrono::seconds(1),
             [&] {
               CHECK_EQUAL(station.seen().state, PickState::interrupted);
               station.press("reset");
             })
      .when_in(PickState::ready,
               [&] {
                 // It still holds the part, and goes on with it.
                 CHECK(station.seen().holds_part);
                 station.press("start");
               })
      .when_in(PickState::to_tray)
      .when("two parts", [&] { return station.seen().parts == 2; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
  CHECK_EQUAL(station.seen().faults, 0U);
  if (MockWorld* world = cell.world()) CHECK_EQUAL(world->dropped_elsewhere(), 0);
}

template <Hardware hardware>
void a_drive_that_faults_in_motion_is_initialised_and_homed() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&] { station.press("start"); })
      .when(
          "on the way with a part",
          [&] { return station.seen().state == PickState::to_tray && cell.position_of("axis_x") > 0.2; },
          [&] { cell.trip_drive("axis_x"); })
      .when_in(PickState::fault,
               [&] {
                 CHECK_CONTAINS(station.message(), "The axes cannot go on: axis_x: ");
                 CHECK_CONTAINS(station.remedy(), "initialise it on its page");
               })
      .after(std::chrono::milliseconds(100),
             [&] {
               CHECK(station.is_lit("LAMP_RED"));
               station.press("reset");  // the drive is as before
             })
      .after(std::chrono::seconds(15),
             [&] {
               CHECK_EQUAL(station.seen().state, PickState::fault);
               station.initialise("axis_x");
             })
      .leave_fault_and_home()
      .when_in(PickState::ready, [&] { station.press("start"); })
      .when("two parts", [&] { return station.seen().parts == 2; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, with_a_fault);
}

void a_drive_of_another_vendor_is_refused_until_the_right_one_is_connected() {
  Cell cell(Hardware::simulated);
  StationInVirtualTime& station = cell.station();
  const auto refused = [&] { return !station.device<ServoDrive>("axis_x").fault().is_ok(); };
  station
      .when(
          "the first cycle", [] { return true; }, [&] { cell.connect_drive_of(0x999, "axis_x"); })
      .when("the drive is refused", refused,
            [&] {
              CHECK_EQUAL(std::string{station.device<ServoDrive>("axis_x").fault().cause()},
                          "node 1 is not the one that was declared: its vendor is 00000999 and not 00000123; "
                          "is the number set right on the device?");
              CHECK(station.device<ServoDrive>("axis_z").fault().is_ok());
            })
      .clear_and_start()
      .when("it says so at once",
            [&] {
              return station.message().find("The axes do not follow: axis_x: node 1 is not the one") == 0;
            })
      .when_in(PickState::fault,
               [&] {
                 CHECK_CONTAINS(station.message(),
                                "The axes cannot go on: axis_x: node 1 is not the one that was declared: its "
                                "vendor is 00000999 and not 00000123");
                 CHECK_CONTAINS(station.remedy(), "initialise it on its page");
               })
      .after(std::chrono::milliseconds(100),
             [&] {
               CHECK(station.is_lit("LAMP_RED"));
               CHECK(!station.told_by<ServoDriveFeedback>("axis_x").enabled);
               cell.connect_drive_of(0x123, "axis_x");
             })
      .after(std::chrono::seconds(2),
             [&] {
               // It is brought up, and does not go on by itself.
               CHECK_EQUAL(text_view(station.told_by<ServoDriveFeedback>("axis_x").trouble), "");
               CHECK_EQUAL(station.seen().state, PickState::fault);
               station.initialise("axis_x");
             })
      .leave_fault_and_home()
      .when_in(PickState::ready, [&] { station.press("start"); })
      .when("a part", [&] { return station.seen().parts == 1; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, with_a_fault);
}

template <Hardware hardware>
void a_station_that_falls_silent_is_waited_for() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&] { station.press("start"); })
      .when(
          "a part", [&] { return station.seen().parts == 1; }, [&] { cell.silence_station(true); })
      .when(
          "it says so", [&] { return station.message().find("IO station does not answer") == 4; },
          [&] {
            CHECK_EQUAL(station.seen().state, PickState::waiting_for_part);
            CHECK_CONTAINS(station.remedy(), "goes on by itself");
            cell.silence_station(false);
          })
      .when("the next part", [&] { return station.seen().parts == 2; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
}

template <Hardware hardware>
void a_part_that_is_lost_on_the_way_is_a_fault() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&] { station.press("start"); })
      .when(
          "on the way with a part",
          [&] { return station.seen().state == PickState::to_tray && cell.position_of("axis_x") > 0.2; },
          [&] { cell.lose_part(); })
      .when_in(PickState::fault,
               [&] {
                 CHECK_EQUAL(station.message(), "The part was lost on the way to the tray.");
                 CHECK_CONTAINS(station.remedy(), "Take the part out of the way");
                 CHECK_EQUAL(station.seen().lost_parts, 1U);
               })
      .after(std::chrono::seconds(1), [&] { station.press("reset"); })
      .when_in(PickState::ready, [&] { station.press("start"); })
      .when("a part", [&] { return station.seen().parts == 1; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
}

void a_part_that_is_not_where_it_should_be_is_a_fault() {
  Cell cell(Hardware::mock);
  StationInVirtualTime& station = cell.station();
  station.make_ready()
      .when(
          "ready to begin", [] { return true; },
          [&] {
            cell.world()->hide_part(true);
            station.press("start");
          })
      .when_in(PickState::fault,
               [&] {
                 CHECK_CONTAINS(station.message(), "The gripper closed on nothing");
                 CHECK_CONTAINS(station.remedy(), "See how the part lies");
                 CHECK_EQUAL(station.seen().missed_grips, 2U);
                 cell.world()->hide_part(false);
               })
      .after(std::chrono::seconds(1), [&] { station.press("reset"); })
      .when_in(PickState::ready, [&] { station.press("start"); })
      .when("a part", [&] { return station.seen().parts == 1; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
}

template void an_emergency_stop_in_mid_pick_is_recovered_from<Hardware::mock>();
template void an_emergency_stop_in_mid_pick_is_recovered_from<Hardware::simulated>();
template void a_drive_that_faults_in_motion_is_initialised_and_homed<Hardware::mock>();
template void a_drive_that_faults_in_motion_is_initialised_and_homed<Hardware::simulated>();
template void a_part_that_is_lost_on_the_way_is_a_fault<Hardware::mock>();
template void a_part_that_is_lost_on_the_way_is_a_fault<Hardware::simulated>();
template void a_station_that_falls_silent_is_waited_for<Hardware::mock>();
template void a_station_that_falls_silent_is_waited_for<Hardware::simulated>();

}  // namespace flexrf::pick_station
