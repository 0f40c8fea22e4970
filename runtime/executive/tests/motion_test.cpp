// Nothing moves by itself: Start, Stop motion, holds and their leases.
#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::motion_test {
namespace {

using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr Time beginning{std::chrono::seconds{1}};

/// A cell whose consumer commands a new position each millisecond, while the producer's script is the person.
struct Machine {
  explicit Machine(bool autostart, Duration duration, std::function<void(Machine&, std::uint64_t)> person) {
    cell.autostart = autostart;
    cell.thread(Cell::consuming).trigger =
        TriggerPlan::periodic(milliseconds{1}, std::chrono::microseconds{500});
    cell.unit(Cell::consumer).script.step = [this](TestUnit& unit, const Tick& tick) {
      if (tick.stop_requested) return;
      unit.device->command = static_cast<double>(tick.number + 1);
      moved.push_back(unit.device->position);
      inhibited.push_back(tick.motion_inhibited);
      ticks.push_back(tick);
      held.push_back(unit.runtime.move);
    };
    cell.unit(Cell::producer).script.step = [this, person = std::move(person)](TestUnit&, const Tick& tick) {
      if (!tick.stop_requested) person(*this, tick.number);
    };
    executive.emplace(cell.application(), in_virtual_time(duration));
    exit_code = run_to_the_end(*executive).exit_code;
  }
  Control& control() { return executive->control(); }

  /// Requests for the consumer's hold.
  void hold(RequestKind kind, std::uint64_t lease, std::uint64_t sequence, Time issued_at = {}) {
    ParameterRequest request;
    request.kind = kind;
    request.component = Cell::consumer;
    request.lease = lease;
    request.lease_sequence = sequence;
    request.issued_at = issued_at;
    request.add_name(2);
    executive->cell().send(request);
  }

  Cell cell;
  std::optional<Executive> executive;
  std::vector<double> moved;    // the actuator's position as each step found it
  std::vector<bool> inhibited;  // what each step was told
  std::vector<Tick> ticks;
  std::vector<bool> held;
  int exit_code = -1;
};

// [stop-1] [stop-2]
void nothing_moves_before_start() {
  Machine machine(false, milliseconds{50}, [](Machine&, std::uint64_t) {});
  CHECK_EQUAL(machine.exit_code, 0);
  CHECK_EQUAL(machine.moved.size(), 50U);
  for (const double position : machine.moved) CHECK_EQUAL(position, 0.0);
  for (const bool inhibited : machine.inhibited) CHECK(inhibited);
}

// [stop-7]
void autostart_lifts_it_at_power_on() {
  Machine machine(true, milliseconds{50}, [](Machine&, std::uint64_t) {});
  CHECK_EQUAL(machine.moved.back(), 49.0);
  for (const bool inhibited : machine.inhibited) CHECK(!inhibited);
}

// [stop-91]
void without_autostart_the_table_does_not_count() {
  Cell cell;
  cell.autostart = true;
  std::vector<bool> inhibited;
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
    inhibited.push_back(tick.motion_inhibited && unit.device->is_inhibited());
  };
  Options options = in_virtual_time(milliseconds{10});
  options.autostart = false;
  Executive executive(cell.application(), options);
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK(!inhibited.empty());
  for (const bool one : inhibited) CHECK(one);
}

// [stop-4] [stop-5] [stop-8] [stop-9] [stop-11]
void start_lets_move_and_stop_motion_ends_it_in_the_next_period() {
  Machine machine(false, milliseconds{60}, [](Machine& self, std::uint64_t number) {
    if (number == 10 && !self.control().start_motion()) throw CheckFailed{"Start was refused"};
    if (number == 30) self.control().stop_motion();
    if (number == 40) {
      if (self.control().start_motion()) throw CheckFailed{"Start in spite of the latch"};
      self.control().clear_stop_motion();
    }
    if (number == 50 && !self.control().start_motion()) throw CheckFailed{"Start was refused"};
  });
  CHECK_EQUAL(machine.exit_code, 0);
  // Steps are half a millisecond after the person's acts; what they command takes effect at their end.
  CHECK_EQUAL(machine.moved[10], 0.0);
  CHECK_EQUAL(machine.moved[11], 11.0);
  CHECK_EQUAL(machine.moved[30], 30.0);
  for (std::size_t i = 30; i <= 50; ++i) CHECK_EQUAL(machine.moved[i], 30.0);
  CHECK_EQUAL(machine.moved[51], 51.0);
  for (std::size_t i = 0; i < 60; ++i) {
    CHECK_EQUAL(machine.inhibited[i], i < 10 || (i >= 30 && i < 50));
  }
}

