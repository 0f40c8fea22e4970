// What an axis is told when the process that leads it dies: its bytes, and what a drive makes of them.
#include "hal/servo_drive/canopen/simulator/tests/axis_cell.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

const Message sync{canopen::sync_identifier, 0, {}};

AxisPlan plan_with(Mode mode, std::int16_t abort_connection = 3) {
  AxisPlan result = plan();
  result.mode = mode;
  result.abort_connection = abort_connection;
  // Nothing in the drive stops it: what does is what is told.
  result.is_supervised_by_it = false;
  return result;
}

/// In motion, in the midst of its way.
bool is_moving(Cell& cell) {
  if (!cell.run_until_enabled()) return false;
  cell.position = 9;
  cell.velocity = 4;
  cell.run(200);
  return cell.drive.state() == DriveState::operation_enabled && !cell.drive.motion().is_at_rest();
}

/// Nobody leads the drive any more.
void leave_alone(Cell& cell, int ms) {
  for (int i = 0; i < ms; ++i) {
    cell.now += milliseconds(1);
    cell.drive.advance(cell.now, cell.heard);
    cell.heard.clear();
  }
}

void its_bytes_are_the_last_process_data_with_quick_stop(void**) {
  Cell cell(plan_with(Mode::cyclic_position));
  assert_false(cell.axis.last_word().has_value());
  assert_true(is_moving(cell));
  Message told{};
  for (; !cell.said.is_empty(); cell.said.pop()) {
    if (cell.said.front().identifier == 0x205) told = cell.said.front();
  }
  const auto word = cell.axis.last_word();
  assert_true(word.has_value());
  assert_int_equal(word->identifier, 0x205);
  assert_int_equal(word->size, 7);
  assert_int_equal(canopen::read_number(told.data.data(), 2), 0x000F);
  assert_int_equal(canopen::read_number(word->data.data(), 2), 0x0002);
  const std::size_t rest = 2;
  assert_memory_equal(word->data.data() + rest, told.data.data() + rest, told.size - rest);
  // The set-point on the way to 9 units, of -1000 increments each, in mode 8.
  const auto target = canopen::with_sign(canopen::read_number(word->data.data() + 2, 4), 32);
  assert_true(target < 1000 && target > -9000);
  assert_int_equal(word->data[6], 8);
}

// [stop-24]
void it_stops_what_moves_in_each_mode(void**) {
  for (const Mode mode : {Mode::cyclic_position, Mode::cyclic_velocity, Mode::profile_velocity}) {
    Cell cell(plan_with(mode));
    assert_true(is_moving(cell));
    cell.drive.receive(*cell.axis.last_word(), cell.now, cell.heard);
    cell.drive.receive(sync, cell.now, cell.heard);
    assert_true(cell.drive.state() == DriveState::quick_stop_active);
    leave_alone(cell, 200);
    assert_true(cell.drive.motion().is_at_rest());
    assert_true(cell.drive.state() == DriveState::switch_on_disabled);
  }
}

void without_sync_behind_it_nothing_stops(void**) {
  Cell cell(plan_with(Mode::profile_velocity));
  assert_true(is_moving(cell));
  cell.drive.receive(sync, cell.now, cell.heard);
  cell.drive.receive(*cell.axis.last_word(), cell.now, cell.heard);
  leave_alone(cell, 1000);
  assert_true(cell.drive.state() == DriveState::operation_enabled);
  assert_false(cell.drive.motion().is_at_rest());
  cell.drive.receive(sync, cell.now, cell.heard);
  assert_true(cell.drive.state() == DriveState::quick_stop_active);
}

void it_says_what_a_lost_heartbeat_would(void**) {
  Cell off(plan_with(Mode::cyclic_position, 2));
  assert_true(is_moving(off));
  assert_int_equal(canopen::read_number(off.axis.last_word()->data.data(), 2), 0x0000);
  off.drive.receive(*off.axis.last_word(), off.now, off.heard);
  off.drive.receive(sync, off.now, off.heard);
  assert_true(off.drive.state() == DriveState::switch_on_disabled);
  Cell fault(plan_with(Mode::cyclic_position, 1));
  assert_true(is_moving(fault));
  assert_int_equal(canopen::read_number(fault.axis.last_word()->data.data(), 2), 0x0002);
  Cell goes_on(plan_with(Mode::cyclic_position, 0));
  assert_true(is_moving(goes_on));
  assert_false(goes_on.axis.last_word().has_value());
}

void what_is_off_or_in_fault_stays_so(void**) {
  Cell cell(plan_with(Mode::cyclic_position));
  cell.run(1000);
  assert_true(cell.drive.state() == DriveState::switch_on_disabled);
  cell.drive.receive(*cell.axis.last_word(), cell.now, cell.heard);
  cell.drive.receive(sync, cell.now, cell.heard);
  assert_true(cell.drive.state() == DriveState::switch_on_disabled);
  assert_true(is_moving(cell));
  cell.drive.trip(0x2310, false, cell.heard);
  cell.run(500);
  assert_true(cell.drive.state() == DriveState::fault);
  cell.drive.receive(*cell.axis.last_word(), cell.now, cell.heard);
  cell.drive.receive(sync, cell.now, cell.heard);
  assert_true(cell.drive.state() == DriveState::fault);
}

void of_a_drive_that_is_not_heard_nothing_new_is_known(void**) {
  Cell cell(plan_with(Mode::cyclic_position));
  assert_true(is_moving(cell));
  cell.cable = false;
  cell.run(1000);
  assert_false(cell.axis.last_word().has_value());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(its_bytes_are_the_last_process_data_with_quick_stop),
      cmocka_unit_test(it_stops_what_moves_in_each_mode),
      cmocka_unit_test(without_sync_behind_it_nothing_stops),
      cmocka_unit_test(it_says_what_a_lost_heartbeat_would),
      cmocka_unit_test(what_is_off_or_in_fault_stays_so),
      cmocka_unit_test(of_a_drive_that_is_not_heard_nothing_new_is_known),
  };
  return cmocka_run_group_tests_name("last word of a cia402 axis", tests, nullptr, nullptr);
}
