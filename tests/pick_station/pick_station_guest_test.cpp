// The pick station on its real drivers in a real kernel: CAN controllers, a serial line, TCP, GPIO and a
// camera, with drives, gripper and feeder as other programs at the far ends. 5 picks with the emergency stop
// pressed between them, and the CAN cable pulled out in motion; in the long tests 100 picks, too.
#include <cmath>
#include <cstdlib>
#include <initializer_list>

#include "tests/pick_station/real_station.hpp"

namespace flexrf::whole {
namespace {

constexpr std::uint32_t few = 5;
constexpr std::uint32_t many = 100;
constexpr int with_a_fault = 2;  // the exit code

bool are_enabled(RealStation& station) {
  return station.told("axis_x").at("enabled").get<bool>() && station.told("axis_z").at("enabled").get<bool>();
}

/// Nothing moves it any more.
void check_rests(RealStation& station) {
  station.wait_for("the axes at rest", [&] {
    return std::abs(station.told("axis_x").at("velocity").get<double>()) < 1e-3 &&
           std::abs(station.told("axis_z").at("velocity").get<double>()) < 1e-3;
  });
  const double x = station.position_of("axis_x");
  std::this_thread::sleep_for(std::chrono::seconds(1));
  CHECK(std::abs(station.position_of("axis_x") - x) < 1e-3);
}

void start(RealStation& station) {
  station.make_ready();
  station.set("speed", 1.0);
  station.press("start");
}

void check_nothing_went_wrong(RealStation& station) {
  CHECK_EQUAL(station.count("faults"), 0U);
  CHECK_EQUAL(station.count("missed_grips"), 0U);
  CHECK_EQUAL(station.count("lost_parts"), 0U);
  CHECK_EQUAL(station.stop(), 0);
}

void press_emergency_stop_and_go_on(RealStation& station) {
  station.wait_until_it_carries();
  station.box().press_emergency_stop(true);
  station.wait_for_message("The emergency stop is pressed");
  CHECK_EQUAL(station.state(), "off");
  CHECK_CONTAINS(station.text("remedy"), "Release the emergency stop");
  station.wait_for("the red lamp alone",
                   [&] { return station.box().is_lit("LAMP_RED") && !station.box().is_lit("LAMP_GREEN"); });
  station.wait_for("drives without current", [&] { return !are_enabled(station); });
  CHECK(station.told("pick").at("holds_part").get<bool>());
  station.control().clear_stop_motion();
  CHECK(!station.control().start_motion());
  station.box().press_emergency_stop(false);
  check_rests(station);  // released is not started
  CHECK_EQUAL(station.state(), "off");
  station.give_start();
  station.wait_for_state("interrupted");
  CHECK_CONTAINS(station.text("remedy"), "press Reset");
  station.press("reset");
  station.wait_for_state("ready");
  station.press("start");
}

void five_picks_with_an_emergency_stop_between_them() {
  RealStation station;
  start(station);
  station.wait_for_parts(1);
  press_emergency_stop_and_go_on(station);
  station.wait_for_parts(few);
  CHECK(station.told("watch").at("pictures").get<std::uint64_t>() > few);
  check_nothing_went_wrong(station);
}

void a_hundred_picks() {
  RealStation station;
  station.set("batch", many);
  start(station);
  for (std::uint32_t part = 1; part <= many; ++part) station.wait_for_parts(part);
  station.wait_for_message("Ready: the batch is done.");
  CHECK_EQUAL(station.count("parts"), many);
  check_nothing_went_wrong(station);
}

/// From the fault that these drives are in, once its cause is gone.
void initialise_and_pick_on(RealStation& station, std::initializer_list<const char*> axes) {
  for (const char* axis : axes) station.initialise(axis);
  station.wait_for_state("off");
  station.give_start();
  station.wait_for_state("fault");
  station.press("reset");
  station.wait_for_state("not_homed");
  station.press("home");
  station.wait_for_state("ready");
  station.press("start");
  const std::uint64_t before = station.count("parts");
  station.wait_for_parts(before + 1);
}

void a_can_cable_that_is_pulled_out_in_motion_stops_the_axes() {
  RealStation station;
  start(station);
  station.wait_until_it_carries();
  station.set_can_cable(false);
  station.wait_for_message("The axes cannot go on: axis_");
  CHECK_CONTAINS(station.text("message"), "is the cable in");
  CHECK_CONTAINS(station.text("remedy"), "initialise it on its page");
  CHECK_EQUAL(station.state(), "fault");
  station.wait_for("the red lamp", [&] { return station.box().is_lit("LAMP_RED"); });
  // The drives have stopped by themselves: they no longer hear us.
  std::this_thread::sleep_for(std::chrono::seconds(1));
  station.set_can_cable(true);
  initialise_and_pick_on(station, {"axis_x", "axis_z"});
  CHECK_EQUAL(station.stop(), with_a_fault);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(five_picks_with_an_emergency_stop_between_them),
      TEST_APART(a_can_cable_that_is_pulled_out_in_motion_stops_the_axes),
  };
  const CMUnitTest long_tests[] = {TEST_APART(a_hundred_picks)};
  int failed = cmocka_run_group_tests_name("pick station on real drivers", tests, nullptr, nullptr);
  const char* const wants_long = std::getenv("FLEXRF_LONG");
  if (wants_long != nullptr && *wants_long != '\0')
    failed += cmocka_run_group_tests_name("pick station, for long", long_tests, nullptr, nullptr);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
