// The pick station on its real drivers in a real kernel: CAN controllers, a serial line, TCP, GPIO and a
// camera, with drives, gripper and feeder as other programs at the far ends. 5 picks with the emergency stop
// pressed between them, what happens when a cable is pulled out or a wrong drive is connected, and how soon
// it is back; in the long tests 100 picks, and a drive that fails. In none of it a real-time thread
// allocates.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "tests/pick_station/real_station.hpp"
#include "tests/recovery.hpp"

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

/// What is cut off is back in time, from the end of the cause on, by the guest's clock, which counts.
void recover(RealStation& station, const char* cause, const std::function<void()>& end_cause,
             const std::function<bool()>& is_back) {
  const Time begin = MonotonicClock::now();
  end_cause();
  station.wait_for(cause, is_back);
  const bool is_in_time = is_back_in_time(cause, MonotonicClock::now() - begin);
  std::fflush(stdout);  // the case's process ends without
  CHECK(is_in_time);
}

/// The drives are brought up, once more than they were: whether they may move is another question.
std::function<bool()> are_brought_up(RealStation& station, std::initializer_list<const char*> axes) {
  const auto bring_ups = [&station](const std::string& axis) {
    return station.told(axis).at("bring_ups").get<std::uint64_t>();
  };
  std::vector<std::pair<std::string, std::uint64_t>> before;
  for (const char* axis : axes) before.emplace_back(axis, bring_ups(axis));
  return [&station, bring_ups, before] {
    return std::all_of(before.begin(), before.end(), [&](const auto& axis) {
      return bring_ups(axis.first) > axis.second && station.told(axis.first).at("trouble") == "";
    });
  };
}

/// From the fault that these drives are in, once its cause is gone.
void initialise_and_pick_on(RealStation& station, std::initializer_list<const char*> axes) {
  for (const char* axis : axes) {
    const auto is_back = are_brought_up(station, {axis});
    recover(
        station, "a fault, initialised", [&] { station.initialise(axis); }, is_back);
  }
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
  recover(
      station, "a CAN cable that was out", [&] { station.set_can_cable(true); },
      are_brought_up(station, {"axis_x", "axis_z"}));
  CHECK_EQUAL(station.state(), "fault");  // a person looks first
  initialise_and_pick_on(station, {"axis_x", "axis_z"});
  CHECK_EQUAL(station.stop(), with_a_fault);
}

/// It does not go on by itself, and goes on with the part that it holds.
void reset_and_go_on(RealStation& station) {
  const std::uint64_t before = station.count("parts");
  station.press("reset");
  station.wait_for_state("ready");
  CHECK(station.told("pick").at("holds_part").get<bool>());
  station.press("start");
  station.wait_for_parts(before + 1);
}

void see_no_part_and_wait(RealStation& station) {
  station.wait_for_message("the camera does not see it");
  CHECK_EQUAL(station.state(), "waiting_for_part");
  CHECK_CONTAINS(station.text("remedy"), "threshold");
}

void unplug_camera_and_go_on(RealStation& station) {
  CHECK(station.camera().unplug());
  station.wait_for_message("The camera gives no pictures.");
  CHECK_EQUAL(station.state(), "waiting_for_part");
  CHECK_CONTAINS(station.text("remedy"), "See to the camera, or do without it");
  CHECK_CONTAINS(station.told("camera").at("trouble").get<std::string>(), "plugged in");
  CHECK(are_enabled(station));
  check_rests(station);
  const std::uint64_t before = station.count("parts");
  const auto pictures = [&] { return station.told("watch").at("pictures").get<std::uint64_t>(); };
  const std::uint64_t pictures_before = pictures();
  recover(
      station, "a camera that was unplugged", [&] { station.camera().plug_in(); },
      [&] { return station.told("camera").at("present").get<bool>() && pictures() > pictures_before; });
  station.light_feeder(true);
  station.wait_for_parts(before + 1);
  CHECK_EQUAL(station.told("camera").at("recoveries").get<std::uint64_t>(), 1U);
}

void cut_network_and_go_on(RealStation& station) {
  station.wait_until_it_carries();
  const std::uint64_t before = station.count("parts");
  station.set_network_cable(false);
  station.wait_for_message("The IO station does not answer: ");
  // What does not need it was done.
  CHECK_EQUAL(station.count("parts"), before + 1);
  CHECK_EQUAL(station.state(), "waiting_for_part");
  CHECK_CONTAINS(station.text("remedy"), "supply and its cable; it goes on by itself");
  CHECK(are_enabled(station));
  check_rests(station);
  CHECK_CONTAINS(station.told("station_link").at("last_error").get<std::string>(), "timed out");
  recover(
      station, "a network that was cut", [&] { station.set_network_cable(true); },
      [&] { return station.told("io_station").at("online").get<bool>(); });
  station.wait_for_parts(before + 2);
}

