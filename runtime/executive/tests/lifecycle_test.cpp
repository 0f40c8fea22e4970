// The life of units and devices: in which order, what goes wrong, who begins again.
#include <stdexcept>

#include "runtime/executive/tests/running_cell.hpp"
#include "tests/log_ear.hpp"

namespace flexrf::fixture::lifecycle_test {
namespace {

using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr const char* usual_order[] = {"actuator: initialise", "producer: initialise", "consumer: initialise",
                                       "consumer: stop",       "producer: stop",       "actuator: stop"};

void check_order(Cell& cell) {
  for (std::size_t i = 0; i < std::size(usual_order); ++i) {
    CHECK(cell.events().place_of(usual_order[i]) != Events::never);
    CHECK_EQUAL(cell.events().count_of(usual_order[i]), 1U);
    if (i > 0) CHECK(cell.events().place_of(usual_order[i - 1]) < cell.events().place_of(usual_order[i]));
  }
}

// [exec-36]
void initialised_in_table_order_stopped_in_reverse() {
  Cell simulated;
  Executive executive(simulated.application(), in_virtual_time(milliseconds{10}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  check_order(simulated);
  Cell real;
  RunningCell running(real);
  running.start();
  CHECK(wait_until([&] { return real.unit_state(Cell::consumer).steps > 5; }));
  CHECK_EQUAL(real.unit_state(Cell::consumer).life.load(), Life::running);
  CHECK_EQUAL(running.finish().exit_code, 0);
  check_order(real);
  CHECK_EQUAL(real.unit_state(Cell::consumer).life.load(), Life::stopped);
  CHECK_EQUAL(real.device_state(Cell::actuator).life.load(), Life::stopped);
}

void configuration_and_parameters_are_there_at_initialise() {
  Cell cell;
  double offset = 0;
  double gain = 0;
  cell.unit(Cell::producer).script.initialise = [&](TestUnit& unit) {
    offset = unit.configuration.offset;
    gain = unit.runtime.gain;
    return Status{};
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{2}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK_EQUAL(offset, 0.5);
  CHECK_EQUAL(gain, 1.0);
}

void check_failed_start(Cell& cell, const RunSummary& summary, const char* cause) {
  CHECK_EQUAL(summary.exit_code, 2);
  CHECK_EQUAL(summary.cause, EndCause::fault);
  CHECK_EQUAL(cell.unit_state(Cell::consumer).life.load(), Life::fault);
  CHECK_CONTAINS(cell.unit_state(Cell::consumer).fault.read().cause(), cause);
  CHECK_EQUAL(cell.events().count_of("consumer: initialise"), 1U);
  // What was begun is undone.
  CHECK_EQUAL(cell.events().count_of("producer: stop"), 1U);
  CHECK_EQUAL(cell.events().count_of("actuator: stop"), 1U);
  CHECK_EQUAL(cell.unit_state(Cell::consumer).steps.load(), 0U);
}

// [stop-32]
void a_unit_that_cannot_be_initialised_ends_the_start() {
  for (const bool simulated : {true, false}) {
    Cell cell;
    cell.unit(Cell::consumer).script.initialise = [](TestUnit&) {
      return Status::error(StatusCode::unavailable, "no cable");
    };
    Executive executive(cell.application(),
                        simulated ? in_virtual_time(milliseconds{10}) : on_the_wall_clock());
    check_failed_start(cell, run_to_the_end(executive), "no cable");
  }
}

// [stop-33]
void an_exception_in_initialise_is_a_fault_with_its_text() {
  Cell cell;
  cell.unit(Cell::consumer).script.initialise = [](TestUnit&) -> Status {
    throw std::runtime_error("bad file");
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{10}));
  check_failed_start(cell, run_to_the_end(executive), "bad file");
}

void a_device_that_cannot_be_initialised_ends_the_start() {
  Cell cell;
  cell.device(Cell::actuator).script.initialise = [](TestDevice&) {
    return Status::error(StatusCode::unavailable, "no such port");
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{10}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  CHECK_EQUAL(cell.device_state(Cell::actuator).life.load(), Life::fault);
  CHECK_CONTAINS(cell.device_state(Cell::actuator).fault.read().cause(), "no such port");
  CHECK_EQUAL(cell.events().count_of("producer: initialise"), 0U);
}

// ---- a device that need not be there

/// The usual cell, whose actuator is not there at the start.
struct CellWithout : Cell {
  explicit CellWithout(StatusCode code = StatusCode::not_found) {
    device(actuator).required = false;
    device(actuator).script.initialise = [this, code](TestDevice&) {
      return is_there ? Status{} : Status::error(code, "no such port");
    };
    thread(consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  }
  Life life_of_device() const { return device_state(actuator).life; }
  Life life_of_unit() const { return unit_state(consumer).life; }
  std::uint64_t steps() const { return unit_state(producer).steps; }

  std::atomic<bool> is_there{false};
};

// [exec-96] [exec-97] [exec-98] [exec-91]
void a_device_that_need_not_be_there_is_waited_for() {
  CellWithout cell;
  const LogEar ear;
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.steps() > 5; }));
  CHECK_EQUAL(cell.life_of_device(), Life::waiting);
  CHECK_EQUAL(cell.life_of_unit(), Life::waiting);
  CHECK_CONTAINS(cell.device_state(Cell::actuator).fault.read().cause(), "no such port");
  CHECK_CONTAINS(cell.unit_state(Cell::consumer).fault.read().cause(), "the device actuator is not there");
  CHECK(ear.has_heard("actuator: waits and is started later (driver mock): no such port"));
  CHECK(ear.has_heard("consumer: waits and is started later: the device actuator is not there"));
  CHECK_EQUAL(cell.events().count_of("consumer: initialise"), 0U);
  // It is looked for again and again, and told once.
  CHECK(wait_until([&] { return cell.events().count_of("actuator: initialise") >= 3; }));
  const LogEar later;
  cell.is_there = true;
  CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 5; }));
  CHECK_EQUAL(cell.life_of_device(), Life::running);
  CHECK(!later.has_heard("waits and is started later"));
  CHECK(later.has_heard("actuator: what was missing is there: it runs now"));
  CHECK_EQUAL(running.finish().exit_code, 0);
}

