// An axis as a driver uses it, against the simulated drive: what it follows, what it does not, and each
// fault.
#include <cstring>
#include <limits>

#include "hal/servo_drive/canopen/simulator/tests/axis_cell.hpp"
#include "hal/servo_drive/canopen/simulator/tests/odd_drives.hpp"
#include "hal/servo_drive/interface/servo_restraints.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

void an_axis_that_may_not_move_is_read_and_off(void**) {
  Cell cell;
  assert_true(cell.began.is_ok());
  cell.position = 3;
  cell.run(1000);
  assert_true(cell.axis.node().is_operational());
  assert_true(cell.is_at(-1));
  assert_false(cell.axis.state()->enabled);
  assert_true(cell.axis.is_off());
  assert_true(cell.drive.state() == DriveState::switch_on_disabled);
  assert_true(cell.axis.fault().is_ok());
}

void an_enabled_axis_stays_where_it_is_and_follows(void**) {
  Cell cell;
  cell.run(1000);
  cell.position = std::nullopt;
  assert_true(cell.run_until_enabled());
  cell.run(300);
  assert_true(cell.is_at(-1));
  assert_true(cell.drive.longest_jump() == 0);
  cell.position = 5;
  cell.run(2000);
  assert_true(cell.is_at(5));
  assert_true(cell.drive.motion().position() == -5000);
  assert_true(std::abs(cell.axis.state()->following_error) <= resolution);
  assert_true(cell.drive.longest_jump() <= 20000 * 0.007 * 2);
}

void it_keeps_to_its_range(void**) {
  Cell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 1e9;
  cell.run(2500);
  assert_true(cell.is_at(10));
  assert_true(cell.axis.fault().is_ok());
}

void without_permission_it_stops_and_forgets(void**) {
  Cell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 9;
  cell.run(200);
  cell.may_move = false;
  cell.run(500);
  assert_true(cell.axis.is_off());
  assert_true(cell.drive.state() == DriveState::switch_on_disabled);
  const double rest = cell.axis.state()->position;
  assert_true(rest > -1 && rest < 9);
  cell.position = std::nullopt;
  assert_true(cell.run_until_enabled());
  cell.run(500);
  assert_true(cell.is_at(rest));
  assert_true(cell.axis.fault().is_ok());
}

void what_is_no_number_is_a_fault_and_never_followed(void**) {
  for (const double nonsense :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Cell cell;
    assert_true(cell.run_until_enabled());
    cell.position = nonsense;
    cell.run(300);
    assert_true(cell.axis.fault().code() == StatusCode::invalid_argument);
    assert_true(cell.is_at(-1));
    assert_true(cell.axis.is_off());
  }
}

void velocities_are_followed_up_to_the_range(void**) {
  AxisPlan with = plan();
  with.mode = Mode::cyclic_velocity;
  Cell cell(with);
  assert_true(cell.run_until_enabled());
  cell.velocity = 4;
  cell.run(500);
  assert_true(std::abs(cell.axis.state()->velocity - 4) <= resolution);
  cell.run(4000);
  assert_true(cell.axis.state()->velocity == 0);
  assert_true(std::abs(cell.axis.state()->position - 10) <= 2 * resolution);
  cell.velocity = -4;
  cell.run(500);
  assert_true(cell.axis.state()->position < 9.5);
  cell.velocity = 0;
  cell.run(500);
  assert_true(cell.axis.state()->velocity == 0);
}

