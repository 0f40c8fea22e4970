// The master's axis and drives that others built: what the standard leaves open, each met by a drive of its
// own.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "hal/canopen/servo_axis.hpp"
#include "hal/servo_drive/canopen/simulator/tests/foreign_drive.hpp"
#include "hal/servo_drive/interface/servo_restraints.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using canopen::Message;
using canopen::Outbox;
using canopen::cia402::AxisPlan;
using canopen::cia402::Mode;
using canopen::cia402::ServoAxis;
using std::chrono::milliseconds;

constexpr int cycle_of_7_ms = 7;

AxisPlan plan_for(Mode mode) {
  AxisPlan plan;
  plan.node = 5;
  plan.vendor = 0x123;
  plan.mode = mode;
  plan.increments_per_unit = 1000;
  plan.lowest = -10;
  plan.highest = 10;
  plan.fastest = 5;
  return plan;
}

// The wire carries what has the lowest identifier first, as CAN does.
struct ForeignCell {
  explicit ForeignCell(const AxisPlan& plan, const ForeignDrive::Nature& nature = {}) : drive{nature} {
    began = axis.begin(plan, now, said);
  }

  void step() {
    for (int ms = 0; ms < cycle_of_7_ms; ++ms) {
      now += milliseconds(1);
      if (ms == 0) deliver();
      drive.step(heard);
    }
    for (; !heard.is_empty(); heard.pop()) axis.receive(heard.front(), now, said);
    if (position) axis.command_position(*position);
    if (velocity) axis.command_velocity(*velocity);
    axis.send(may_move, now, milliseconds(cycle_of_7_ms), said);
    if (const Restraint held = axis.take_restraint(); held.reason != nullptr) restraint = held;
  }
  void deliver() {
    std::vector<Message> frames;
    for (; !said.is_empty(); said.pop()) frames.push_back(said.front());
    std::stable_sort(frames.begin(), frames.end(), [](const Message& one, const Message& other) {
      return one.identifier < other.identifier;
    });
    for (const Message& frame : frames) drive.receive(frame, heard);
  }
  void run(int ms) {
    for (int i = 0; i < ms; i += cycle_of_7_ms) step();
  }
  bool comes_up() {
    may_move = true;
    for (int i = 0; i < 1000 && axis.fault().is_ok() && !axis.is_enabled(); ++i) step();
    if (!axis.is_enabled())
      print_message("fault: %s; node: %s\n", axis.fault().cause(), axis.node().problem().cause());
    return axis.is_enabled();
  }
  bool arrives() {
    for (int i = 0; i < 1000; ++i) {
      step();
      if (axis.state() && axis.state()->target_reached) return true;
    }
    print_message("fault: %s\n", axis.fault().cause());
    return false;
  }
  bool is_at(double place) const {
    return std::abs(drive.position() - 1000 * place) < 2 && axis.state() &&
           std::abs(axis.state()->position - place) < 0.01;
  }
  bool fault_says(const char* words) const {
    if (std::strstr(axis.fault().cause(), words) != nullptr) return true;
    print_message("fault: %s\n", axis.fault().cause());
    return false;
  }

  Time now{std::chrono::seconds(1)};
  ForeignDrive drive;
  ServoAxis axis;
  Status began;
  Outbox said;
  Outbox heard;
  bool may_move = false;
  std::optional<double> position;
  std::optional<double> velocity;
  Restraint restraint;
};

double speed_of(std::int32_t target) {
  switch (target) {
    case 3000:
      return 2000;
    case -2000:
      return 4000;
    case 5000:
      return 1000;
    case 1000:
      return 3000;
    default:
      return 0;
  }
}