// [exec-92]
void a_late_actuator_waits_for_start() {
  CellWithout cell;
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.steps() > 5; }));
  CHECK(running.control().may_move());
  cell.is_there = true;
  CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 5; }));
  CHECK(!running.control().may_move());
  CHECK_EQUAL(running.finish().exit_code, 0);
}

void a_late_device_that_moves_nothing_stops_nobody() {
  CellWithout cell;
  cell.device(Cell::actuator).actuates = false;
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.steps() > 5; }));
  cell.is_there = true;
  CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 5; }));
  CHECK(running.control().may_move());
  CHECK_EQUAL(running.finish().exit_code, 0);
}

// [exec-93]
void a_device_that_is_waited_for_is_no_fault() {
  for (const bool comes : {false, true}) {
    CellWithout cell;
    Executive executive(cell.application(), in_virtual_time(std::chrono::seconds{2}));
    cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
      if (tick.number == 800) cell.is_there = comes;
    };
    CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
    CHECK_EQUAL(executive.control().faults(), 0U);
    CHECK_EQUAL(cell.unit_state(Cell::consumer).steps.load() > 0, comes);
  }
}

// [exec-94]
void only_a_device_that_is_not_there_is_waited_for() {
  for (const StatusCode code : {StatusCode::invalid_argument, StatusCode::not_permitted, StatusCode::busy,
                                StatusCode::device_fault, StatusCode::internal}) {
    CellWithout cell(code);
    Executive executive(cell.application(), in_virtual_time(milliseconds{10}));
    CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
    CHECK_EQUAL(cell.life_of_device(), Life::fault);
  }
  for (const StatusCode code : {StatusCode::unavailable, StatusCode::timeout}) {
    CellWithout cell(code);
    Executive executive(cell.application(), in_virtual_time(milliseconds{10}));
    CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  }
}

