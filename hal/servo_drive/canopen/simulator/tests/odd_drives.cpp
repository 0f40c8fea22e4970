#include "hal/servo_drive/canopen/simulator/tests/odd_drives.hpp"

#include "hal/canopen/sdo_abort.hpp"
#include "hal/servo_drive/canopen/simulator/tests/axis_cell.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using canopen::cia402::Homing;
namespace objects_402 = canopen::cia402::objects;

AxisPlan plan_with_home() {
  AxisPlan result = plan();
  result.homing_method = 33;
  result.homing_speed = 2;
  return result;
}

void permission_withdrawn_and_given_again_is_no_fault(void**) {
  for (int cycles = 1; cycles <= 5; ++cycles) {
    Cell cell;
    assert_true(cell.run_until_enabled());
    cell.position = 5;
    cell.run(200);
    cell.may_move = false;
    cell.run(7 * cycles);
    cell.may_move = true;
    cell.run(2500);
    assert_true(cell.axis.fault().is_ok());
    assert_true(cell.axis.is_enabled());
    assert_true(cell.is_at(5));
    assert_true(cell.drive.longest_jump() <= 20000 * 0.007 * 2);
  }
}

void permission_that_comes_and_goes_while_it_is_enabled_is_no_fault(void**) {
  for (int first = 1; first <= 12; ++first) {
    Cell cell;
    cell.run(1000);
    cell.may_move = true;
    cell.run(7 * first);
    cell.may_move = false;
    cell.run(7);
    assert_true(cell.run_until_enabled());
    cell.run(100);
    assert_true(cell.axis.fault().is_ok() && cell.axis.is_enabled());
  }
}

// The drive says "attained" of the run before, and cannot have heard of the second start.
void a_second_homing_is_not_the_first_one(void**) {
  for (const int lost_cycles : {0, 3, 6, 8, 9}) {
    Cell cell(plan_with_home());
    assert_true(cell.run_until_enabled());
    cell.axis.home();
    cell.run(2500);
    assert_true(cell.axis.homing() == Homing::homed && cell.is_at(0));
    cell.position = 5;
    cell.run(2000);
    assert_true(cell.is_at(5));
    cell.position = std::nullopt;
    cell.axis.home();
    for (int i = 0; i < 100 && cell.drive.objects().get_signed(objects_402::mode_display) != 6; ++i)
      cell.step();
    cell.step();
    cell.cable = false;
    cell.run(7 * lost_cycles);
    cell.cable = true;
    for (int i = 0; i < 1000 && cell.axis.homing() == Homing::running; ++i) cell.step();
    assert_true(cell.axis.homing() == Homing::homed);
    assert_true(std::abs(cell.drive.motion().position()) < 1);
  }
}

/// In full motion, with a velocity mode: what a drive does next is seen in where it goes.
struct RunningCell : Cell {
  static AxisPlan by_velocity() {
    AxisPlan result = plan();
    result.mode = Mode::cyclic_velocity;
    result.endless = true;
    result.quick_stop_deceleration = 10;
    return result;
  }
  RunningCell() : Cell(by_velocity()) {
    assert_true(run_until_enabled());
    velocity = 4;
    run(700);
    assert_false(drive.motion().is_at_rest());
  }
  // Never said to be off while it moves, and never without torque in full motion.
  void run_watched(int ms) {
    for (int i = 0; i < ms; i += 7) {
      const double before = std::abs(drive.motion().velocity());
      step();
      assert_false(axis.is_off() && !drive.motion().is_at_rest());
      assert_false(drive.state() == DriveState::switch_on_disabled && before > 1000);
    }
  }
};

/// It goes on with everything else, and does not heed NMT commands either.
void a_drive_whose_heartbeat_alone_is_lost_is_stopped(void**) {
  RunningCell cell;
  cell.drive.silence_heartbeat(true);
  cell.lost = 0;  // NMT
  cell.run_watched(3000);
  assert_true(cell.fault_says("no heartbeat of node 5"));
  assert_true(cell.drive.motion().is_at_rest());
  assert_true(cell.axis.is_off());
}