void a_camera_and_an_io_station_that_are_cut_off_are_waited_for() {
  RealStation station;
  station.set("ask_camera", true);
  station.set("patience", 1.0);
  station.light_feeder(false);
  start(station);
  see_no_part_and_wait(station);
  unplug_camera_and_go_on(station);
  cut_network_and_go_on(station);
  check_nothing_went_wrong(station);
}

/// A UART does not see that its cable is out: nothing comes any more.
void a_gripper_that_does_not_answer_any_more_is_a_fault() {
  RealStation station;
  start(station);
  station.wait_until_it_carries();
  station.tell_gripper("silent");
  station.wait_for_message("The gripper cannot go on: ");
  CHECK_EQUAL(station.state(), "fault");
  CHECK_CONTAINS(station.text("remedy"), "See to the gripper and press Reset");
  station.wait_for("the red lamp", [&] { return station.box().is_lit("LAMP_RED"); });
  CHECK(are_enabled(station));
  check_rests(station);
  recover(
      station, "a gripper that was silent", [&] { station.tell_gripper("well"); },
      [&] { return station.told("gripper").at("trouble") == ""; });
  CHECK_EQUAL(station.state(), "fault");  // a person looks first
  reset_and_go_on(station);
  CHECK_EQUAL(station.count("faults"), 1U);
  CHECK_EQUAL(station.stop(), 0);
}

void drives_of_another_vendor_are_refused_until_the_right_ones_are_connected() {
  RealStation station("0x999");
  station.give_start();
  station.wait_for_state("fault");
  CHECK_CONTAINS(
      station.text("message"),
      "The axes cannot go on: axis_x: node 1 is not the one that was declared: its vendor is 00000999 "
      "and not 00000123");
  CHECK_CONTAINS(station.text("remedy"), "initialise it on its page");
  station.wait_for("the red lamp", [&] { return station.box().is_lit("LAMP_RED"); });
  CHECK(!are_enabled(station));
  const auto connect_the_right_ones = [&] {
    for (const char* node : {"1 ", "2 "}) {
      station.tell_drives(std::string{node} + "off");
      station.tell_drives(std::string{node} + "object 1018:01 " + RealStation::declared_vendor);
      station.tell_drives(std::string{node} + "on");
    }
  };
  recover(station, "drives of another vendor", connect_the_right_ones,
          are_brought_up(station, {"axis_x", "axis_z"}));
  CHECK_EQUAL(station.state(), "fault");  // a person looks first
  initialise_and_pick_on(station, {"axis_x", "axis_z"});
  CHECK_EQUAL(station.stop(), with_a_fault);
}

void a_drive_that_faults_in_motion_is_initialised_and_homed() {
  RealStation station;
  start(station);
  station.wait_until_it_carries();
  station.tell_drives("1 trip 0x2310");
  station.wait_for_message("The axes cannot go on: axis_x: ");
  CHECK_EQUAL(station.state(), "fault");
  CHECK_CONTAINS(station.text("remedy"), "initialise it on its page");
  check_rests(station);
  CHECK(!station.told("axis_x").at("enabled").get<bool>());
  initialise_and_pick_on(station, {"axis_x"});
  CHECK_EQUAL(station.stop(), with_a_fault);
}

void a_box_that_is_unplugged_is_an_emergency_stop() {
  RealStation station;
  start(station);
  station.wait_until_it_carries();
  station.box().plug(false);
  station.wait_for_message("The emergency stop is pressed, or its line is cut.");
  CHECK_EQUAL(station.state(), "off");
  station.wait_for("drives without current", [&] { return !are_enabled(station); });
  station.control().clear_stop_motion();
  CHECK(!station.control().start_motion());
  recover(
      station, "a box that was unplugged", [&] { station.box().plug(true); },
      [&] { return station.told("box").at("present").get<bool>(); });
  // As lines are taken, gpio-sim pulls them as they are configured: a release before is undone.
  station.box().press_emergency_stop(false);
  check_rests(station);
  CHECK_EQUAL(station.state(), "off");
  station.give_start();
  station.wait_for_state("interrupted");
  reset_and_go_on(station);
  check_nothing_went_wrong(station);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(five_picks_with_an_emergency_stop_between_them),
      TEST_APART(a_can_cable_that_is_pulled_out_in_motion_stops_the_axes),
      TEST_APART(drives_of_another_vendor_are_refused_until_the_right_ones_are_connected),
      TEST_APART(a_camera_and_an_io_station_that_are_cut_off_are_waited_for),
      TEST_APART(a_gripper_that_does_not_answer_any_more_is_a_fault),
      TEST_APART(a_box_that_is_unplugged_is_an_emergency_stop),
  };
  const CMUnitTest long_tests[] = {
      TEST_APART(a_drive_that_faults_in_motion_is_initialised_and_homed),
      TEST_APART(a_hundred_picks),
  };
  int failed = cmocka_run_group_tests_name("pick station on real drivers", tests, nullptr, nullptr);
  const char* const wants_long = std::getenv("FLEXRF_LONG");
  if (wants_long != nullptr && *wants_long != '\0')
    failed += cmocka_run_group_tests_name("pick station, for long", long_tests, nullptr, nullptr);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
