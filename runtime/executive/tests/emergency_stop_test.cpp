// A device that guards motion: safe state within a cycle, latched until a person clears it and gives Start.
#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::emergency_stop_test {
namespace {

using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr double safe_position = -1;

/// The usual cell, whose consumer commands a new position each millisecond; the actuator's safe state is a
/// position. The input is pressed in the cycles [pressed, released) of its own thread.
struct GuardedCell : Cell {
  GuardedCell(std::uint16_t in_thread, std::uint64_t pressed, std::uint64_t released) {
    thread(consuming).trigger = TriggerPlan::periodic(milliseconds{1}, std::chrono::microseconds{500});
    device(actuator).script.make_safe = [](TestDevice& device) {
      device.position = safe_position;
      return true;
    };
    DevicePlan guard{.name = "guard", .script = {}, .actuates = false};
    guard.script.receive = [this](TestDevice&, const Tick&) { ++cycles; };
    guard.script.demands_safe_state = [this, pressed, released] {
      return cycles == 0 || (cycles > pressed && cycles <= released);
    };
    guard_device = add(std::move(guard));
    thread(in_thread).devices.push_back(guard_device);
    unit(consumer).script.step = [this](TestUnit& unit, const Tick& tick) {
      if (tick.stop_requested) return;
      unit.device->command = static_cast<double>(tick.number + 1);
      moved.push_back(unit.device->position);
      inhibited.push_back(tick.motion_inhibited);
    };
  }
  std::uint64_t cycles = 0;  // of the guard's thread
  std::uint16_t guard_device = 0;
  std::vector<double> moved;  // the actuator's position as each step found it
  std::vector<bool> inhibited;
};

void expect(bool good, const char* what) {
  if (!good) throw CheckFailed{what};
}

void pressed_and_released(std::uint16_t in_thread) {
  GuardedCell cell(in_thread, 20, 40);
  std::optional<Executive> executive;
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
    Control& control = executive->control();
    switch (tick.stop_requested ? 0 : tick.number) {
      case 30:  // still pressed
        expect(!control.start_motion(), "Start while the stop is latched");
        control.clear_stop_motion();
        expect(!control.start_motion(), "Start while it is pressed");
        break;
      case 45:  // released, but not cleared
        expect(control.safe_state_latched(), "the latch did not come back while it was pressed");
        expect(!control.start_motion(), "Start before the stop was cleared");
        control.clear_stop_motion();
        break;
      case 50:
        expect(control.start_motion().is_ok(), "Start was refused after all");
        break;
      default:
        break;
    }
  };
  executive.emplace(cell.application(), in_virtual_time(milliseconds{70}));
  CHECK_EQUAL(run_to_the_end(*executive).exit_code, 0);
  CHECK_EQUAL(cell.moved.size(), 70U);
  // autostart: from the beginning until it is pressed.
  CHECK_EQUAL(cell.moved[20], 20.0);
  CHECK(!cell.inhibited[19]);
  for (std::size_t i = 20; i < 50; ++i) {
    CHECK(cell.inhibited[i]);
    CHECK_EQUAL(cell.moved[i + 1], safe_position);
  }
  CHECK(!cell.inhibited[50]);
  CHECK_EQUAL(cell.moved[51], 51.0);
}

// [stop-12] [stop-13] [stop-14] [stop-16]
void it_is_safe_within_a_cycle_and_stays_so_until_cleared_and_started() {
  pressed_and_released(Cell::consuming);
}

// [stop-12] [stop-13] [stop-16]
void another_threads_actuators_are_safe_within_their_cycle() {
  pressed_and_released(Cell::producing);
}