// Two targets, one after the other, and two with so many cycles between them: each that counts does so with
// its own speed.
bool each_set_point_has_its_speed(ForeignCell& cell, int cycles_between, bool has_speeds = true) {
  if (!cell.comes_up()) return false;
  cell.axis.move_to(3, 2);
  if (!cell.arrives() || !cell.is_at(3)) return false;
  cell.axis.move_to(-2, 4);
  if (!cell.arrives() || !cell.is_at(-2)) return false;
  cell.axis.move_to(5, 1);
  for (int i = 0; i < cycles_between; ++i) cell.step();
  cell.axis.move_to(1, 3);
  if (!cell.arrives() || !cell.is_at(1)) return false;
  const auto& taken = cell.drive.set_points();
  for (const ForeignDrive::SetPoint& one : taken) {
    const double speed = speed_of(one.target);
    if (!has_speeds || (speed > 0 && std::abs(one.speed - speed) < 1)) continue;
    print_message("%d with %u\n", static_cast<int>(one.target), static_cast<unsigned>(one.speed));
    return false;
  }
  return taken.size() >= 3 && taken.back().target == 1000;
}

bool each_set_point_has_its_speed(const AxisPlan& plan, const ForeignDrive::Nature& nature) {
  for (int cycles_between = 0; cycles_between < 10; ++cycles_between) {
    ForeignCell cell{plan, nature};
    if (!each_set_point_has_its_speed(cell, cycles_between)) return false;
  }
  return true;
}

void a_drive_that_acts_on_each_object_goes_where_it_is_told(void**) {
  assert_true(each_set_point_has_its_speed(plan_for(Mode::profile_position), {}));
}

void a_drive_that_acts_at_last_goes_where_it_is_told(void**) {
  assert_true(each_set_point_has_its_speed(plan_for(Mode::profile_position), {.acts_at_last = true}));
}

void a_speed_that_is_in_no_pdo_is_told_before_its_target_counts(void**) {
  AxisPlan plan = plan_for(Mode::profile_position);
  ForeignCell unsaid{plan, {.unmapped = {0x608100}}};
  assert_false(unsaid.comes_up());
  assert_true(unsaid.fault_says("maps_speed = false"));
  plan.maps_speed = false;
  assert_true(each_set_point_has_its_speed(plan, {.unmapped = {0x608100}}));
  assert_true(each_set_point_has_its_speed(plan, {.unmapped = {0x608100}, .acts_at_last = true}));
  assert_true(each_set_point_has_its_speed(plan, {.unmapped = {0x608100}, .serves_after = 50}));
  // Beside a mode that is in no PDO either.
  plan.maps_mode = false;
  assert_true(each_set_point_has_its_speed(plan, {.unmapped = {0x608100, 0x606000, 0x606100}}));
}

void a_drive_without_a_second_pdo_is_told_its_speed_by_sdo(void**) {
  AxisPlan plan = plan_for(Mode::profile_position);
  plan.maps_speed = false;
  assert_true(each_set_point_has_its_speed(
      plan, {.lacks = {0x140100, 0x140101, 0x140102, 0x160100, 0x160101, 0x160102, 0x160103, 0x160104}}));
}

void a_drive_without_an_object_for_its_speed_says_what_it_does(void**) {
  AxisPlan plan = plan_for(Mode::profile_position);
  plan.maps_speed = false;
  ForeignCell refused{plan, {.lacks = {0x608100}}};
  static_cast<void>(refused.comes_up());
  refused.run(200);
  assert_true(refused.fault_says("6081:00"));
  plan.tells_speed = false;
  ForeignCell cell{plan, {.lacks = {0x608100}}};
  assert_true(cell.comes_up());
  cell.axis.move_to(4, ServoAxis::full_speed);
  assert_true(cell.arrives() && cell.is_at(4));
  assert_null(cell.restraint.reason);
  assert_true(each_set_point_has_its_speed(cell, 3, false));
  assert_ptr_equal(cell.restraint.reason, servo_restraints::own_speed);
}