/// However a drive acts, on each object as it is written or when a PDO is taken as a whole: it is never told
/// to go to where it was sent before, nor as fast as before.
void a_set_point_counts_only_with_its_target_and_its_speed(void**) {
  for (const bool on_each_object : {false, true}) {
    AxisPlan with = plan();
    with.mode = Mode::profile_position;
    Cell cell(with, {.node = node, .acts_on_each_object = on_each_object});
    assert_true(cell.run_until_enabled());
    struct Leg {
      double position;
      double speed;
    };
    double before = cell.axis.state()->position;
    for (const Leg& leg : {Leg{5, 4}, Leg{-3, 15}, Leg{2, 1.5}}) {
      const std::uint64_t set_points = cell.drive.set_points();
      cell.axis.move_to(leg.position, leg.speed);
      const double from = before;
      const double direction = leg.position > from ? 1 : -1;
      bool reached = false;
      for (int i = 0; i < 2000 && !reached; ++i) {
        cell.step();
        assert_true(cell.axis.fault().is_ok());
        const double now = cell.axis.state()->position;
        // Never away from its target, and never "reached" anywhere else.
        assert_true((now - before) * direction >= -resolution);
        reached = cell.axis.state()->target_reached;
        if (reached) assert_true(cell.is_at(leg.position));
        before = now;
      }
      assert_true(reached);
      assert_int_equal(cell.drive.set_points() - set_points, 1);
      assert_true(std::abs(cell.drive.set_point() + leg.position * 1000) < 1);
      assert_true(std::abs(cell.drive.set_point_speed() - leg.speed * 1000) <= 1);
    }
  }
}

/// Its PDOs no longer go in either direction, with its heartbeat or without: it is stopped by SDO, and is off
/// only when it has said so.
void a_drive_without_process_data_is_stopped_by_sdo(void**) {
  constexpr std::uint64_t not_in_use = 0x80000000;
  for (const bool beats : {true, false}) {
    AxisPlan with = plan();
    with.mode = Mode::cyclic_velocity;
    Cell cell(with);
    assert_true(cell.run_until_enabled());
    cell.velocity = 2;
    cell.run(500);
    constexpr std::uint16_t pdos[] = {0x1400, 0x1401, 0x1800, 0x1801};
    for (const std::uint16_t index : pdos) {
      cell.drive.objects().set({index, 1}, not_in_use);
    }
    cell.drive.silence_heartbeat(!beats);
    cell.run(50);
    assert_false(cell.axis.is_off());
    bool was_off = false;
    for (int i = 0; i < 1000 && !was_off; i += 7) {
      cell.step();
      was_off = cell.axis.is_off();
    }
    assert_true(was_off);
    assert_true(cell.drive.state() == DriveState::switch_on_disabled);
    assert_true(cell.drive.motion().velocity() == 0);
  }
}

/// A truncated PDO tells no position, and is no measurement.
void a_position_is_as_old_as_the_last_whole_pdo(void**) {
  Cell cell;
  assert_true(cell.run_until_enabled());
  const Time before = cell.axis.heard_at();
  cell.axis.receive({canopen::transmit_pdo_identifier(1, node), 1, {}}, before + milliseconds(3), cell.said);
  assert_true(cell.axis.heard_at() == before);
  cell.step();
  assert_true(cell.axis.heard_at() > before);
}

/// What it does less than it was told, it says, in each cycle in which that is so.
void what_is_held_back_is_said(void**) {
  const auto says = [](Cell& cell, const char* words, double asked, double given) {
    cell.step();
    const Restraint said = cell.axis.take_restraint();
    return said.reason != nullptr && std::strstr(said.reason, words) != nullptr && said.asked == asked &&
           said.given == given;
  };
  Cell cyclic;
  assert_true(cyclic.run_until_enabled());
  cyclic.run(100);
  assert_true(cyclic.axis.take_restraint().reason == nullptr);
  cyclic.position = 12;
  assert_true(says(cyclic, "outside of `lowest` to `highest`", 12, 10));
  cyclic.position.reset();
  cyclic.axis.take_restraint();
  cyclic.axis.command_velocity(1);
  assert_non_null(std::strstr(cyclic.axis.take_restraint().reason, "another mode"));
  cyclic.axis.home();
  assert_non_null(std::strstr(cyclic.axis.take_restraint().reason, "`homing_method` is 0"));

  AxisPlan with = plan();
  with.mode = Mode::cyclic_velocity;
  with.acceleration = 100;
  Cell turning(with);
  assert_true(turning.run_until_enabled());
  turning.velocity = 25;
  assert_true(says(turning, "above `fastest`", 25, 20));
  turning.velocity = 4;
  turning.run(6000);
  assert_true(says(turning, "the end of its range", 4, 0));
}