/// As of a device that was plugged in, whose file everybody may open a moment later.
// [exec-95]
void a_device_that_is_waited_for_may_be_refused_on_its_way() {
  Cell cell;
  cell.device(Cell::actuator).required = false;
  int tried = 0;
  cell.device(Cell::actuator).script.initialise = [&](TestDevice&) {
    ++tried;
    return tried == 1   ? Status::error(StatusCode::not_found, "no such port")
           : tried == 2 ? Status::error(StatusCode::not_permitted, "no right to open it")
                        : Status{};
  };
  const LogEar ear;
  Executive executive(cell.application(), in_virtual_time(std::chrono::seconds{3}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK_EQUAL(tried, 3);
  CHECK(ear.has_heard("actuator: waits and is started later (driver mock): no right to open it"));
  CHECK(cell.unit_state(Cell::consumer).steps > 0);
}

/// What stands on it fails by itself.
void a_unit_that_fails_when_its_device_is_there_is_in_fault() {
  CellWithout cell;
  cell.unit(Cell::consumer).script.initialise = [](TestUnit&) {
    return Status::error(StatusCode::unavailable, "no cable");
  };
  Executive executive(cell.application(), in_virtual_time(std::chrono::seconds{2}));
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick&) { cell.is_there = true; };
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  CHECK_EQUAL(executive.control().faults(), 1U);
  CHECK_CONTAINS(cell.unit_state(Cell::consumer).fault.read().cause(), "no cable");
}

// [exec-98]
void what_is_on_a_missing_bus_waits_with_it() {
  Cell cell;
  std::atomic<bool> is_there{false};
  DevicePlan bus{.name = "bus", .script = {}, .actuates = false, .required = false};
  bus.script.initialise = [&](TestDevice&) {
    return is_there ? Status{} : Status::error(StatusCode::unavailable, "no adapter");
  };
  const std::uint16_t place = cell.add(std::move(bus));
  cell.device(Cell::actuator).bus = place;
  cell.thread(Cell::consuming).devices = {place, Cell::actuator};
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(Cell::producer).steps > 5; }));
  CHECK_EQUAL(cell.device_state(Cell::actuator).life.load(), Life::waiting);
  CHECK_EQUAL(cell.unit_state(Cell::consumer).life.load(), Life::waiting);
  CHECK_EQUAL(cell.events().count_of("actuator: initialise"), 0U);
  is_there = true;
  CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 5; }));
  CHECK(cell.events().place_of("actuator: initialise") < cell.events().place_of("consumer: initialise"));
  CHECK_EQUAL(running.finish().exit_code, 0);
}

/// An emergency stop that nobody can read permits nothing.
void a_missing_emergency_stop_permits_no_motion() {
  Cell cell;
  DevicePlan guard{.name = "guard", .script = {}, .actuates = false, .required = false};
  guard.script.initialise = [](TestDevice&) { return Status::error(StatusCode::not_found, "no chip"); };
  guard.script.demands_safe_state = [] { return false; };
  cell.thread(Cell::producing).devices.push_back(cell.add(std::move(guard)));
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(Cell::producer).steps > 5; }));
  CHECK(!running.control().may_move());
  CHECK(!running.control().start_motion());
  CHECK_EQUAL(running.finish().exit_code, 0);
}

// [exec-6] [exec-71] [stop-33] [stop-37]
void an_exception_in_a_step_is_that_units_fault() {
  for (const bool simulated : {true, false}) {
    Cell cell;
    cell.unit(Cell::producer).script.step = [](TestUnit&, const Tick& tick) {
      if (tick.number == 4) throw std::out_of_range("joint 7 of 6");
    };
    cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
    Executive executive(cell.application(),
                        simulated ? in_virtual_time(milliseconds{50}) : on_the_wall_clock());
    std::atomic<std::uint64_t> steps_after{0};
    cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick&) {
      if (cell.unit_state(Cell::producer).life != Life::fault) return;
      if (++steps_after == 10) {
        executive.control().set_cause(EndCause::requested);
        executive.control().rise_to(Mode::stopping);
      }
    };
    CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
    CHECK_EQUAL(cell.unit_state(Cell::producer).life.load(), Life::fault);
    CHECK_CONTAINS(cell.unit_state(Cell::producer).fault.read().cause(), "joint 7 of 6");
    CHECK_EQUAL(cell.unit_state(Cell::producer).steps.load(), 5U);
    CHECK(steps_after >= 10U);
    // It is stopped all the same, so that what it opened is closed.
    CHECK_EQUAL(cell.events().count_of("producer: stop"), 1U);
  }
}