void interpolated_positions_are_followed_without_a_jump(void**) {
  const ForeignDrive::Nature nature{.position = -3000, .interpolates = true};
  ForeignCell unsaid{plan_for(Mode::cyclic_position), nature};
  assert_false(unsaid.comes_up());
  assert_true(unsaid.fault_says("interpolates = true"));
  for (const bool acts_at_last : {false, true}) {
    ForeignDrive::Nature with = nature;
    with.acts_at_last = acts_at_last;
    ForeignCell cell{plan_for(Mode::interpolated_position), with};
    cell.position = 4;
    assert_true(cell.comes_up());
    assert_int_equal(cell.drive.object(0x60C2, 1), 7);
    cell.run(3000);
    assert_true(cell.is_at(4));
    // As far as it may go in a cycle, and never more.
    assert_true(cell.drive.longest_jump() <= 5000 * 0.007 + 1);
    // Off in the midst of it, and enabled anew where it then is.
    cell.position = -4;
    cell.run(500);
    cell.may_move = false;
    cell.run(500);
    assert_false(cell.axis.is_enabled());
    const double rest = cell.drive.position();
    cell.position = std::nullopt;
    assert_true(cell.comes_up());
    cell.run(500);
    assert_true(std::abs(cell.drive.position() - rest) < 40);
    assert_true(cell.drive.longest_jump() <= 5000 * 0.007 + 1);
  }
}

// Set-points that come while it is on its way back from its home are not followed at once when it is there.
void a_homing_in_the_midst_of_interpolated_positions_ends_without_a_jump(void**) {
  AxisPlan plan = plan_for(Mode::interpolated_position);
  plan.homing_method = 35;
  ForeignCell cell{plan, {.position = 4000, .interpolates = true}};
  assert_true(cell.comes_up());
  cell.position = 5;
  cell.run(1000);
  assert_true(cell.is_at(5));
  cell.axis.home();
  cell.run(6000);
  assert_true(cell.axis.homing() == canopen::cia402::Homing::homed);
  assert_true(cell.is_at(5));
  assert_true(cell.drive.longest_jump() <= 5000 * 0.007 + 1);
  assert_true(cell.axis.fault().is_ok());
}

void a_drive_that_ceases_to_interpolate_is_a_fault(void**) {
  ForeignCell cell{plan_for(Mode::interpolated_position), {.interpolates = true}};
  cell.position = 4;
  assert_true(cell.comes_up());
  cell.run(200);
  cell.drive.stop_interpolation();
  cell.run(200);
  assert_true(cell.fault_says("no longer follows"));
  assert_false(cell.drive.is_enabled());
}

void a_node_that_starts_itself_is_configured_all_the_same(void**) {
  for (const int after : {0, 1, 7, 15, 40}) {
    for (const bool again : {false, true}) {
      ForeignCell cell{plan_for(Mode::cyclic_position),
                       {.starts_itself = after, .starts_again = again && after > 0}};
      cell.position = 2;
      assert_true(cell.comes_up());
      cell.run(1000);
      assert_true(cell.is_at(2));
    }
  }
}

void a_drive_without_a_deceleration_of_its_own_takes_that_of_its_acceleration(void**) {
  ForeignCell cell{plan_for(Mode::profile_position), {.lacks = {0x608400}}};
  assert_true(each_set_point_has_its_speed(cell, 3));
  assert_int_equal(cell.drive.object(0x6083), 10000);
}

void a_drive_without_an_acceleration_has_ramps_of_its_own(void**) {
  for (const Mode mode : {Mode::profile_position, Mode::profile_velocity}) {
    ForeignCell cell{plan_for(mode), {.lacks = {0x608300, 0x608400}}};
    assert_true(cell.comes_up());
    assert_true(cell.axis.has_own_ramps());
    if (mode == Mode::profile_position) assert_true(each_set_point_has_its_speed(cell, 3));
  }
  ForeignCell told{plan_for(Mode::profile_position)};
  assert_true(told.comes_up());
  assert_false(told.axis.has_own_ramps());
}