// [stop-96]
void a_step_may_follow_what_was_asked_for_since_the_start() {
  Machine machine(false, milliseconds{40}, [](Machine& self, std::uint64_t number) {
    // At 15 motion is permitted already: that Start does not count.
    if ((number == 10 || number == 15 || number == 30) && !self.control().start_motion())
      throw CheckFailed{"Start was refused"};
    if (number == 20) self.control().stop_motion();
    if (number == 25) self.control().clear_stop_motion();
  });
  CHECK_EQUAL(machine.exit_code, 0);
  for (std::size_t i = 0; i < 40; ++i) {
    const Tick& tick = machine.ticks[i];
    const bool permitted = (i >= 10 && i < 20) || i >= 30;
    const Time start = beginning + milliseconds{i < 30 ? 10 : 30};
    CHECK_EQUAL(tick.may_follow(tick.now), permitted);
    CHECK_EQUAL(tick.may_follow(start + std::chrono::microseconds{500}), permitted);
    CHECK(!tick.may_follow(start - Duration{1}));
  }
  Machine started(true, milliseconds{3}, [](Machine&, std::uint64_t) {});
  CHECK(started.ticks.front().may_follow(Time{}));
}

/// All three between two looks of the thread that moves something.
// [stop-8] [stop-94] [stop-95]
void a_stop_that_was_cleared_at_once_is_not_lost() {
  std::string refused;
  Machine machine(true, milliseconds{60}, [&](Machine& self, std::uint64_t number) {
    if (number == 20) {
      self.control().stop_motion();
      self.control().clear_stop_motion();
      refused = self.control().start_motion().cause();
    }
    if (number == 40) {
      self.control().require_start();
      if (self.control().start_motion()) throw CheckFailed{"Start before the thread has looked"};
    }
    if ((number == 21 || number == 41) && !self.control().start_motion())
      throw CheckFailed{"Start was refused"};
  });
  CHECK_EQUAL(machine.exit_code, 0);
  CHECK(refused.find("consuming") != std::string::npos);
  for (std::size_t i = 0; i < 60; ++i) CHECK_EQUAL(machine.inhibited[i], i == 20 || i == 40);
  CHECK_EQUAL(machine.moved[21], machine.moved[20]);
}

/// Its thread owns nothing that moves, and Start does not wait for it; but what its unit does next may well
/// lead an actuator.
// [stop-94]
void a_unit_without_an_actuator_sees_each_stop() {
  Cell cell;
  cell.autostart = true;
  cell.thread(Cell::consuming).trigger =
      TriggerPlan::periodic(milliseconds{1}, std::chrono::microseconds{500});
  cell.thread(Cell::producing).trigger = TriggerPlan::periodic(milliseconds{10});
  std::optional<Executive> executive;
  std::vector<std::uint64_t> inhibited;
  cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick& tick) {
    Control& control = executive->control();
    if (tick.number == 22) {
      control.stop_motion();
      control.clear_stop_motion();
    }
    if (tick.number == 24 && !control.start_motion()) throw CheckFailed{"Start was refused"};
  };
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
    if (tick.motion_inhibited) inhibited.push_back(tick.number);
  };
  executive.emplace(cell.application(), in_virtual_time(milliseconds{60}));
  CHECK_EQUAL(run_to_the_end(*executive).exit_code, 0);
  CHECK_EQUAL(inhibited.size(), 1U);
}

/// The device was initialised while motion was permitted, and its thread has not looked yet.
// [stop-9]
void stop_motion_counts_before_the_first_step() {
  Cell cell;
  cell.autostart = true;
  std::optional<Executive> executive;
  std::vector<bool> inhibited;
  cell.unit(Cell::producer).script.initialise = [&](TestUnit&) {
    executive->control().stop_motion();
    return Status{};
  };
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick&) {
    inhibited.push_back(unit.device->is_inhibited());
  };
  executive.emplace(cell.application(), in_virtual_time(milliseconds{10}));
  run_to_the_end(*executive);
  CHECK(!inhibited.empty());
  for (const bool one : inhibited) CHECK(one);
}

void a_hold_lasts_as_long_as_its_lease_is_refreshed() {
  const std::uint64_t lease = new_lease_number();
  Machine machine(true, milliseconds{800}, [lease](Machine& self, std::uint64_t number) {
    if (number == 10) self.hold(RequestKind::hold, lease, 1);
    if (number == 200) self.hold(RequestKind::refresh, lease, 2);
    // Long over: a lease never revives.
    if (number == 600) self.hold(RequestKind::refresh, lease, 3);
    if (number == 700) self.hold(RequestKind::hold, new_lease_number(), 1);
  });
  CHECK_EQUAL(machine.exit_code, 0);
  for (std::size_t i = 0; i < machine.held.size(); ++i) {
    // From the person's act until 250 ms after the last refresh.
    const bool wanted = (i >= 10 && i < 450) || i >= 700;
    CHECK_EQUAL(machine.held[i], wanted);
  }
}