// [stop-33]
void what_is_no_exception_of_the_library_too() {
  Cell cell;
  cell.unit(Cell::producer).script.step = [](TestUnit&, const Tick&) { throw 42; };
  Executive executive(cell.application(), in_virtual_time(milliseconds{5}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  CHECK_CONTAINS(cell.unit_state(Cell::producer).fault.read().cause(), "unknown type");
}

// ---- restart policies

struct Restarts {
  std::size_t initialised;
  std::uint64_t last_steps;
  Life life;
  bool may_move;
};

/// A consumer that faults in its fifth step, as often as it gets that far.
Restarts restarts_with(RestartPolicy policy, DriverKind kind) {
  Cell cell;
  cell.unit(Cell::consumer).restart = policy;
  cell.device(Cell::actuator).kind = kind;
  bool may_move = true;
  Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
    may_move = executive.control().may_move();
    if (tick.number == 4) unit.fail(Status::error(StatusCode::device_fault, "again"));
  };
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  return {cell.events().count_of("consumer: initialise"), cell.unit_state(Cell::consumer).steps,
          cell.unit_state(Cell::consumer).life, may_move};
}

void never_is_never() {
  const Restarts restarts = restarts_with(RestartPolicy::never, DriverKind::simulated);
  CHECK_EQUAL(restarts.initialised, 1U);
  CHECK_EQUAL(restarts.last_steps, 5U);
  CHECK_EQUAL(restarts.life, Life::fault);
}

// [stop-6] [stop-38]
void once_is_once() {
  const Restarts restarts = restarts_with(RestartPolicy::once, DriverKind::simulated);
  CHECK_EQUAL(restarts.initialised, 2U);
  CHECK_EQUAL(restarts.life, Life::fault);
  CHECK(!restarts.may_move);
}

// [stop-6] [stop-38]
void always_is_as_often_as_it_takes() {
  const Restarts restarts = restarts_with(RestartPolicy::always, DriverKind::simulated);
  CHECK(restarts.initialised >= 18U);
  CHECK(!restarts.may_move);
}

// [stop-39]
void who_owns_a_real_actuator_is_never_restarted() {
  const Restarts restarts = restarts_with(RestartPolicy::always, DriverKind::real);
  CHECK_EQUAL(restarts.initialised, 1U);
  CHECK_EQUAL(restarts.life, Life::fault);
}

// [stop-38]
void a_restart_constructs_anew_and_keeps_the_settings() {
  Cell cell;
  cell.unit(Cell::producer).restart = RestartPolicy::once;
  std::vector<double> gains;
  std::vector<std::int64_t> memories;
  Executive executive(cell.application(), in_virtual_time(milliseconds{50}));
  cell.unit(Cell::producer).script.initialise = [&](TestUnit& unit) {
    gains.push_back(unit.runtime.gain);
    memories.push_back(unit.memory);
    return Status{};
  };
  cell.unit(Cell::producer).script.step = [&](TestUnit& unit, const Tick& tick) {
    unit.memory = 77;
    if (tick.number == 2) {
      ParameterRequest request;
      request.component = Cell::producer;
      const double gain = 2.5;
      request.add(0, 0, &gain, sizeof(gain));
      executive.cell().send(request);
    }
    if (tick.number == 6 && gains.size() == 1) unit.fail(Status::error(StatusCode::device_fault, "once"));
  };
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  CHECK((gains == std::vector<double>{1.0, 2.5}));
  CHECK((memories == std::vector<std::int64_t>{0, 0}));
  CHECK_EQUAL(cell.unit_state(Cell::producer).life.load(), Life::stopped);
}

// [stop-6] [stop-38]
void a_restart_on_the_wall_clock() {
  Cell cell;
  cell.unit(Cell::producer).restart = RestartPolicy::once;
  cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
    unit.outputs[0].publish(Item{});
    if (tick.number == 4) unit.fail(Status::error(StatusCode::device_fault, "broken"));
  };
  RunningCell running(cell);
  running.start();
  // Five steps each: faulted, restarted, faulted for good. The restart first: a fault that is seen after it
  // is the second.
  CHECK(wait_until([&] {
    return cell.events().count_of("producer: initialise") == 2 &&
           cell.unit_state(Cell::producer).life == Life::fault;
  }));
  CHECK(!running.control().may_move());
  CHECK_EQUAL(running.finish().exit_code, 2);
  CHECK(cell.slot_control(Cell::values).published() == 10U);
}

// ---- what readers of a unit in trouble see

/// Steps a consumer every millisecond beside a producer with this script; the reasons it saw, without
/// repeats.
std::vector<NullReason> reasons_seen(Cell& cell) {
  cell.thread(Cell::consuming).trigger =
      TriggerPlan::periodic(milliseconds{1}, std::chrono::microseconds{500});
  std::vector<NullReason> reasons;
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
    const NullReason reason = unit.inputs[0].latest().reason();
    if (!tick.stop_requested && (reasons.empty() || reasons.back() != reason)) reasons.push_back(reason);
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{50}));
  run_to_the_end(executive);
  return reasons;
}

// [stop-35]
void readers_of_a_faulted_unit_see_why() {
  Cell cell;
  cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
    if (tick.number >= 3) unit.outputs[0].publish(Item{});
    if (tick.number == 10) unit.fail(Status::error(StatusCode::device_fault, "broken"));
  };
  CHECK((reasons_seen(cell) ==
         std::vector<NullReason>{NullReason::nothing_yet, NullReason::none, NullReason::writer_faulted}));
}