// In each mode it is at rest where it rests, and about as fast as it goes.
void a_drive_that_does_not_say_how_fast_it_is_tells_it_by_its_positions(void**) {
  for (const Mode mode : {Mode::cyclic_position, Mode::profile_position}) {
    // Nor has it a second PDO to say it in.
    const ForeignDrive::Nature nature{
        .lacks = {0x606C00, 0x180100, 0x180101, 0x180102, 0x1A0100, 0x1A0101, 0x1A0102, 0x1A0103, 0x1A0104}};
    AxisPlan plan = plan_for(mode);
    plan.homing_method = 35;
    ForeignCell unsaid{plan, {.lacks = {0x606C00}}};
    assert_false(unsaid.comes_up());
    assert_true(unsaid.fault_says("maps_velocity = false"));
    plan.maps_velocity = false;
    ForeignCell cell{plan, nature};
    assert_true(cell.comes_up());
    cell.run(100);
    assert_true(cell.axis.state()->velocity == 0);
    if (mode == Mode::cyclic_position) cell.position = 6;
    if (mode == Mode::profile_position) cell.axis.move_to(6, 5);
    cell.run(500);
    assert_true(std::abs(cell.axis.state()->velocity - 5) < 0.5);
    cell.position.reset();
    cell.run(1500);
    assert_true(cell.is_at(6) && cell.axis.state()->velocity == 0);
    cell.axis.home();
    cell.run(6000);
    assert_true(cell.axis.homing() == canopen::cia402::Homing::homed && cell.axis.fault().is_ok());
    cell.may_move = false;
    cell.run(200);
    assert_true(cell.axis.is_off() && cell.axis.fault().is_ok());
  }
}

// What is optional and missing keeps nobody away, but for what the table asks for; then it says so.
void what_the_table_asks_for_and_is_missing_is_told_with_its_column(void**) {
  AxisPlan stops = plan_for(Mode::cyclic_position);
  stops.quick_stop_deceleration = 20;
  ForeignCell no_stop{stops, {.lacks = {0x608500}}};
  assert_false(no_stop.comes_up());
  assert_true(no_stop.fault_says("6085:00") && no_stop.fault_says("quick_stop_deceleration = 0"));
  AxisPlan homes = plan_for(Mode::cyclic_position);
  homes.homing_method = 35;
  for (const std::uint32_t missing : {0x609800U, 0x609901U, 0x609902U}) {
    ForeignCell no_home{homes, {.lacks = {missing}}};
    assert_false(no_home.comes_up());
    assert_true(no_home.fault_says("homing_method = 0"));
  }
  AxisPlan guarded = plan_for(Mode::cyclic_position);
  guarded.is_guarded = true;
  ForeignCell no_guard{guarded};
  assert_false(no_guard.comes_up());
  assert_true(no_guard.fault_says("100C:00") && no_guard.fault_says("guarded = false"));
  AxisPlan pressing = plan_for(Mode::profile_position);
  pressing.limits_torque = true;
  ForeignCell no_limit{pressing};
  assert_false(no_limit.comes_up());
  assert_true(no_limit.fault_says("limits_torque = false"));
  pressing.limits_torque = false;
  pressing.tells_torque = true;
  ForeignCell no_torque{pressing};
  assert_false(no_torque.comes_up());
  assert_true(no_torque.fault_says("tells_torque = false"));
  // Without a following error window, to be blocked is no fault of its.
  pressing.tells_torque = false;
  pressing.may_be_blocked = true;
  ForeignCell no_window{pressing};
  assert_true(no_window.comes_up());
  ForeignCell plain{plan_for(Mode::cyclic_position), {.lacks = {0x608300, 0x608400, 0x609800, 0x609901}}};
  assert_true(plain.comes_up());
}

