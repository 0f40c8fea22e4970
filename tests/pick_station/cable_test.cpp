#include "tests/pick_station/cable_test.hpp"

#include <cmath>

#include "hal/camera/interface/virtual_camera.hpp"
#include "units/part_watch/part_watch.hpp"

namespace flexrf::pick_station {
namespace {

constexpr double still = 1e-4;  // m

bool is_carrying(Cell& cell) {
  return cell.station().seen().state == PickState::to_tray && cell.position_of("axis_x") > 0.2;
}

/// From power-on until it is on its way to the tray with a part; then this happens.
StationInVirtualTime& while_it_carries(Cell& cell, std::function<void()> happens) {
  StationInVirtualTime& station = cell.station();
  return station.make_ready()
      .when(
          "ready to begin", [] { return true; }, [&station] { station.press("start"); })
      .when(
          "on the way with a part", [&cell] { return is_carrying(cell); }, std::move(happens));
}

/// The axes come to rest, and stay where they are.
void expect_rest(Cell& cell) {
  auto rests_at = std::make_shared<double>(0);
  cell.station()
      .after(std::chrono::seconds(2),
             [&cell, rests_at] {
               *rests_at = cell.true_position_of("axis_x");
               CHECK(*rests_at < 0.49);
               CHECK(cell.station().is_lit("LAMP_RED") && !cell.station().is_lit("LAMP_GREEN"));
             })
      .after(std::chrono::seconds(1),
             [&cell, rests_at] { CHECK(std::abs(cell.true_position_of("axis_x") - *rests_at) < still); });
}

void start(Cell& cell) {
  cell.station().make_ready().when(
      "ready to begin", [] { return true; }, [&cell] { cell.station().press("start"); });
}

}  // namespace

template <Hardware hardware>
void a_can_cable_that_is_pulled_out_in_motion_stops_the_axes() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  while_it_carries(cell, [&] { cell.plug_can(false); }).when_in(PickState::fault, [&] {
    CHECK_CONTAINS(station.message(), "The axes cannot go on: axis_");
    CHECK_CONTAINS(station.remedy(), "initialise it on its page");
    CHECK(station.seen().holds_part);
  });
  expect_rest(cell);
  double stopped_at = 0;
  station
      .when(
          "the cable", [] { return true; },
          [&] {
            stopped_at = cell.true_position_of("axis_x");
            cell.plug_can(true);
          })
      .after(std::chrono::seconds(2), [&] {
        // It does not go on by itself.
        CHECK_EQUAL(station.seen().state, PickState::fault);
        CHECK(std::abs(cell.true_position_of("axis_x") - stopped_at) < still);
        if (hardware == Hardware::mock) return station.press("reset");
        station.initialise("axis_x");
        station.initialise("axis_z");
      });
  // The drives forgot what they were told, and where they are.
  if (hardware == Hardware::simulated) station.leave_fault_and_home();
  station.when_in(PickState::ready, [&] { station.press("start"); }).when("two parts", [&] {
    return station.seen().parts == 2;
  });
  CHECK_EQUAL(cell.run(long_enough).exit_code, hardware == Hardware::mock ? 0 : with_a_fault);
}

