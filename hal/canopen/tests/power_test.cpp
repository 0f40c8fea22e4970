// The state machine of a drive, statusword by statusword.
#include <cstring>

#include "hal/canopen/drive_modes.hpp"
#include "hal/canopen/drive_power.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::canopen::cia402 {
namespace {

using std::chrono::milliseconds;

Time at(int ms) {
  return Time{std::chrono::seconds(1) + milliseconds(ms)};
}

void states_are_told_by_their_bits_alone(void**) {
  struct Case {
    std::uint16_t statusword;
    DriveState state;
  };
  const Case cases[] = {
      {0x0000, DriveState::not_ready},
      {0x0020, DriveState::not_ready},
      {0x0250, DriveState::switch_on_disabled},
      {0x0270, DriveState::switch_on_disabled},
      {0x0221, DriveState::ready_to_switch_on},
      {0x0233, DriveState::switched_on},
      {0x2700, DriveState::not_ready},
      {0x1637, DriveState::operation_enabled},
      {0x0027, DriveState::operation_enabled},
      {0x0217, DriveState::quick_stop_active},
      {0x021F, DriveState::fault_reaction},
      {0x023F, DriveState::fault_reaction},
      {0x0218, DriveState::fault},
      {0x0238, DriveState::fault},
      {0x0041, DriveState::unknown},
      {0x0003, DriveState::unknown},
  };
  for (const Case& each : cases) assert_true(state_of(each.statusword) == each.state);
  assert_true(has_torque(DriveState::unknown));
  assert_false(has_torque(DriveState::switched_on));
}

void each_state_is_left_by_its_command(void**) {
  DrivePower power;
  power.begin({});
  assert_int_equal(power.advance(0x0040, true, at(0)), 0x0000);
  assert_true(power.is_off());
  power.pursue(DrivePower::Goal::enabled);
  assert_int_equal(power.advance(0x0000, true, at(1)), 0x0000);
  assert_int_equal(power.advance(0x0240, true, at(2)), 0x0006);
  assert_int_equal(power.advance(0x0221, true, at(3)), 0x0007);
  assert_int_equal(power.advance(0x0233, true, at(4)), 0x000F);
  assert_false(power.is_enabled());
  assert_int_equal(power.advance(0x0237, true, at(5)), 0x000F);
  assert_true(power.is_enabled() && power.was_just_enabled());
  assert_int_equal(power.advance(0x0237, false, at(6)), 0x000F);
  assert_false(power.was_just_enabled());
  power.pursue(DrivePower::Goal::off);
  assert_int_equal(power.advance(0x0237, false, at(7)), 0x0002);
  assert_int_equal(power.advance(0x0217, false, at(8)), 0x0002);
  assert_false(power.is_off());
  assert_int_equal(power.advance(0x0217, true, at(9)), 0x0000);
  assert_int_equal(power.advance(0x0240, true, at(10)), 0x0000);
  assert_true(power.is_off());
}

void a_drive_found_enabled_is_off_only_when_it_was_seen_so(void**) {
  DrivePower power;
  power.begin({});
  assert_false(power.is_off());
  assert_int_equal(power.advance(0x0237, false, at(0)), 0x0002);
  assert_false(power.is_off());
}

void a_drive_found_in_quick_stop_goes_by_way_of_off(void**) {
  DrivePower power;
  power.begin({});
  power.pursue(DrivePower::Goal::enabled);
  assert_int_equal(power.advance(0x0217, true, at(0)), 0x0000);
  assert_int_equal(power.advance(0x0240, true, at(1)), 0x0006);
}

void each_hop_has_its_time(void**) {
  struct Case {
    std::uint16_t statusword;
    int limit;
    const char* words;
  };
  const Case cases[] = {
      {0x0000, 500, "not ready to switch on"}, {0x0240, 500, "switch on disabled"},
      {0x0221, 500, "ready to switch on"},     {0x0233, 1000, "switched on"},
      {0x021F, 5000, "fault reaction active"}, {0x0003, 500, "in no state of CiA 402"},
  };
  for (const Case& each : cases) {
    DrivePower power;
    power.begin({});
    power.advance(each.statusword, true, at(-100000));  // waiting for nothing takes no time
    power.pursue(DrivePower::Goal::enabled);
    power.advance(each.statusword, true, at(0));
    power.advance(each.statusword, true, at(each.limit));
    assert_true(power.problem().is_ok());
    assert_int_equal(power.advance(each.statusword, true, at(each.limit + 1)), 0x0000);
    assert_true(power.problem().code() == StatusCode::timeout);
    assert_non_null(std::strstr(power.problem().cause(), each.words));
  }
}

void a_drive_that_does_not_stop_loses_its_voltage(void**) {
  DrivePower power;
  power.begin({});
  power.pursue(DrivePower::Goal::enabled);
  power.advance(0x0237, false, at(0));
  power.pursue(DrivePower::Goal::off);
  assert_int_equal(power.advance(0x0237, false, at(1)), 0x0002);
  assert_int_equal(power.advance(0x0237, false, at(5001)), 0x0002);
  assert_int_equal(power.advance(0x0237, false, at(5002)), 0x0000);
  assert_non_null(std::strstr(power.problem().cause(), "on its way to off"));
}

void a_fault_is_reset_by_a_rising_bit(void**) {
  DrivePower power;
  power.begin({.fault_resets = 2});
  power.advance(0x0218, true, at(0));
  power.pursue(DrivePower::Goal::enabled);
  assert_int_equal(power.advance(0x0218, true, at(1)), 0x0000);
  assert_int_equal(power.advance(0x0218, true, at(2)), 0x0080);
  assert_int_equal(power.advance(0x0218, true, at(3)), 0x0080);
  assert_int_equal(power.advance(0x0218, true, at(503)), 0x0080);
  assert_int_equal(power.advance(0x0218, true, at(504)), 0x0000);
  assert_int_equal(power.advance(0x0218, true, at(505)), 0x0080);
  assert_int_equal(power.fault_resets(), 2);
  assert_int_equal(power.advance(0x0240, true, at(506)), 0x0006);
  assert_true(power.problem().is_ok());
}

void what_leaves_operation_by_itself_stops_and_stays_off(void**) {
  DrivePower power;
  power.begin({});
  power.pursue(DrivePower::Goal::enabled);
  power.advance(0x0237, false, at(0));
  assert_true(power.was_just_enabled());
  assert_int_equal(power.advance(0x0217, false, at(1)), 0x0002);
  assert_non_null(
      std::strstr(power.problem().cause(), "left its operation by itself: it is 'quick stop active'"));
  assert_int_equal(power.advance(0x0240, true, at(2)), 0x0000);
  assert_int_equal(power.advance(0x0237, true, at(3)), 0x0000);
  assert_false(power.is_enabled());
}

void what_was_told_to_go_off_goes_there_first(void**) {
  DrivePower power;
  power.begin({});
  power.pursue(DrivePower::Goal::enabled);
  power.advance(0x0237, false, at(0));
  power.pursue(DrivePower::Goal::off);
  assert_int_equal(power.advance(0x0237, false, at(7)), 0x0002);
  power.pursue(DrivePower::Goal::enabled);
  assert_int_equal(power.advance(0x0237, false, at(14)), 0x0002);  // as before it heard of it
  assert_false(power.is_enabled() || power.was_just_enabled());
  assert_int_equal(power.advance(0x0217, false, at(21)), 0x0002);
  assert_int_equal(power.advance(0x0217, true, at(28)), 0x0000);
  assert_int_equal(power.advance(0x0240, true, at(35)), 0x0006);
  assert_int_equal(power.advance(0x0221, true, at(42)), 0x0007);
  assert_int_equal(power.advance(0x0233, true, at(49)), 0x000F);
  power.pursue(DrivePower::Goal::off);
  assert_int_equal(power.advance(0x0233, true, at(56)), 0x0000);
  power.pursue(DrivePower::Goal::enabled);
  assert_int_equal(power.advance(0x0237, true, at(63)), 0x0002);  // it was enabled, and will be off
  assert_false(power.is_enabled());
  assert_int_equal(power.advance(0x0240, true, at(70)), 0x0006);
  assert_true(power.problem().is_ok());
}

void a_set_point_is_offered_once_and_the_newest_counts(void**) {
  SetPointHandshake handshake(milliseconds(100));
  handshake.command(1, 5);
  handshake.command(2, 5);
  assert_false(handshake.is_reached(0x0400));
  // The target goes a cycle ahead of the bit that makes it count.
  assert_int_equal(handshake.advance(0x0400, at(0)), 0x0020);
  assert_int_equal(handshake.target(), 2);
  assert_int_equal(handshake.advance(0x0400, at(0)), 0x0030);
  assert_int_equal(handshake.target(), 2);
  assert_false(handshake.is_reached(0x0400));  // of the one before
  handshake.command(3, 5);
  assert_int_equal(handshake.advance(0x0000, at(1)), 0x0030);
  assert_int_equal(handshake.target(), 2);
  assert_int_equal(handshake.advance(0x1000, at(2)), 0x0020);
  assert_int_equal(handshake.advance(0x1000, at(3)), 0x0020);
  assert_int_equal(handshake.advance(0x0000, at(4)), 0x0020);
  assert_int_equal(handshake.target(), 3);
  assert_int_equal(handshake.advance(0x0000, at(4)), 0x0030);
  handshake.advance(0x0000, at(104));
  assert_true(handshake.problem().is_ok());
  handshake.advance(0x0000, at(105));
  assert_non_null(std::strstr(handshake.problem().cause(), "does not acknowledge"));
  handshake.reset(7);
  assert_true(handshake.problem().is_ok());
  assert_int_equal(handshake.target(), 7);
  assert_int_equal(handshake.advance(0x0000, at(106)), 0x0020);
}

void what_homing_said_before_does_not_count(void**) {
  HomingRun homing(milliseconds(1000), milliseconds(50), true);
  assert_int_equal(homing.advance(0x1400, true, true, at(0)), 0);
  homing.start();
  assert_int_equal(homing.advance(0x1400, true, true, at(0)), 0x0000);
  assert_int_equal(homing.advance(0x1400, true, true, at(7)), 0x0010);
  assert_int_equal(homing.advance(0x0000, true, true, at(14)),
                   0x0010);  // not of the start: it comes too soon
  assert_int_equal(homing.advance(0x1400, true, true, at(21)), 0x0010);
  assert_int_equal(homing.advance(0x1400, true, true, at(28)), 0x0010);
  assert_int_equal(homing.advance(0x0000, true, true, at(35)), 0x0010);
  assert_int_equal(homing.advance(0x1000, true, true, at(42)), 0x0010);  // attained, and still moving
  assert_int_equal(homing.advance(0x1400, true, true, at(49)), 0x0000);
  assert_true(homing.state() == HomingRun::State::done);
}

void homing_goes_by_what_is_heard(void**) {
  HomingRun homing(milliseconds(1000), milliseconds(50), true);
  homing.start();
  homing.advance(0x1400, true, true, at(0));
  // For longer than it may take to settle nothing comes, and what came last is of the run before.
  for (int ms = 7; ms <= 140; ms += 7) assert_int_equal(homing.advance(0x1400, false, true, at(ms)), 0x0010);
  // One that need not move says at once that it is there, and has to go on saying so.
  for (int ms = 147; ms <= 197; ms += 7) assert_int_equal(homing.advance(0x1400, true, true, at(ms)), 0x0010);
  assert_int_equal(homing.advance(0x1400, true, true, at(204)), 0x0000);
  assert_true(homing.state() == HomingRun::State::done);
}

// A drive that leaves bit 10: its home is found when it says so, and stands.
void homing_goes_by_bit_12_and_rest_where_that_is_said(void**) {
  HomingRun homing(milliseconds(1000), milliseconds(50), false);
  homing.start();
  homing.advance(0x0000, true, true, at(0));
  homing.advance(0x0000, true, true, at(7));
  for (int ms = 14; ms <= 70; ms += 7) assert_int_equal(homing.advance(0x0000, true, false, at(ms)), 0x0010);
  assert_int_equal(homing.advance(0x1000, true, false, at(77)), 0x0010);  // it moves on
  assert_int_equal(homing.advance(0x1000, true, true, at(84)), 0x0000);
  assert_true(homing.state() == HomingRun::State::done);
  HomingRun unsaid(milliseconds(1000), milliseconds(50), true);
  unsaid.start();
  for (int ms = 0; ms <= 1008; ms += 7) unsaid.advance(ms < 70 ? 0x0000 : 0x1000, true, true, at(ms));
  assert_true(unsaid.problem().code() == StatusCode::timeout);
  assert_non_null(std::strstr(unsaid.problem().cause(), "`homing_tells_reached = false`"));
}

void homing_that_fails_says_why(void**) {
  HomingRun homing(milliseconds(1000), milliseconds(50), true);
  homing.start();
  for (int ms = 0; ms < 5; ++ms) homing.advance(0x0000, true, true, at(ms));
  homing.advance(0x2400, true, true, at(5));
  assert_true(homing.state() == HomingRun::State::failed);
  assert_non_null(std::strstr(homing.problem().cause(), "could not home"));
  homing.start();
  homing.advance(0x0000, true, true, at(6));
  homing.advance(0x0000, true, true, at(7));
  homing.advance(0x0000, true, true, at(1007));
  assert_true(homing.problem().code() == StatusCode::timeout);
  homing.start();
  homing.interrupt();
  assert_true(homing.problem().code() == StatusCode::unavailable);
}

}  // namespace
}  // namespace flexrf::canopen::cia402

int main() {
  using namespace flexrf::canopen::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(states_are_told_by_their_bits_alone),
      cmocka_unit_test(each_state_is_left_by_its_command),
      cmocka_unit_test(a_drive_found_enabled_is_off_only_when_it_was_seen_so),
      cmocka_unit_test(a_drive_found_in_quick_stop_goes_by_way_of_off),
      cmocka_unit_test(each_hop_has_its_time),
      cmocka_unit_test(a_drive_that_does_not_stop_loses_its_voltage),
      cmocka_unit_test(a_fault_is_reset_by_a_rising_bit),
      cmocka_unit_test(what_leaves_operation_by_itself_stops_and_stays_off),
      cmocka_unit_test(what_was_told_to_go_off_goes_there_first),
      cmocka_unit_test(a_set_point_is_offered_once_and_the_newest_counts),
      cmocka_unit_test(what_homing_said_before_does_not_count),
      cmocka_unit_test(homing_goes_by_what_is_heard),
      cmocka_unit_test(homing_goes_by_bit_12_and_rest_where_that_is_said),
      cmocka_unit_test(homing_that_fails_says_why),
  };
  return cmocka_run_group_tests_name("cia402 power", tests, nullptr, nullptr);
}