void pressed_from_the_start_nothing_ever_moves() {
  GuardedCell cell(Cell::producing, 0, 1000);
  Executive executive(cell.application(), in_virtual_time(milliseconds{20}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  for (const bool inhibited : cell.inhibited) CHECK(inhibited);
  CHECK_EQUAL(cell.moved.back(), safe_position);
}

/// One that was told to be safe and does not say that it is: nobody knows whether it moves.
// [stop-97]
void an_actuator_that_does_not_confirm_blocks_start_and_is_told_on() {
  GuardedCell cell(Cell::consuming, 20, 40);
  bool confirms = false;
  int told = 0;
  cell.device(Cell::actuator).script.make_safe = [&](TestDevice&) {
    ++told;
    return confirms;
  };
  std::optional<Executive> executive;
  int told_when_cleared = 0;
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
    Control& control = executive->control();
    switch (tick.stop_requested ? 0 : tick.number) {
      case 45:
        control.clear_stop_motion();
        told_when_cleared = told;
        break;
      case 60: {
        const Status refused = control.start_motion();
        expect(!refused && std::string_view{refused.cause()}.find("actuator was told to be safe") == 0,
               "Start, or another reason");
        expect(told > told_when_cleared + 10, "it was told no longer");
        confirms = true;
        break;
      }
      case 65:
        expect(control.start_motion().is_ok(), "Start was refused after all");
        break;
      default:
        break;
    }
  };
  executive.emplace(cell.application(), in_virtual_time(milliseconds{70}));
  CHECK_EQUAL(run_to_the_end(*executive).exit_code, 0);
  CHECK(!cell.inhibited[66]);
}

/// An input in fault says nothing any more, so it permits nothing.
// [stop-12] [stop-16]
void an_input_in_fault_stops_all() {
  GuardedCell cell(Cell::producing, 1000, 1000);
  cell.device(cell.guard_device).script.receive = [&cell](TestDevice& device, const Tick&) {
    if (++cell.cycles == 11) device.fail(Status::error(StatusCode::device_fault, "broken"));
  };
  std::optional<Executive> executive;
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
    if (tick.number != 15) return;
    executive->control().clear_stop_motion();
    expect(!executive->control().start_motion(), "Start in spite of an input in fault");
  };
  executive.emplace(cell.application(), in_virtual_time(milliseconds{30}));
  CHECK_EQUAL(run_to_the_end(*executive).exit_code, 2);
  CHECK_EQUAL(cell.moved[10], 10.0);
  for (std::size_t i = 11; i < 30; ++i) CHECK_EQUAL(cell.moved[i], safe_position);
}

// [stop-12] [stop-15]
void a_sleeping_threads_actuators_are_made_safe_too() {
  Cell cell;
  cell.unit(Cell::producer).script.step = {};  // the consumer, and with it the actuator, sleeps
  std::atomic<bool> pressed{false};
  std::atomic<TestDevice*> actuator{nullptr};
  cell.device(Cell::actuator).script.initialise = [&](TestDevice& device) {
    actuator = &device;
    return Status{};
  };
  DevicePlan guard{.name = "guard", .script = {}, .actuates = false};
  guard.script.demands_safe_state = [&] { return pressed.load(); };
  cell.thread(Cell::producing).devices.push_back(cell.add(std::move(guard)));
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return running.control().mode() == Mode::running; }));
  CHECK(wait_until([&] { return !actuator.load()->is_inhibited(); }));
  pressed = true;
  CHECK(wait_until([&] { return cell.device_state(Cell::actuator).safe.load(); }));
  CHECK(actuator.load()->is_inhibited());
  CHECK_EQUAL(cell.events().count_of("actuator: make_safe"), 1U);
  pressed = false;
  CHECK(wait_until([&] {
    running.control().clear_stop_motion();
    return running.control().start_motion().is_ok();
  }));
  CHECK(wait_until([&] { return !actuator.load()->is_inhibited(); }));
  CHECK_EQUAL(running.finish().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::fixture::emergency_stop_test

int main() {
  using namespace flexrf::fixture::emergency_stop_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(it_is_safe_within_a_cycle_and_stays_so_until_cleared_and_started),
      CONTAINED_TEST(another_threads_actuators_are_safe_within_their_cycle),
      CONTAINED_TEST(an_actuator_that_does_not_confirm_blocks_start_and_is_told_on),
      CONTAINED_TEST(pressed_from_the_start_nothing_ever_moves),
      CONTAINED_TEST(an_input_in_fault_stops_all),
      CONTAINED_TEST(a_sleeping_threads_actuators_are_made_safe_too),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