// As older ones do: it is told what the bit means, and it goes on.
void a_drive_that_leaves_bit_12_is_led_all_the_same(void**) {
  ForeignCell cell{plan_for(Mode::cyclic_position), {.leaves_bit_12 = true}};
  cell.position = 4;
  assert_true(cell.comes_up());
  cell.run(2000);
  assert_true(cell.is_at(4) && cell.axis.fault().is_ok());
  assert_ptr_equal(cell.restraint.reason, servo_restraints::set_points_ignored);
}

void the_product_is_asked_for_only_where_it_is_named(void**) {
  ForeignCell unnamed{plan_for(Mode::cyclic_position), {.lacks = {0x101802}}};
  assert_true(unnamed.comes_up());
  AxisPlan named = plan_for(Mode::cyclic_position);
  named.product = 0x456;
  ForeignCell cell{named, {.lacks = {0x101802}}};
  assert_false(cell.comes_up());
  assert_true(cell.fault_says("1018:02"));
}

void identifiers_that_are_right_already_need_not_be_written(void**) {
  ForeignCell cell{plan_for(Mode::cyclic_position), {.constant = {0x140001, 0x140101, 0x180001, 0x180101}}};
  cell.position = 2;
  assert_true(cell.comes_up());
  cell.run(1000);
  assert_true(cell.is_at(2));
  ForeignCell other{plan_for(Mode::cyclic_position), {.constant = {0x140001}, .identifier_of_first = 0x333}};
  assert_false(other.comes_up());
  assert_true(other.fault_says("1400:01") && other.fault_says("00000333") && other.fault_says("00000205"));
}

void what_cannot_be_written_and_is_right_already_is_taken(void**) {
  ForeignCell right{plan_for(Mode::cyclic_position), {.constant = {0x60C202}}};
  assert_true(right.comes_up());
  ForeignCell wrong{plan_for(Mode::cyclic_position), {.constant = {0x60C201}}};
  assert_false(wrong.comes_up());
  assert_true(wrong.fault_says("60C2:01") && wrong.fault_says("tells_period = false"));
}

// At the other end of a driver's bus.
// By bit 12 alone, as some do.
void a_home_that_is_told_by_one_bit_needs_the_column_and_rest(void**) {
  for (const bool is_said : {true, false}) {
    AxisPlan plan = plan_for(Mode::cyclic_position);
    plan.homing_method = 35;
    plan.homing_timeout = std::chrono::seconds(5);
    plan.homing_tells_reached = !is_said;
    ForeignCell cell(plan, {.homes_without_bit_10 = true});
    assert_true(cell.comes_up());
    cell.axis.home();
    cell.run(8000);
    assert_true(cell.axis.fault().is_ok());
    if (is_said) {
      assert_true(cell.axis.homing() == canopen::cia402::Homing::homed);
      assert_true(cell.is_at(0));
    } else {
      assert_true(cell.axis.homing() == canopen::cia402::Homing::failed);
      assert_non_null(std::strstr(cell.axis.homing_problem().cause(), "homing_tells_reached = false"));
    }
  }
}

// And is off for that on the way to its home and on the way back.
void a_drive_that_changes_its_mode_while_it_is_off_needs_the_column(void**) {
  for (const bool maps_mode : {true, false}) {
    for (const bool is_said : {true, false}) {
      AxisPlan plan = plan_for(Mode::cyclic_position);
      plan.homing_method = 35;
      plan.maps_mode = maps_mode;
      plan.changes_mode_enabled = !is_said;
      ForeignCell cell(plan, {.changes_mode_off = true});
      assert_true(cell.comes_up());
      cell.position = 3;
      cell.run(1500);
      cell.position.reset();
      cell.axis.home();
      cell.run(8000);
      assert_true(cell.axis.fault().is_ok() && cell.axis.is_enabled());
      if (!is_said) {
        assert_true(cell.axis.homing() == canopen::cia402::Homing::failed);
        assert_non_null(std::strstr(cell.axis.homing_problem().cause(), "changes_mode_enabled = false"));
        continue;
      }
      assert_true(cell.axis.homing() == canopen::cia402::Homing::homed);
      assert_int_equal(cell.drive.modes_refused(), 0);
      assert_true(cell.is_at(0));
      cell.position = 2;
      cell.run(2000);
      assert_true(cell.is_at(2));
    }
  }
}