void a_drive_that_no_longer_tells_its_velocity_is_not_off_in_motion(void**) {
  RunningCell cell;
  cell.lost = canopen::transmit_pdo_identifier(2, node);
  cell.run_watched(140);
  cell.may_move = false;
  cell.run_watched(3000);
  assert_true(cell.drive.motion().is_at_rest() && cell.axis.is_off());
  assert_true(cell.axis.fault().is_ok());
}

void a_drive_that_is_not_heard_is_not_off(void**) {
  RunningCell cell;
  cell.cable = false;
  for (int i = 0; i < 500; ++i) {
    cell.step();
    assert_false(cell.axis.is_off());
  }
  cell.cable = true;
  cell.run_watched(3000);
  assert_true(cell.axis.is_off());
}

/// A statusword from before the drive was enabled does not say that it is off.
void a_drive_enabled_for_a_cycle_is_not_off_by_what_it_said_before(void**) {
  Cell cell;
  cell.run(1000);
  assert_true(cell.axis.is_off());
  cell.lost = canopen::transmit_pdo_identifier(1, node);
  cell.may_move = true;
  cell.step();
  cell.may_move = false;
  cell.step();
  cell.lost.reset();
  cell.step();
  assert_false(cell.axis.is_off());
  cell.run(500);
  assert_true(cell.axis.is_off() && cell.axis.fault().is_ok());
}

AxisPlan guarded_plan() {
  AxisPlan result = plan();
  result.is_guarded = true;
  result.is_supervised_by_it = false;
  return result;
}

struct GuardedCell : Cell {
  explicit GuardedCell(const AxisPlan& with = guarded_plan()) : Cell(with) {
    drive.objects().lack(canopen::objects::producer_heartbeat);
    drive.objects().lack(canopen::objects::consumer_heartbeat);
  }
};

void a_drive_without_a_heartbeat_is_guarded(void**) {
  GuardedCell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 5;
  cell.run(10000);
  assert_true(cell.is_at(5));
  assert_true(cell.axis.node().silences() == 0 && cell.axis.node().times_operational() == 1);
  assert_int_equal(cell.drive.objects().get(canopen::objects::guard_time), 100);
  assert_int_equal(cell.drive.objects().get(canopen::objects::life_time_factor), 3);
}

void a_drive_without_a_heartbeat_needs_the_column(void**) {
  GuardedCell cell(plan());
  assert_false(cell.run_until_enabled());
  assert_true(cell.fault_says("1017:00 of node 5 was aborted"));
}

void a_guarded_drive_that_no_longer_answers_is_a_fault(void**) {
  GuardedCell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 9;
  cell.run(100);
  cell.drive.silence_heartbeat(true);
  cell.run(500);
  assert_true(cell.fault_says("no answer to guarding of node 5 for 250 ms"));
  assert_true(cell.drive.state() == DriveState::switch_on_disabled && cell.drive.motion().is_at_rest());
  cell.drive.silence_heartbeat(false);
  cell.run(2000);
  assert_true(cell.axis.is_off());
  cell.may_move = false;
  cell.began = cell.axis.begin(guarded_plan(), cell.now, cell.said);
  cell.run(1000);
  cell.position = std::nullopt;
  assert_true(cell.run_until_enabled());
}

void answers_that_repeat_their_toggle_bit_count_as_none(void**) {
  GuardedCell cell;
  assert_true(cell.run_until_enabled());
  cell.drive.silence_heartbeat(true);
  for (int i = 0; i < 100; ++i) {
    cell.heard.push(canopen::guard_answer(canopen::NmtState::operational, false, node));
    cell.step();
  }
  assert_true(cell.fault_says("no answer to guarding of node 5 for 250 ms"));
}

void a_guarded_drive_that_nobody_asks_stops(void**) {
  GuardedCell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 9;
  cell.run(100);
  cell.cable = false;
  cell.run(700);
  assert_true(cell.drive.state() == DriveState::switch_on_disabled && cell.drive.motion().is_at_rest());
  assert_false(cell.axis.fault().is_ok());
}