void a_lease_counts_from_the_persons_act() {
  Machine machine(true, milliseconds{400}, [](Machine& self, std::uint64_t number) {
    // It waited for 100 ms somewhere on its way.
    if (number == 110) self.hold(RequestKind::hold, new_lease_number(), 1, beginning + milliseconds{10});
  });
  for (std::size_t i = 0; i < machine.held.size(); ++i) CHECK_EQUAL(machine.held[i], i >= 110 && i < 260);
}

// [stop-10]
void stop_motion_ends_holds_for_good() {
  const std::uint64_t lease = new_lease_number();
  Machine machine(true, milliseconds{100}, [lease](Machine& self, std::uint64_t number) {
    if (number == 10) self.hold(RequestKind::hold, lease, 1);
    if (number == 30) self.control().stop_motion();
    if (number == 40) {
      self.control().clear_stop_motion();
      if (!self.control().start_motion()) throw CheckFailed{"Start was refused"};
    }
    if (number > 10) self.hold(RequestKind::refresh, lease, number);
  });
  for (std::size_t i = 0; i < machine.held.size(); ++i) CHECK_EQUAL(machine.held[i], i >= 10 && i < 30);
}

void a_hold_is_refused_while_motion_is_inhibited() {
  Machine machine(false, milliseconds{50}, [](Machine& self, std::uint64_t number) {
    if (number == 10) self.hold(RequestKind::hold, new_lease_number(), 1);
  });
  for (const bool held : machine.held) CHECK(!held);
}

// [stop-6]
void a_restart_needs_a_new_start() {
  bool failed = false;
  Cell cell;
  cell.unit(Cell::producer).restart = RestartPolicy::once;
  cell.thread(Cell::consuming).trigger =
      TriggerPlan::periodic(milliseconds{1}, std::chrono::microseconds{500});
  std::vector<bool> inhibited;
  cell.unit(Cell::producer).script.step = [&](TestUnit& unit, const Tick& tick) {
    if (tick.number != 10 || failed) return;
    failed = true;
    unit.fail(Status::error(StatusCode::device_fault, "broken"));
  };
  cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick& tick) {
    if (!tick.stop_requested) inhibited.push_back(tick.motion_inhibited);
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{30}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  CHECK_EQUAL(inhibited.size(), 30U);
  for (std::size_t i = 0; i < inhibited.size(); ++i) CHECK_EQUAL(inhibited[i], i >= 10);
}

// [exec-2] [stop-9]
void stop_motion_is_seen_by_sleeping_threads_on_the_wall_clock() {
  Cell cell;
  cell.unit(Cell::producer).script.step = {};  // the consumer, and with it the actuator, sleeps
  TestDevice* actuator = nullptr;
  cell.device(Cell::actuator).script.initialise = [&](TestDevice& device) {
    actuator = &device;
    return Status{};
  };
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return running.control().mode() == Mode::running; }));
  CHECK(wait_until([&] { return !actuator->is_inhibited(); }));
  running.control().stop_motion();
  CHECK(wait_until([&] { return actuator->is_inhibited(); }));
  running.control().clear_stop_motion();
  CHECK(wait_until([&] { return running.control().start_motion().is_ok(); }));
  CHECK(wait_until([&] { return !actuator->is_inhibited(); }));
  CHECK_EQUAL(running.finish().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::fixture::motion_test

int main() {
  using namespace flexrf::fixture::motion_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(nothing_moves_before_start),
      CONTAINED_TEST(autostart_lifts_it_at_power_on),
      CONTAINED_TEST(without_autostart_the_table_does_not_count),
      CONTAINED_TEST(start_lets_move_and_stop_motion_ends_it_in_the_next_period),
      CONTAINED_TEST(a_step_may_follow_what_was_asked_for_since_the_start),
      CONTAINED_TEST(a_stop_that_was_cleared_at_once_is_not_lost),
      CONTAINED_TEST(a_unit_without_an_actuator_sees_each_stop),
      CONTAINED_TEST(stop_motion_counts_before_the_first_step),
      CONTAINED_TEST(a_hold_lasts_as_long_as_its_lease_is_refreshed),
      CONTAINED_TEST(a_lease_counts_from_the_persons_act),
      CONTAINED_TEST(stop_motion_ends_holds_for_good),
      CONTAINED_TEST(a_hold_is_refused_while_motion_is_inhibited),
      CONTAINED_TEST(a_restart_needs_a_new_start),
      CONTAINED_TEST(stop_motion_is_seen_by_sleeping_threads_on_the_wall_clock),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