/// A conveyor: nothing ends it, and its position counts on, or from 0 to its modulo again and again.
void an_endless_axis_has_no_end(void**) {
  AxisPlan with = plan();
  with.mode = Mode::profile_velocity;
  with.endless = true;
  with.modulo = 7;
  Cell cell(with);
  assert_true(cell.run_until_enabled());
  cell.velocity = 15;
  double turned = 0;
  double before = cell.axis.state()->position;
  for (int i = 0; i < 1500; ++i) {
    cell.step();
    const double now = cell.axis.state()->position;
    assert_true(now >= 0 && now < 7);
    turned += now >= before ? now - before : now - before + 7;
    before = now;
  }
  assert_true(turned > 100);
  assert_null(cell.axis.take_restraint().reason);
  with.modulo = 0;
  Cell counting(with);
  assert_true(counting.run_until_enabled());
  counting.velocity = 15;
  counting.run(10'000);
  assert_true(counting.axis.state()->position > 100);
}

/// The drive's counter runs over in the midst of the way, whichever way it counts.
void an_endless_axis_goes_on_when_the_counter_runs_over(void**) {
  for (const double increments : {1000.0, -1000.0}) {
    for (const Mode mode : {Mode::cyclic_position, Mode::profile_position}) {
      for (const double modulo : {0.0, 7.0}) {
        AxisPlan with = plan();
        with.mode = mode;
        with.endless = true;
        with.modulo = modulo;
        with.increments_per_unit = increments;
        Cell cell(with, {.node = node, .first_position = 2147480000});
        assert_true(cell.run_until_enabled());
        const double first = cell.axis.state()->position;
        const double before = cell.drive.motion().position();
        // Six times 2 units, in increments more than there are to the end of the counter.
        for (int turn = 1; turn <= 6; ++turn) {
          const double goal = first + (increments > 0 ? 2 : -2) * turn;
          if (mode == Mode::cyclic_position) cell.position = goal;
          if (mode == Mode::profile_position) cell.axis.move_to(goal, 20);
          cell.run(1000);
        }
        assert_true(cell.axis.fault().is_ok());
        assert_true(std::abs(cell.drive.motion().position() - before - 12'000) < 2);
        if (mode == Mode::profile_position) assert_true(cell.axis.state()->target_reached);
        const double gone = cell.axis.state()->position - (first + (increments > 0 ? 12 : -12));
        assert_true(std::abs(modulo > 0 ? std::remainder(gone, modulo) : gone) < 0.002);
      }
    }
  }
}

/// A home that it finds begins its count anew, however often the counter ran over before.
void an_endless_axis_that_was_homed_counts_from_its_home(void**) {
  AxisPlan with = plan();
  with.endless = true;
  with.modulo = 7;
  with.increments_per_unit = 1000;
  with.homing_method = 35;
  Cell cell(with, {.node = node, .first_position = 2147480000});
  assert_true(cell.run_until_enabled());
  cell.position = cell.axis.state()->position + 3;
  cell.run(1500);
  cell.position = *cell.position + 3;
  cell.run(1500);
  assert_true(cell.drive.motion().position() > 2147483648.0);
  cell.position.reset();
  cell.axis.home();
  cell.run(2000);
  assert_true(cell.axis.homing() == canopen::cia402::Homing::homed);
  assert_true(cell.is_at(0));
  cell.position = 3;
  cell.run(1500);
  assert_true(cell.is_at(3) && std::abs(cell.drive.motion().position() - 3000) < 2);
  assert_true(cell.axis.fault().is_ok());
}

/// A drive that has this mode instead: led as in cyclic position, from where it is, by no farther a step.
void interpolated_positions_are_followed(void**) {
  for (const bool on_each_object : {false, true}) {
    AxisPlan with = plan();
    with.mode = Mode::interpolated_position;
    with.homing_method = 33;
    with.homing_speed = 2;
    Cell cell(with, {.node = node, .acts_on_each_object = on_each_object});
    assert_true(cell.run_until_enabled());
    cell.run(300);
    assert_true(cell.is_at(-1) && cell.drive.longest_jump() == 0);
    cell.position = 5;
    cell.run(2000);
    assert_true(cell.is_at(5) && cell.drive.motion().position() == -5000);
    assert_int_equal(cell.drive.objects().get(canopen::cia402::objects::period_value), 7);
    cell.position = -5;
    cell.run(850);
    cell.may_move = false;
    cell.run(1000);
    const double rest = cell.axis.state()->position;
    assert_true(cell.axis.is_off() && rest > -5 && rest < 5);
    cell.position = std::nullopt;
    assert_true(cell.run_until_enabled());
    cell.run(300);
    assert_true(cell.is_at(rest));
    cell.axis.home();
    cell.run(4000);
    assert_true(cell.axis.homing() == canopen::cia402::Homing::homed && cell.is_at(0));
    cell.position = 3;
    cell.run(1500);
    assert_true(cell.is_at(3) && cell.axis.fault().is_ok());
    assert_true(cell.drive.longest_jump() <= 20000 * 0.007 * 2);
  }
}

/// It stays enabled, and says that it does not follow: which is told while it lasts, a few cycles after it
/// began.
void a_drive_that_ignores_its_set_points_is_told(void**) {
  for (const Mode mode : {Mode::cyclic_position, Mode::cyclic_velocity}) {
    AxisPlan with = plan();
    with.mode = mode;
    Cell cell(with);
    assert_true(cell.run_until_enabled());
    cell.run(1000);
    assert_null(cell.axis.take_restraint().reason);
    cell.drive.ignore_set_points(true);
    cell.run(42);
    assert_null(cell.axis.take_restraint().reason);
    for (int i = 0; i < 30; ++i) {
      cell.run(42);
      const Restraint said = cell.axis.take_restraint();
      assert_true(i == 0 || said.reason == servo_restraints::set_points_ignored);
      assert_true(cell.axis.is_enabled() && cell.axis.fault().is_ok());
    }
    cell.drive.ignore_set_points(false);
    cell.run(21);
    cell.axis.take_restraint();
    cell.run(200);
    assert_null(cell.axis.take_restraint().reason);
    // Neither while it homes nor while it is off does that bit say so.
    cell.may_move = false;
    cell.run(500);
    assert_null(cell.axis.take_restraint().reason);
  }
}

void a_drive_fault_is_told_with_what_the_drive_says(void**) {
  Cell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 9;
  cell.run(100);
  cell.drive.trip(0x2310, false, cell.heard);
  cell.run(300);
  assert_true(cell.axis.fault().code() == StatusCode::device_fault);
  assert_true(cell.fault_says("node 5: the drive is in fault"));
  assert_true(cell.fault_says("it says: current at the device's output (2310)"));
  cell.run(3000);
  assert_true(cell.drive.state() == DriveState::fault);
  cell.begin_again();
  cell.position = std::nullopt;
  assert_true(cell.run_until_enabled());
}

void a_node_that_resets_in_motion_is_a_fault_and_comes_back_off(void**) {
  Cell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 9;
  cell.run(100);
  cell.drive.reset_itself(cell.now);
  cell.run(2000);
  assert_true(cell.fault_says("node 5 reset itself"));
  assert_true(cell.axis.node().is_operational());
  assert_true(cell.axis.state().has_value());
  assert_true(cell.axis.is_off());
  assert_true(cell.drive.state() == DriveState::switch_on_disabled);
  cell.begin_again();
  cell.position = std::nullopt;
  const double rest = cell.axis.state()->position;
  assert_true(cell.run_until_enabled());
  cell.run(300);
  assert_true(cell.is_at(rest));
}

void a_cable_out_in_motion_stops_the_drive_and_is_told(void**) {
  Cell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 9;
  cell.run(100);
  cell.cable = false;
  cell.run(700);
  assert_true(cell.fault_says("no process data") || cell.fault_says("no heartbeat of node 5"));
  assert_false(cell.axis.state().has_value());
  assert_true(cell.drive.motion().is_at_rest());
  assert_true(cell.drive.state() == DriveState::switch_on_disabled);
  cell.cable = true;
  cell.run(2000);
  assert_true(cell.axis.state().has_value());
  assert_true(cell.axis.is_off());
  cell.begin_again();
  cell.position = std::nullopt;
  assert_true(cell.run_until_enabled());
}

void a_drive_without_sync_is_told(void**) {
  Cell cell;
  cell.syncs = false;
  cell.run(2000);
  assert_true(cell.axis.fault().is_ok());  // as long as nobody wants it to move
  cell.may_move = true;
  cell.run(100);
  assert_true(cell.axis.node().is_operational());
  assert_false(cell.axis.state().has_value());
  assert_true(cell.fault_says("no process data for 10 cycles"));
}

void a_drive_that_is_stuck_is_told(void**) {
  Cell cell;
  cell.drive.stick_in(DriveState::ready_to_switch_on);
  assert_false(cell.run_until_enabled());
  assert_true(cell.fault_says("stays 'ready to switch on'"));
}

void a_drive_that_refuses_its_mode_is_told(void**) {
  Cell cell;
  cell.drive.ignore_mode(true);
  assert_false(cell.run_until_enabled());
  assert_true(cell.fault_says("does not take mode 8"));
  assert_true(cell.drive.state() == DriveState::switch_on_disabled);
}

void a_foreign_drive_is_never_enabled(void**) {
  Cell cell;
  cell.drive.objects().set_first(canopen::objects::product, 0x777);
  cell.drive.power_on(cell.now);
  assert_false(cell.run_until_enabled());
  assert_true(cell.fault_says("its product is 00000777"));
  assert_false(cell.axis.state().has_value());
}

void twenty_thousand_cycles_keep_the_following_error_bounded(void**) {
  Cell cell;
  assert_true(cell.run_until_enabled());
  cell.position = 0;
  cell.run(1000);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    cell.position = 5 * std::sin(i * 0.007);
    cell.step();
    if (!cell.axis.state()) break;
    worst = std::max(worst, std::abs(cell.axis.state()->following_error));
  }
  assert_true(cell.axis.fault().is_ok());
  // At 5 unit/s, 0.035 in a cycle: a set-point waits for SYNC, is gone to, and is heard of at the SYNC after.
  assert_true(worst > 0 && worst <= 5 * 0.035);
}

AxisPlan homed_plan() {
  AxisPlan result = plan();
  result.homing_method = 33;
  result.homing_speed = 2;
  return result;
}

void a_drive_without_homing_says_so_and_goes_on(void**) {
  Cell cell(homed_plan());
  assert_true(cell.run_until_enabled());
  cell.drive.ignore_mode(true);
  cell.axis.home();
  assert_true(cell.axis.homing() == canopen::cia402::Homing::running);
  cell.run(1500);
  assert_true(cell.axis.homing() == canopen::cia402::Homing::failed);
  assert_non_null(std::strstr(cell.axis.homing_problem().cause(), "does it have it?"));
  assert_true(cell.axis.fault().is_ok() && cell.axis.is_enabled());
  cell.position = 3;
  cell.run(2000);
  assert_true(cell.is_at(3));
}

void a_drive_that_was_gone_has_forgotten_its_home(void**) {
  Cell cell(homed_plan());
  assert_true(cell.run_until_enabled());
  cell.axis.home();
  cell.run(2000);
  assert_true(cell.axis.homing() == canopen::cia402::Homing::homed);
  cell.may_move = false;
  cell.run(500);
  assert_true(cell.axis.homing() == canopen::cia402::Homing::homed);
  cell.drive.reset_itself(cell.now);
  cell.run(1500);
  assert_true(cell.axis.node().is_operational());
  assert_true(cell.axis.homing() == canopen::cia402::Homing::not_homed);
}

void plans_that_make_no_sense_are_refused(void**) {
  const auto refused = [](auto change, const char* words) {
    ServoAxis axis;
    Outbox outbox;
    AxisPlan with = plan();
    change(with);
    const Status status = axis.begin(with, Time{}, outbox);
    return status.code() == StatusCode::invalid_argument && std::strstr(status.cause(), words) != nullptr &&
           outbox.is_empty();
  };
  assert_true(refused([](AxisPlan& with) { with.mode = Mode::homing; }, "its mode"));
  assert_true(refused([](AxisPlan& with) { with.period = std::chrono::microseconds(1500); }, "its period"));
  assert_true(refused([](AxisPlan& with) { with.period = milliseconds(256); }, "its period"));
  assert_true(refused([](AxisPlan& with) { with.increments_per_unit = 0; }, "its increments"));
  assert_true(refused([](AxisPlan& with) { with.lowest = with.highest; }, "its lowest"));
  assert_true(refused([](AxisPlan& with) { with.fastest = 0; }, "its greatest velocity"));
  assert_true(refused([](AxisPlan& with) { with.acceleration = 0; }, "its acceleration"));
  assert_true(refused([](AxisPlan& with) { with.velocity_factor = -1; }, "the factor of its velocity"));
  assert_true(refused([](AxisPlan& with) { with.homing_speed = 0; }, "a speed of its homing"));
  assert_true(refused([](AxisPlan& with) { with.highest = 3e6; }, "more increments"));
  const auto whole_turn = [](AxisPlan& with) { with.endless = true, with.modulo = 3e6; };
  assert_true(refused(whole_turn, "its modulo has more increments"));
  assert_true(refused([](AxisPlan& with) { with.node = 0; }, "numbers from 1 to 127"));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_axis_that_may_not_move_is_read_and_off),
      cmocka_unit_test(an_enabled_axis_stays_where_it_is_and_follows),
      cmocka_unit_test(it_keeps_to_its_range),
      cmocka_unit_test(without_permission_it_stops_and_forgets),
      cmocka_unit_test(what_is_no_number_is_a_fault_and_never_followed),
      cmocka_unit_test(velocities_are_followed_up_to_the_range),
      cmocka_unit_test(a_set_point_counts_only_with_its_target_and_its_speed),
      cmocka_unit_test(a_drive_without_process_data_is_stopped_by_sdo),
      cmocka_unit_test(a_position_is_as_old_as_the_last_whole_pdo),
      cmocka_unit_test(what_is_held_back_is_said),
      cmocka_unit_test(an_endless_axis_has_no_end),
      cmocka_unit_test(an_endless_axis_goes_on_when_the_counter_runs_over),
      cmocka_unit_test(an_endless_axis_that_was_homed_counts_from_its_home),
      cmocka_unit_test(interpolated_positions_are_followed),
      cmocka_unit_test(a_drive_that_ignores_its_set_points_is_told),
      cmocka_unit_test(a_drive_fault_is_told_with_what_the_drive_says),
      cmocka_unit_test(a_node_that_resets_in_motion_is_a_fault_and_comes_back_off),
      cmocka_unit_test(a_cable_out_in_motion_stops_the_drive_and_is_told),
      cmocka_unit_test(a_drive_without_sync_is_told),
      cmocka_unit_test(a_drive_that_is_stuck_is_told),
      cmocka_unit_test(a_drive_that_refuses_its_mode_is_told),
      cmocka_unit_test(a_foreign_drive_is_never_enabled),
      cmocka_unit_test(twenty_thousand_cycles_keep_the_following_error_bounded),
      cmocka_unit_test(a_drive_without_homing_says_so_and_goes_on),
      cmocka_unit_test(a_drive_that_was_gone_has_forgotten_its_home),
      cmocka_unit_test(plans_that_make_no_sense_are_refused),
  };
  return cmocka_run_group_tests_name("cia402 servo axis", tests, nullptr, nullptr) + run_odd_drives();
}