struct UnmappedCell : Cell {
  explicit UnmappedCell(const AxisPlan& with) : Cell(with) {
    drive.objects().unmap(objects_402::mode);
    drive.objects().unmap(objects_402::mode_display);
  }
};

void a_mode_that_is_in_no_pdo_is_told_by_sdo(void**) {
  for (const Mode mode : {Mode::cyclic_position, Mode::cyclic_velocity, Mode::profile_position}) {
    AxisPlan with = plan_with_home();
    with.mode = mode;
    with.maps_mode = false;
    UnmappedCell cell(with);
    assert_true(cell.run_until_enabled());
    assert_int_equal(cell.drive.objects().get_signed(objects_402::mode_display), static_cast<int>(mode));
    cell.axis.home();
    cell.run(2500);
    assert_true(cell.axis.homing() == Homing::homed && cell.axis.fault().is_ok());
    assert_int_equal(cell.drive.objects().get_signed(objects_402::mode_display), static_cast<int>(mode));
    cell.drive.reset_itself(cell.now);
    cell.run(2000);
    cell.may_move = false;
    cell.began = cell.axis.begin(with, cell.now, cell.said);
    cell.run(1000);
    assert_true(cell.run_until_enabled());
  }
}

void a_mode_that_is_in_no_pdo_needs_the_column(void**) {
  UnmappedCell cell(plan());
  assert_false(cell.run_until_enabled());
  assert_true(cell.fault_says("1600:03 of node 5 was aborted"));
}

void a_mode_that_is_refused_by_sdo_is_told(void**) {
  AxisPlan with = plan();
  with.maps_mode = false;
  UnmappedCell cell(with);
  cell.drive.objects().refuse(objects_402::mode, canopen::sdo_abort::out_of_range);
  assert_false(cell.run_until_enabled());
  assert_true(cell.fault_says("6060:00 of node 5 was aborted"));
}

void a_homing_whose_mode_is_refused_by_sdo_fails_alone(void**) {
  AxisPlan with = plan_with_home();
  with.maps_mode = false;
  UnmappedCell cell(with);
  assert_true(cell.run_until_enabled());
  cell.drive.objects().refuse(objects_402::mode, canopen::sdo_abort::out_of_range);
  cell.axis.home();
  cell.run(2000);
  assert_true(cell.axis.homing() == Homing::failed);
  assert_true(cell.axis.fault().is_ok() && cell.axis.is_enabled());
}

}  // namespace

int run_odd_drives() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_drive_whose_heartbeat_alone_is_lost_is_stopped),
      cmocka_unit_test(a_drive_that_no_longer_tells_its_velocity_is_not_off_in_motion),
      cmocka_unit_test(a_drive_that_is_not_heard_is_not_off),
      cmocka_unit_test(a_drive_enabled_for_a_cycle_is_not_off_by_what_it_said_before),
      cmocka_unit_test(permission_withdrawn_and_given_again_is_no_fault),
      cmocka_unit_test(permission_that_comes_and_goes_while_it_is_enabled_is_no_fault),
      cmocka_unit_test(a_second_homing_is_not_the_first_one),
      cmocka_unit_test(a_drive_without_a_heartbeat_is_guarded),
      cmocka_unit_test(a_drive_without_a_heartbeat_needs_the_column),
      cmocka_unit_test(a_guarded_drive_that_no_longer_answers_is_a_fault),
      cmocka_unit_test(answers_that_repeat_their_toggle_bit_count_as_none),
      cmocka_unit_test(a_guarded_drive_that_nobody_asks_stops),
      cmocka_unit_test(a_mode_that_is_in_no_pdo_is_told_by_sdo),
      cmocka_unit_test(a_mode_that_is_in_no_pdo_needs_the_column),
      cmocka_unit_test(a_mode_that_is_refused_by_sdo_is_told),
      cmocka_unit_test(a_homing_whose_mode_is_refused_by_sdo_fails_alone),
  };
  return cmocka_run_group_tests_name("odd drives", tests, nullptr, nullptr);
}

}  // namespace flexrf
