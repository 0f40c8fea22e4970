// The state machine of a CiA 402 drive led by its master, against the simulated drive.
#include <cstring>

#include "hal/servo_drive/canopen/simulator/tests/drive_axis.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using canopen::cia402::DriveState;
namespace axis = canopen::cia402::objects;

bool says(const Status& status, const char* words) {
  return std::strstr(status.cause(), words) != nullptr;
}

void a_drive_is_enabled_where_it_is(void**) {
  Axis one;
  assert_true(one.came_up);
  assert_true(one.power.state() == DriveState::switch_on_disabled);
  assert_true(one.power.is_off());
  assert_true(one.enable());
  one.run(500);
  assert_true(one.bench.drive.state() == DriveState::operation_enabled);
  assert_true(one.actual() == 1000);
  assert_true(one.bench.drive.longest_jump() == 0);
}

void a_quick_stop_ends_in_off_and_the_next_enabling_is_seeded(void**) {
  Axis one;
  assert_true(one.enable());
  one.cyclic.command(200000);
  one.run(500);
  assert_true(one.switch_off());
  assert_true(one.power.problem().is_ok());
  const double rest = one.actual();
  assert_true(rest > 1000 && rest < 20000);
  one.run(200);
  assert_true(one.actual() == rest);
  assert_true(one.enable());
  one.run(500);
  assert_true(one.actual() == std::round(rest));
  assert_true(one.bench.drive.longest_jump() <= fastest * 0.007 * 2);
}

void a_drive_that_stays_in_its_quick_stop_is_switched_off_at_rest(void**) {
  Axis one;
  one.bench.drive.objects().set(axis::quick_stop_option, 6);
  assert_true(one.enable());
  one.cyclic.command(200000);
  one.run(300);
  assert_true(one.switch_off());
  assert_true(one.bench.drive.state() == DriveState::switch_on_disabled);
  assert_true(one.bench.drive.motion().is_at_rest());
}

void a_drive_that_is_stuck_is_named_with_its_state(void**) {
  Axis one;
  one.bench.drive.stick_in(DriveState::switched_on);
  assert_false(one.enable());
  assert_true(one.power.problem().code() == StatusCode::timeout);
  assert_true(says(one.power.problem(), "stays 'switched on' for more than 1000 ms"));
  one.run(50);
  assert_int_equal(one.bench.drive.objects().get(axis::controlword), 0);
  one.bench.drive.stick_in(std::nullopt);
  assert_true(one.switch_off());
  assert_true(one.enable());
}

void a_fault_in_motion_is_told_and_reset_at_the_next_enabling(void**) {
  Axis one;
  assert_true(one.enable());
  one.cyclic.command(200000);
  one.run(300);
  one.bench.drive.trip(0x2310, false, one.bench.said_by_hand);
  one.run(300);
  assert_true(one.power.problem().code() == StatusCode::device_fault);
  assert_true(says(one.power.problem(), "in fault"));
  assert_int_equal(one.bench.node.emergency()->code, 0x2310);
  // Nothing moves it again by itself.
  one.run(2000);
  assert_true(one.bench.drive.state() == DriveState::fault);
  one.power.pursue(DrivePower::Goal::off);
  assert_true(one.enable());
  assert_int_equal(one.power.fault_resets(), 1);
  const double rest = one.actual();
  one.run(300);
  assert_true(std::abs(one.actual() - rest) < 1);
}

void a_fault_whose_cause_persists_is_reset_three_times_only(void**) {
  Axis one;
  one.bench.drive.trip(0x3210, true, one.bench.said_by_hand);
  one.run(100);
  assert_false(one.enable());
  one.run(5000);
  assert_int_equal(one.power.fault_resets(), 3);
  assert_true(says(one.power.problem(), "still in fault after 3 resets"));
  one.bench.drive.heal();
  one.run(2000);
  assert_true(one.bench.drive.state() == DriveState::fault);
  one.power.pursue(DrivePower::Goal::off);
  assert_true(one.enable());
}

void a_drive_that_drops_out_is_not_enabled_again_by_itself(void**) {
  Axis one;
  assert_true(one.enable());
  one.bench.send(canopen::nmt_message(canopen::NmtCommand::reset_node, drive_node));
  one.run(1000);
  assert_true(one.bench.node.is_operational());
  assert_true(says(one.power.problem(), "left its operation by itself"));
  assert_true(one.power.is_off());
  assert_int_equal(one.bench.node.resets(), 1);
}

void a_drive_that_no_longer_hears_us_stops_by_itself(void**) {
  Axis one;
  assert_true(one.enable());
  one.cyclic.command(200000);
  one.run(300);
  one.bench.we_beat = false;
  one.run(600);
  assert_true(one.bench.drive.motion().is_at_rest());
  assert_true(one.bench.drive.state() == DriveState::switch_on_disabled);
  assert_int_equal(one.bench.node.emergency()->code, 0x8130);
  assert_true(says(one.power.problem(), "left its operation by itself"));
}

void a_following_error_is_a_fault_with_its_code(void**) {
  Axis one;
  assert_true(one.enable());
  one.bench.drive.objects().set(axis::following_window, 20);
  one.cyclic = SetPointFollower{{.velocity = 1e6, .acceleration = 1e9}};  // faster than the motor
  one.cyclic.seed(one.position);
  one.cyclic.command(200000);
  one.run(300);
  assert_int_equal(one.bench.node.emergency()->code, 0x8611);
  assert_true(one.power.problem().code() == StatusCode::device_fault);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_drive_is_enabled_where_it_is),
      cmocka_unit_test(a_quick_stop_ends_in_off_and_the_next_enabling_is_seeded),
      cmocka_unit_test(a_drive_that_stays_in_its_quick_stop_is_switched_off_at_rest),
      cmocka_unit_test(a_drive_that_is_stuck_is_named_with_its_state),
      cmocka_unit_test(a_fault_in_motion_is_told_and_reset_at_the_next_enabling),
      cmocka_unit_test(a_fault_whose_cause_persists_is_reset_three_times_only),
      cmocka_unit_test(a_drive_that_drops_out_is_not_enabled_again_by_itself),
      cmocka_unit_test(a_drive_that_no_longer_hears_us_stops_by_itself),
      cmocka_unit_test(a_following_error_is_a_fault_with_its_code),
  };
  return cmocka_run_group_tests_name("cia402 drive", tests, nullptr, nullptr);
}