template <Hardware hardware>
void a_gripper_that_is_not_heard_any_more_is_a_fault() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  while_it_carries(cell, [&] { cell.plug_gripper(false); }).when_in(PickState::fault, [&] {
    CHECK_CONTAINS(station.message(), "The gripper cannot go on: ");
    CHECK_CONTAINS(station.remedy(), "See to the gripper and press Reset");
  });
  expect_rest(cell);
  station
      .when(
          "the cable", [] { return true; }, [&] { cell.plug_gripper(true); })
      .after(std::chrono::seconds(3),
             [&] {
               CHECK_EQUAL(station.seen().state, PickState::fault);  // a person looks first
               station.press("reset");
             })
      .when_in(PickState::ready, [&] { station.press("start"); })
      .when("two parts", [&] { return station.seen().parts == 2; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
  CHECK_EQUAL(station.seen().faults, 1U);
}

template <Hardware hardware>
void a_gripper_with_a_fault_of_its_own_is_activated_again() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  while_it_carries(cell, [&] { cell.trip_gripper(); }).when_in(PickState::fault, [&] {
    CHECK_CONTAINS(station.message(), "The gripper cannot go on: ");
    CHECK_CONTAINS(station.remedy(), "it may open and drop its part");
  });
  expect_rest(cell);
  station
      .when(
          "a person", [] { return true; }, [&] { station.press("reset"); })
      .when_in(PickState::ready, [&] { station.press("start"); })
      .when("two parts", [&] { return station.seen().parts == 2; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
  CHECK_EQUAL(station.seen().faults, 1U);
}

template <Hardware hardware>
void an_io_connection_that_is_cut_is_waited_for() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  while_it_carries(cell, [&] { cell.plug_station(false); })
      .when("it says so", [&] { return station.message().find("The IO station does not answer: ") == 0; })
      .after(std::chrono::milliseconds(100),
             [&] {
               // What does not need the station was done.
               CHECK_EQUAL(station.seen().parts, 1U);
               CHECK_EQUAL(station.seen().state, PickState::waiting_for_part);
               CHECK_CONTAINS(station.remedy(), "supply and its cable; it goes on by itself");
               CHECK(!station.is_lit("LAMP_GREEN") && !station.is_lit("LAMP_RED"));
               CHECK(std::abs(cell.position_of("axis_x") - 0.1) < 0.001);
               cell.plug_station(true);
             })
      .when("two more", [&] { return station.seen().parts == 3; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
  CHECK_EQUAL(station.seen().faults, 0U);
}

template <Hardware hardware>
void a_camera_that_is_unplugged_is_waited_for_where_it_is_asked() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  station.set("ask_camera", true);
  cell.make_camera_see();
  start(cell);
  station
      .when(
          "a part", [&] { return station.seen().parts == 1; }, [&] { cell.camera().plugged.store(false); })
      .when(
          "it says so", [&] { return station.message() == "The camera gives no pictures."; },
          [&] {
            CHECK_EQUAL(station.seen().state, PickState::waiting_for_part);
            CHECK_CONTAINS(station.remedy(), "See to the camera, or do without it");
            CHECK_CONTAINS(text_view(station.template told_by<CameraFeedback>("camera").trouble),
                           "plugged in");
            CHECK(std::abs(cell.position_of("axis_x") - 0.1) < 0.001);
            cell.camera().plugged.store(true);
          })
      .when("two more", [&] { return station.seen().parts == 3; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
  CHECK_EQUAL(station.seen().faults, 0U);
  CHECK_EQUAL(station.template told_by<CameraFeedback>("camera").recoveries, 1U);
}

template <Hardware hardware>
void a_camera_that_is_not_asked_may_be_unplugged() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  while_it_carries(cell, [&] { cell.camera().plugged.store(false); }).when("two parts", [&] {
    return station.seen().parts == 2;
  });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
  CHECK(!station.template told_by<CameraFeedback>("camera").present);
  CHECK_EQUAL(station.seen().faults, 0U);
}

template <Hardware hardware>
void parts_are_taken_only_when_the_camera_sees_them() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  station.set("ask_camera", true);
  cell.make_camera_see();
  start(cell);
  int waits = 0;
  int taken = 0;
  bool saw = false;
  PickState before = PickState::off;
  station.when("five parts", [&] {
    const bool sees = station.template told_by<PartWatchFeedback>("watch").seen;
    const PickState now = station.seen().state;
    if (now == PickState::waiting_for_part && station.seen().part_present && !sees) ++waits;
    if (now == PickState::lowering && before != PickState::lowering) {
      ++taken;
      CHECK(sees || saw);  // a cycle ago: what it decided by
    }
    saw = sees;
    before = now;
    return station.seen().parts == 5;
  });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
  CHECK_EQUAL(taken, 5);
  CHECK(waits > 0);
}

template <Hardware hardware>
void a_box_that_is_unplugged_is_an_emergency_stop() {
  Cell cell(hardware);
  StationInVirtualTime& station = cell.station();
  double stopped_at = 0;
  while_it_carries(cell, [&] { station.plug_box(false); })
      .when_in(PickState::off, [&] { CHECK(station.control().safe_state_latched()); })
      .after(std::chrono::seconds(2),
             [&] {
               CHECK_CONTAINS(station.message(), "The emergency stop is pressed, or its line is cut.");
               stopped_at = cell.position_of("axis_x");
               CHECK(stopped_at < 0.49);
               station.control().clear_stop_motion();
               CHECK(!station.control().start_motion());
               station.plug_box(true);
             })
      .after(std::chrono::seconds(1),
             [&] { CHECK(std::abs(cell.position_of("axis_x") - stopped_at) < still); })
      .clear_and_start()
      .when_in(PickState::interrupted, [&] { station.press("reset"); })
      .when_in(PickState::ready,
               [&] {
                 CHECK(station.seen().holds_part);
                 station.press("start");
               })
      .when("two parts", [&] { return station.seen().parts == 2; });
  CHECK_EQUAL(cell.run(long_enough).exit_code, 0);
}

template void a_can_cable_that_is_pulled_out_in_motion_stops_the_axes<Hardware::mock>();
template void a_can_cable_that_is_pulled_out_in_motion_stops_the_axes<Hardware::simulated>();
template void a_gripper_that_is_not_heard_any_more_is_a_fault<Hardware::mock>();
template void a_gripper_that_is_not_heard_any_more_is_a_fault<Hardware::simulated>();
template void a_gripper_with_a_fault_of_its_own_is_activated_again<Hardware::mock>();
template void a_gripper_with_a_fault_of_its_own_is_activated_again<Hardware::simulated>();
template void an_io_connection_that_is_cut_is_waited_for<Hardware::mock>();
template void an_io_connection_that_is_cut_is_waited_for<Hardware::simulated>();
template void a_camera_that_is_unplugged_is_waited_for_where_it_is_asked<Hardware::mock>();
template void a_camera_that_is_unplugged_is_waited_for_where_it_is_asked<Hardware::simulated>();
template void a_camera_that_is_not_asked_may_be_unplugged<Hardware::mock>();
template void a_camera_that_is_not_asked_may_be_unplugged<Hardware::simulated>();
template void parts_are_taken_only_when_the_camera_sees_them<Hardware::mock>();
template void parts_are_taken_only_when_the_camera_sees_them<Hardware::simulated>();
template void a_box_that_is_unplugged_is_an_emergency_stop<Hardware::mock>();
template void a_box_that_is_unplugged_is_an_emergency_stop<Hardware::simulated>();

}  // namespace flexrf::pick_station