bool is_last_target(const ForeignCell& cell, double place) {
  const auto& taken = cell.drive.set_points();
  return !taken.empty() && taken.back().target == 1000 * place;
}

// Each waits until it is at the one before, and of several the newest counts.
void a_drive_that_finishes_its_targets_needs_the_column(void**) {
  AxisPlan plan = plan_for(Mode::profile_position);
  ForeignCell unsaid{plan, {.finishes_targets = true}};
  assert_true(unsaid.comes_up());
  unsaid.axis.move_to(3, 1);
  unsaid.run(1000);
  assert_true(unsaid.fault_says("changes_target_at_once = false"));
  plan.changes_target_at_once = false;
  for (const bool finishes : {true, false}) {  // one that could do otherwise is led all the same
    for (int cycles_between = 0; cycles_between < 10; ++cycles_between) {
      ForeignCell cell{plan, {.finishes_targets = finishes}};
      assert_true(cell.comes_up());
      cell.axis.move_to(3, 2);
      for (int i = 0; i < cycles_between; ++i) cell.step();
      cell.axis.move_to(1, 3);
      assert_true(cell.arrives() && cell.is_at(1));
      for (const ForeignDrive::SetPoint& one : cell.drive.set_points())
        assert_int_equal(one.speed, speed_of(one.target));
      const std::size_t taken = cell.drive.set_points().size();
      cell.axis.move_to(3, 1);
      cell.run(1000);
      cell.axis.move_to(-2, 4);
      cell.run(100);
      assert_string_equal(cell.restraint.reason, servo_restraints::target_waits);
      assert_true(is_last_target(cell, 3));
      cell.axis.move_to(1, 3);
      assert_true(cell.arrives() && cell.is_at(1) && is_last_target(cell, 1));
      assert_int_equal(cell.drive.set_points().size(), taken + 2);
    }
  }
}

// A command releases the halt, and the drive would first go on to its old target. Commands come in each of 80
// cycles after the halt.
void a_drive_that_finishes_its_targets_takes_none_while_it_is_halted(void**) {
  AxisPlan plan = plan_for(Mode::profile_position);
  plan.changes_target_at_once = false;
  for (int cycles = 0; cycles < 80; ++cycles) {
    ForeignCell cell{plan, {.finishes_targets = true}};
    assert_true(cell.comes_up());
    cell.axis.move_to(5, 1);
    cell.run(700);
    cell.axis.halt();
    cell.step();
    const double halted = cell.drive.position();
    for (int i = 0; i < cycles; ++i) cell.step();
    const bool takes_commands = cell.axis.state()->enabled;
    cell.axis.move_to(-1, 2);
    for (int i = 0; i < 600; ++i) {
      cell.step();
      assert_true(cell.drive.position() < halted + 20);  // what it does until the halt has reached it
    }
    assert_true(cell.axis.fault().is_ok() && cell.axis.is_enabled());
    assert_true(cell.is_at(-1) == takes_commands);
  }
}

// The next target after a halt is the only one that the drive goes to.
void a_drive_that_finishes_its_targets_forgets_one_by_a_halt(void**) {
  AxisPlan plan = plan_for(Mode::profile_position);
  plan.changes_target_at_once = false;
  for (int cycles = 0; cycles < 40; ++cycles) {
    ForeignCell cell{plan, {.finishes_targets = true}};
    assert_true(cell.comes_up());
    cell.axis.move_to(5, 1);
    for (int i = 0; i < cycles; ++i) cell.step();
    cell.axis.halt();
    cell.run(1000);
    assert_true(cell.axis.fault().is_ok() && cell.axis.is_enabled());
    const double rest = cell.drive.position();
    cell.run(500);
    assert_true(cell.drive.position() == rest);
    cell.axis.move_to(-1, 2);
    assert_true(cell.arrives() && cell.is_at(-1) && is_last_target(cell, -1));
  }
}