void readers_of_a_restarted_unit_see_it_again() {
  Cell cell;
  cell.unit(Cell::producer).restart = RestartPolicy::once;
  bool failed = false;
  cell.unit(Cell::producer).script.step = [&](TestUnit& unit, const Tick& tick) {
    unit.outputs[0].publish(Item{});
    if (tick.number == 10 && !failed) {
      failed = true;
      unit.fail(Status::error(StatusCode::device_fault, "broken"));
    }
  };
  const std::vector<NullReason> reasons = reasons_seen(cell);
  CHECK_EQUAL(reasons.back(), NullReason::none);
}

// [board-20]
void readers_of_a_late_unit_see_that_it_is_too_old() {
  Cell cell;
  cell.unit(Cell::consumer).inputs[0].max_age = milliseconds{5};
  cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
    if (tick.number < 10 || tick.number > 30) unit.outputs[0].publish(Item{});
  };
  CHECK((reasons_seen(cell) ==
         std::vector<NullReason>{NullReason::none, NullReason::too_old, NullReason::none}));
}

// [board-22]
void an_input_that_is_not_connected_says_so() {
  Cell cell;
  cell.unit(Cell::consumer).inputs[0].slot = no_index;
  CHECK((reasons_seen(cell) == std::vector<NullReason>{NullReason::not_registered}));
}

// [stop-78]
void readers_of_a_faulted_device_see_why() {
  Cell cell;
  const std::uint16_t measured = cell.add(SlotPlan{.name = "measured"});
  cell.device(Cell::actuator).output = measured;
  cell.unit(Cell::consumer).inputs[0].slot = measured;
  Time now{};
  Time made_safe_at{};
  cell.device(Cell::actuator).script.receive = [&](TestDevice& device, const Tick& tick) {
    device.output.publish(Item{});
    now = tick.now;
    if (tick.now > Time{std::chrono::seconds{1}} + milliseconds{20}) {
      device.fail(Status::error(StatusCode::device_fault, "overheated"));
    }
  };
  cell.device(Cell::actuator).script.make_safe = [&](TestDevice&) {
    if (made_safe_at == Time{}) made_safe_at = now;
    return true;
  };
  const std::vector<NullReason> reasons = reasons_seen(cell);
  CHECK_EQUAL(reasons.back(), NullReason::writer_faulted);
  CHECK_EQUAL(cell.device_state(Cell::actuator).life.load(), Life::fault);
  // In the cycle of the fault, long before the end of the run.
  CHECK_EQUAL(nanoseconds(made_safe_at), 1'020'500'000);
}

}  // namespace
}  // namespace flexrf::fixture::lifecycle_test

int main() {
  using namespace flexrf::fixture::lifecycle_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(initialised_in_table_order_stopped_in_reverse),
      CONTAINED_TEST(configuration_and_parameters_are_there_at_initialise),
      CONTAINED_TEST(a_unit_that_cannot_be_initialised_ends_the_start),
      CONTAINED_TEST(an_exception_in_initialise_is_a_fault_with_its_text),
      CONTAINED_TEST(a_device_that_cannot_be_initialised_ends_the_start),
      CONTAINED_TEST(a_device_that_need_not_be_there_is_waited_for),
      CONTAINED_TEST(a_late_actuator_waits_for_start),
      CONTAINED_TEST(a_late_device_that_moves_nothing_stops_nobody),
      CONTAINED_TEST(a_device_that_is_waited_for_is_no_fault),
      CONTAINED_TEST(only_a_device_that_is_not_there_is_waited_for),
      CONTAINED_TEST(a_device_that_is_waited_for_may_be_refused_on_its_way),
      CONTAINED_TEST(a_unit_that_fails_when_its_device_is_there_is_in_fault),
      CONTAINED_TEST(what_is_on_a_missing_bus_waits_with_it),
      CONTAINED_TEST(a_missing_emergency_stop_permits_no_motion),
      CONTAINED_TEST(an_exception_in_a_step_is_that_units_fault),
      CONTAINED_TEST(what_is_no_exception_of_the_library_too),
      CONTAINED_TEST(never_is_never),
      CONTAINED_TEST(once_is_once),
      CONTAINED_TEST(always_is_as_often_as_it_takes),
      CONTAINED_TEST(who_owns_a_real_actuator_is_never_restarted),
      CONTAINED_TEST(a_restart_constructs_anew_and_keeps_the_settings),
      CONTAINED_TEST(a_restart_on_the_wall_clock),
      CONTAINED_TEST(readers_of_a_faulted_unit_see_why),
      CONTAINED_TEST(readers_of_a_restarted_unit_see_it_again),
      CONTAINED_TEST(readers_of_a_late_unit_see_that_it_is_too_old),
      CONTAINED_TEST(an_input_that_is_not_connected_says_so),
      CONTAINED_TEST(readers_of_a_faulted_device_see_why),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