// In whichever moment of it the permission is withdrawn: it is off and stays so, and begins anew where it is.
void a_homing_that_switches_off_is_stopped_in_each_of_its_cycles(void**) {
  for (int cycles = 0; cycles < 120; ++cycles) {
    AxisPlan plan = plan_for(Mode::cyclic_position);
    plan.homing_method = 35;
    plan.changes_mode_enabled = false;
    ForeignCell cell(plan, {.position = 4000, .changes_mode_off = true});
    assert_true(cell.comes_up());
    cell.axis.home();
    cell.run(cycles * cycle_of_7_ms);
    cell.may_move = false;
    cell.run(1000);
    assert_true(cell.axis.is_off() && !cell.drive.is_enabled() && cell.axis.fault().is_ok());
    assert_true(cell.axis.homing() != canopen::cia402::Homing::running);
    const double rest = cell.drive.position();
    assert_true(cell.comes_up());
    cell.run(500);
    assert_true(cell.drive.position() == rest);
    cell.position = cell.axis.state()->position + 1;
    cell.run(1000);
    assert_true(std::abs(cell.drive.position() - rest - 1000) < 2);
  }
}

// It has been told before, and keeps that over a reset.
void what_a_drive_refuses_because_it_is_so_is_as_good(void**) {
  ForeignCell cell{plan_for(Mode::profile_position), {.refuses_what_is_so = true}};
  assert_true(cell.comes_up());
  assert_false(cell.drive.aborts().empty());
  assert_true(each_set_point_has_its_speed(cell, 3));
}

// Its position controller leaves something, and its window is as wide.
void a_drive_that_stops_within_its_own_window_has_arrived(void**) {
  struct Case {
    std::optional<std::uint32_t> window;
    double short_by;
    bool arrives;
  };
  // As far as it goes in a period it may always be away; a window that is off says nothing.
  for (const Case& one : {Case{std::nullopt, 0, true}, Case{10, 8, true}, Case{100, 80, true},
                          Case{10, 80, false}, Case{0xFFFFFFFF, 80, false}, Case{0xFFFFFFFF, 2, true}}) {
    AxisPlan plan = plan_for(Mode::profile_position);
    plan.fastest = 0.5;
    ForeignCell cell(plan, {.window = one.window, .stops_short = one.short_by});
    assert_true(cell.comes_up());
    cell.axis.move_to(2, 0.5);
    for (int i = 0; i < 600 && !cell.axis.state()->target_reached; ++i) cell.step();
    assert_true(cell.axis.state()->target_reached == one.arrives);
    assert_true(cell.axis.fault().is_ok());
  }
}

// The drive says all the time that it is there, as one may of the target before, or with a window as wide as
// its range.
void a_target_is_not_reached_before_the_axis_stands_near_it(void**) {
  for (const std::uint32_t window : {10U, 100000U}) {
    AxisPlan plan = plan_for(Mode::profile_position);
    ForeignCell cell(plan, {.window = window, .stops_short = 8});
    assert_true(cell.comes_up());
    cell.drive.say_beside(0x0400);
    cell.axis.move_to(3, 2);
    for (int i = 0; i < 600 && !cell.axis.state()->target_reached; ++i) cell.step();
    assert_true(cell.axis.state()->target_reached);
    assert_true(std::abs(cell.drive.position() - 3000) < 40);
  }
}

// However the drive follows velocities: at once, or by a ramp of its own that is the plan's.
void an_axis_that_is_led_by_velocities_comes_to_rest_at_the_end_of_its_range(void**) {
  for (const Mode mode : {Mode::cyclic_velocity, Mode::profile_velocity}) {
    for (const double speed : {0.05, 1.0, 5.0}) {
      for (const double direction : {1.0, -1.0}) {
        AxisPlan plan = plan_for(mode);
        plan.lowest = 0;
        plan.highest = 2;
        ForeignCell cell(plan);
        assert_true(cell.comes_up());
        cell.velocity = direction * speed;
        double farthest = cell.drive.position();
        for (int i = 0; i < 5000; ++i) {
          cell.step();
          farthest = direction > 0 ? std::max(farthest, cell.drive.position())
                                   : std::min(farthest, cell.drive.position());
        }
        const double end = direction > 0 ? 2000 : 0;
        if (std::abs(farthest - end) > 3) print_message("%g of %g at %g\n", farthest, end, speed);
        assert_true(std::abs(farthest - end) <= 3);
        assert_true(cell.axis.state()->velocity == 0);
        assert_ptr_equal(cell.restraint.reason, servo_restraints::end_of_range);
        // And back, from the end.
        cell.velocity = -direction * speed;
        cell.run(700);
        assert_true(std::abs(cell.drive.position() - end) > 20);
        assert_true(cell.axis.fault().is_ok());
      }
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_drive_that_acts_on_each_object_goes_where_it_is_told),
      cmocka_unit_test(a_drive_that_acts_at_last_goes_where_it_is_told),
      cmocka_unit_test(a_home_that_is_told_by_one_bit_needs_the_column_and_rest),
      cmocka_unit_test(a_drive_that_changes_its_mode_while_it_is_off_needs_the_column),
      cmocka_unit_test(a_homing_that_switches_off_is_stopped_in_each_of_its_cycles),
      cmocka_unit_test(what_a_drive_refuses_because_it_is_so_is_as_good),
      cmocka_unit_test(a_drive_that_stops_within_its_own_window_has_arrived),
      cmocka_unit_test(a_target_is_not_reached_before_the_axis_stands_near_it),
      cmocka_unit_test(an_axis_that_is_led_by_velocities_comes_to_rest_at_the_end_of_its_range),
      cmocka_unit_test(a_speed_that_is_in_no_pdo_is_told_before_its_target_counts),
      cmocka_unit_test(a_drive_without_a_second_pdo_is_told_its_speed_by_sdo),
      cmocka_unit_test(a_drive_without_an_object_for_its_speed_says_what_it_does),
      cmocka_unit_test(interpolated_positions_are_followed_without_a_jump),
      cmocka_unit_test(a_homing_in_the_midst_of_interpolated_positions_ends_without_a_jump),
      cmocka_unit_test(a_drive_that_ceases_to_interpolate_is_a_fault),
      cmocka_unit_test(a_node_that_starts_itself_is_configured_all_the_same),
      cmocka_unit_test(a_drive_without_a_deceleration_of_its_own_takes_that_of_its_acceleration),
      cmocka_unit_test(a_drive_without_an_acceleration_has_ramps_of_its_own),
      cmocka_unit_test(a_drive_that_does_not_say_how_fast_it_is_tells_it_by_its_positions),
      cmocka_unit_test(what_the_table_asks_for_and_is_missing_is_told_with_its_column),
      cmocka_unit_test(a_drive_that_leaves_bit_12_is_led_all_the_same),
      cmocka_unit_test(a_drive_that_finishes_its_targets_needs_the_column),
      cmocka_unit_test(a_drive_that_finishes_its_targets_takes_none_while_it_is_halted),
      cmocka_unit_test(a_drive_that_finishes_its_targets_forgets_one_by_a_halt),
      cmocka_unit_test(the_product_is_asked_for_only_where_it_is_named),
      cmocka_unit_test(identifiers_that_are_right_already_need_not_be_written),
      cmocka_unit_test(what_cannot_be_written_and_is_right_already_is_taken),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
