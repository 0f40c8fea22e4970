// Single components stopped, started and initialised while the application runs, as the panel asks for it.
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::action_test {
namespace {

using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr ComponentIndex actuator = 2;  // units come first

/// A cell that runs; its consumer steps every millisecond and commands ever new positions.
struct Machine {
  explicit Machine(const std::function<void(Cell&)>& change = nullptr) {
    cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
    if (change) change(cell);
    running.emplace(cell);
    running->start();
    CHECK(wait_until([this] { return steps() > 5; }));
  }
  Executive& executive() { return running->executive(); }
  std::uint64_t steps() { return cell.unit_state(Cell::consumer).steps; }
  Life life() { return cell.unit_state(Cell::consumer).life; }

  // Each waits for the answer.
  Status act(ComponentAction action, ComponentIndex component) {
    std::atomic<bool> answered{false};
    Status answer;
    executive().act(action, component, [&](const Status& status) {
      answer = status;
      answered = true;
    });
    CHECK(wait_until([&] { return answered.load(); }));
    return answer;
  }

  ReconfigureResult reconfigure(ComponentIndex component) {
    std::atomic<bool> answered{false};
    ReconfigureResult result;
    executive().reconfigure({{component, "offset", "0.75"}}, [&](const ReconfigureResult& outcome) {
      result = outcome;
      answered = true;
    });
    CHECK(wait_until([&] { return answered.load(); }));
    return result;
  }

  Cell cell;
  std::optional<RunningCell> running;
};

// [exec-44] [exec-49]
void a_unit_that_owns_an_actuator_comes_to_rest_before_it_is_stopped() {
  std::atomic<int> steps_to_rest{0};
  std::atomic<bool> inhibited_on_the_way{false};
  Machine machine([&](Cell& cell) {
    cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
      if (!tick.stop_requested) return;
      // Once it is at rest it may be stepped on, inhibited, until its thread gives it away.
      if (++unit.memory > 20) return;
      ++steps_to_rest;
      inhibited_on_the_way = inhibited_on_the_way || unit.device->is_inhibited();
    };
    cell.unit(Cell::consumer).script.is_idle = [](const TestUnit& unit) { return unit.memory >= 20; };
  });
  CHECK(machine.act(ComponentAction::stop, Cell::consumer).is_ok());
  CHECK_EQUAL(machine.life(), Life::stopped);
  CHECK_EQUAL(steps_to_rest.load(), 20);
  CHECK(!inhibited_on_the_way);
  CHECK(!machine.executive().control().may_move());
  CHECK_EQUAL(machine.cell.events().count_of("actuator: make_safe"), 0U);
  CHECK_EQUAL(machine.cell.unit_state(Cell::producer).life.load(), Life::running);
  CHECK_EQUAL(machine.running->finish().exit_code, 0);
}

// [exec-45]
void who_does_not_come_to_rest_has_its_devices_made_safe() {
  Machine machine([](Cell& cell) {
    cell.unit(Cell::consumer).stop_timeout = milliseconds{30};
    cell.unit(Cell::consumer).script.is_idle = [](const TestUnit&) { return false; };
  });
  CHECK(machine.act(ComponentAction::stop, Cell::consumer).is_ok());
  CHECK_EQUAL(machine.life(), Life::stopped);
  CHECK_EQUAL(machine.cell.events().count_of("actuator: make_safe"), 1U);
  CHECK(machine.cell.events().place_of("actuator: make_safe") <
        machine.cell.events().place_of("consumer: stop"));
  CHECK(!machine.executive().control().may_move());
}

// [exec-49]
void what_is_started_again_waits_for_start() {
  Machine machine;
  CHECK(machine.act(ComponentAction::stop, Cell::consumer).is_ok());
  CHECK(machine.act(ComponentAction::start, Cell::consumer).is_ok());
  CHECK_EQUAL(machine.life(), Life::running);
  CHECK(wait_until([&] { return machine.steps() > 5; }));
  CHECK(!machine.executive().control().may_move());
  CHECK(wait_until([&] { return machine.executive().control().start_motion().is_ok(); }));
  const Status again = machine.act(ComponentAction::start, Cell::consumer);
  CHECK_EQUAL(again.code(), StatusCode::not_permitted);
  CHECK_CONTAINS(again.cause(), "consumer runs already");
  CHECK(machine.executive().control().may_move());
}

void what_is_held_ends_with_the_unit() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  RunningCell running(cell);
  const std::uint16_t requester = running.add_requester();
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(Cell::producer).steps > 5; }));
  ParameterRequest request;
  request.kind = RequestKind::hold;
  request.component = Cell::producer;
  request.requester = requester;
  request.lease = new_lease_number();
  request.lease_sequence = 1;
  request.add_name(2);
  CHECK_EQUAL(running.ask(request).kind, AnswerKind::accepted);
  std::atomic<bool> stopped{false};
  running.executive().act(ComponentAction::stop, Cell::producer, [&](const Status&) { stopped = true; });
  CHECK(wait_until([&] { return stopped.load(); }));
  const auto lock = running.executive().cell().observe();
  for (const SlotRecord& slot : cell.application().slots) {
    if (std::strcmp(slot.name, "producer.runtime") != 0) continue;
    CHECK(slot.observer->newest() != nullptr);
    CHECK(!static_cast<const Settings*>(slot.observer->payload())->move);
    return;
  }
  CHECK(false);
}

void a_unit_without_an_actuator_stops_alone() {
  Machine machine;
  CHECK(machine.act(ComponentAction::stop, Cell::producer).is_ok());
  CHECK_EQUAL(machine.cell.unit_state(Cell::producer).life.load(), Life::stopped);
  CHECK_EQUAL(machine.life(), Life::running);
  CHECK(machine.executive().control().may_move());
  CHECK(machine.act(ComponentAction::stop, Cell::producer).is_ok());
  CHECK_EQUAL(machine.cell.events().count_of("producer: stop"), 1U);
}

// [exec-74]
void a_unit_is_waited_for_as_long_as_its_step_does_not_hang() {
  std::atomic<bool> is_long{false};
  std::atomic<bool> steps{false};
  std::atomic<bool> stopped_within_a_step{false};
  Machine machine([&](Cell& cell) {
    cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick&) {
      if (!is_long) return;
      steps = true;
      while (cell.unit_state(Cell::producer).ownership != Ownership::asked_back) usleep(1000);
      usleep(1'200'000);
      steps = false;
    };
    cell.unit(Cell::producer).script.stop = [&](TestUnit&) { stopped_within_a_step = steps.load(); };
  });
  is_long = true;
  CHECK(machine.act(ComponentAction::stop, Cell::producer).is_ok());
  CHECK_EQUAL(machine.cell.unit_state(Cell::producer).life.load(), Life::stopped);
  CHECK(!stopped_within_a_step);
}

// [exec-43] [exec-46] [exec-47]
void a_device_stops_after_its_unit_and_starts_before_it() {
  Machine machine;
  const Events& events = machine.cell.events();
  CHECK(machine.act(ComponentAction::stop, actuator).is_ok());
  CHECK_EQUAL(machine.life(), Life::stopped);
  CHECK(events.place_of("consumer: stop") < events.place_of("actuator: stop"));
  CHECK(machine.act(ComponentAction::start, Cell::consumer).is_ok());
  CHECK_EQUAL(machine.life(), Life::running);
  CHECK_EQUAL(machine.cell.device_state(Cell::actuator).life.load(), Life::running);
  CHECK(machine.act(ComponentAction::initialise, actuator).is_ok());
  CHECK_EQUAL(machine.life(), Life::running);
  CHECK_EQUAL(events.count_of("actuator: initialise"), 3U);
  CHECK_EQUAL(events.count_of("consumer: initialise"), 3U);
}

// [exec-85]
void the_ports_of_a_device_begin_anew_when_it_is_initialised() {
  std::atomic<int> news{0};
  std::atomic<int> looks{0};
  Machine machine([&](Cell& cell) {
    cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
      if (tick.number == 0) unit.outputs[0].publish(Item{7, 0});
    };
    cell.unit(Cell::consumer).script.step = {};
    cell.device(Cell::actuator).reads = Cell::values;
    cell.device(Cell::actuator).script.receive = [&](TestDevice& self, const Tick&) {
      news += self.input.latest().is_new() ? 1 : 0;
      ++looks;
    };
  });
  const Component& device = machine.executive().cell().component(actuator);
  CHECK(wait_until([&] { return news == 1; }));
  CHECK_EQUAL(device.input_counters(0, 0).read, 1U);
  CHECK(machine.act(ComponentAction::initialise, actuator).is_ok());
  CHECK(wait_until([&] { return news == 2; }));
  CHECK_EQUAL(device.input_counters(0, 0).read, 1U);
  const int before = looks;
  CHECK(wait_until([&] { return looks > before + 5; }));
  CHECK_EQUAL(news.load(), 2);
}

// [exec-62]
void a_bus_stops_after_what_it_carries_and_starts_before_it() {
  constexpr ComponentIndex bus = 3;
  constexpr ComponentIndex trunk = 4;
  Machine machine([](Cell& cell) {
    cell.device(Cell::actuator).bus = cell.add(DevicePlan{.name = "bus", .script = {}, .actuates = false});
    cell.device(1).bus = cell.add(DevicePlan{.name = "trunk", .script = {}, .actuates = false});
    cell.thread(Cell::consuming).devices = {2, 1, Cell::actuator};
  });
  CHECK(machine.cell.events().place_of("trunk: initialise") <
        machine.cell.events().place_of("bus: initialise"));
  const auto events_of = [&](ComponentAction action, ComponentIndex component) {
    const std::size_t before = machine.cell.events().all().size();
    CHECK(machine.act(action, component).is_ok());
    std::vector<std::string> events = machine.cell.events().all();
    events.erase(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(before));
    return events;
  };
  CHECK(events_of(ComponentAction::stop, bus) ==
        (std::vector<std::string>{"consumer: stop", "actuator: stop", "bus: stop"}));
  CHECK(events_of(ComponentAction::start, Cell::consumer) ==
        (std::vector<std::string>{"bus: initialise", "actuator: initialise", "consumer: initialise"}));
  // A bus on a bus.
  CHECK(events_of(ComponentAction::stop, trunk) ==
        (std::vector<std::string>{"consumer: stop", "actuator: stop", "bus: stop", "trunk: stop"}));
  CHECK(events_of(ComponentAction::start, Cell::consumer) ==
        (std::vector<std::string>{"trunk: initialise", "bus: initialise", "actuator: initialise",
                                  "consumer: initialise"}));
}

/// A device that need not be there, away when a person initialises it: it and its unit are waited for, and a
/// person's Stop ends that.
// [exec-98] [exec-91]
void what_is_away_at_an_initialise_is_waited_for() {
  std::atomic<bool> is_away{false};
  Machine machine([&](Cell& cell) {
    cell.device(Cell::actuator).required = false;
    cell.device(Cell::actuator).script.initialise = [&](TestDevice&) {
      return is_away ? Status::error(StatusCode::not_found, "no such port") : Status{};
    };
  });
  is_away = true;
  const Status status = machine.act(ComponentAction::initialise, actuator);
  CHECK_CONTAINS(status.cause(), "actuator waits (driver mock): no such port");
  CHECK_EQUAL(machine.life(), Life::waiting);
  is_away = false;
  CHECK(wait_until([&] { return machine.life() == Life::running && machine.steps() > 0; }));
  is_away = true;
  CHECK(!machine.act(ComponentAction::initialise, actuator));
  // Values are taken meanwhile.
  CHECK(machine.reconfigure(Cell::consumer).outcome == ReconfigureOutcome::done);
  CHECK_EQUAL(machine.life(), Life::waiting);
  CHECK(machine.act(ComponentAction::stop, actuator).is_ok());
  is_away = false;
  const std::size_t tried = machine.cell.events().count_of("actuator: initialise");
  usleep(700'000);
  CHECK_EQUAL(machine.cell.events().count_of("actuator: initialise"), tried);
  CHECK_EQUAL(machine.life(), Life::stopped);
  CHECK_EQUAL(machine.running->finish().exit_code, 0);
}

// [exec-48] [exec-49]
void after_a_fault_initialise_constructs_it_anew() {
  std::atomic<bool> fails{true};
  Machine machine([&](Cell& cell) {
    cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
      if (fails && tick.number == 10) unit.fail(Status::error(StatusCode::device_fault, "slipped"));
    };
  });
  CHECK(wait_until([&] { return machine.life() == Life::fault; }));
  fails = false;
  CHECK(machine.act(ComponentAction::initialise, Cell::consumer).is_ok());
  CHECK_EQUAL(machine.life(), Life::running);
  CHECK_EQUAL(machine.cell.events().count_of("consumer: destroy"), 1U);
  CHECK(!machine.executive().control().may_move());
}

/// Whoever asks goes on, also where what he asked for takes its time.
// [exec-72]
void nobody_waits_for_what_he_asked_for() {
  std::atomic<bool> is_long{false};
  std::atomic<bool> let_go{false};
  Machine machine([&](Cell& cell) {
    cell.unit(Cell::producer).script.initialise = [&](TestUnit&) {
      while (is_long && !let_go) usleep(1000);
      return Status{};
    };
  });
  is_long = true;
  std::vector<std::string> threads;
  std::atomic<int> answers{0};
  const auto note = [&] {
    char name[16] = "";
    pthread_getname_np(pthread_self(), name, sizeof(name));
    threads.emplace_back(name);
    ++answers;
  };
  machine.executive().act(ComponentAction::initialise, Cell::producer, [&](const Status&) { note(); });
  machine.executive().reconfigure({{Cell::producer, "offset", "0.75"}},
                                  [&](const ReconfigureResult&) { note(); });
  CHECK_EQUAL(answers.load(), 0);
  let_go = true;
  CHECK(wait_until([&] { return answers == 2; }));
  CHECK(threads == (std::vector<std::string>{"lifecycle", "lifecycle"}));
}

void what_fails_says_why() {
  std::atomic<bool> fails{false};
  Machine machine([&](Cell& cell) {
    cell.unit(Cell::producer).script.initialise = [&](TestUnit&) {
      return fails ? Status::error(StatusCode::unavailable, "no cable") : Status{};
    };
  });
  fails = true;
  const Status status = machine.act(ComponentAction::initialise, Cell::producer);
  CHECK_CONTAINS(status.cause(), "producer: initialise: no cable");
  CHECK_EQUAL(machine.cell.unit_state(Cell::producer).life.load(), Life::fault);
  CHECK_EQUAL(machine.act(ComponentAction::stop, 99).code(), StatusCode::not_found);
}

// [exec-50]
void what_moves_is_named() {
  std::atomic<bool> idle{false};
  Machine machine([&](Cell& cell) {
    cell.unit(Cell::consumer).script.is_idle = [&](const TestUnit&) { return idle.load(); };
  });
  Executive& executive = machine.executive();
  CHECK(wait_until([&] {
    return executive.moving() == std::vector<ComponentIndex>{Cell::consumer, actuator};
  }));
  executive.control().stop_motion();
  CHECK(wait_until([&] { return executive.moving() == std::vector<ComponentIndex>{Cell::consumer}; }));
  idle = true;
  CHECK(wait_until([&] { return executive.moving().empty(); }));
}

/// Nobody commands it any more, and it is not at rest yet.
// [exec-63]
void what_a_fault_has_not_made_safe_moves() {
  std::atomic<bool> is_safe{false};
  Machine machine([&](Cell& cell) {
    cell.device(Cell::actuator).script.make_safe = [&](TestDevice&) { return is_safe.load(); };
    cell.unit(Cell::consumer).script.step = [](TestUnit& unit, const Tick& tick) {
      if (tick.number == 10) unit.fail(Status::error(StatusCode::device_fault, "slipped"));
    };
  });
  CHECK(wait_until([&] { return machine.cell.events().count_of("actuator: make_safe") > 0; }));
  CHECK(machine.executive().moving() == std::vector<ComponentIndex>{actuator});
  is_safe = true;
  CHECK(wait_until([&] { return machine.executive().moving().empty(); }));
}

void what_a_change_initialises_again_is_known_before() {
  Machine machine;
  const ComponentIndex changed[] = {actuator, Cell::producer};
  CHECK(machine.executive().owners_of(changed) ==
        (std::vector<ComponentIndex>{Cell::consumer, Cell::producer, actuator}));
}

// [exec-42]
void a_reconfiguration_answers_later() {
  Machine machine;
  const std::uint64_t before = machine.executive().cell().configuration_revision();
  const ReconfigureResult result = machine.reconfigure(Cell::consumer);
  CHECK_EQUAL(result.outcome, ReconfigureOutcome::done);
  CHECK(result.owners == std::vector<std::uint16_t>{Cell::consumer});
  CHECK(machine.executive().cell().configuration_revision() > before);
  Configuration values{};
  CHECK_EQUAL(machine.executive().cell().copy_configuration(Cell::consumer, &values, sizeof(values)),
              sizeof(values));
  CHECK_EQUAL(values.offset, 0.75);
}

/// Whoever commands an actuator may follow from afar what was initialised anew.
// [exec-61] [stop-76]
void after_a_reconfiguration_nothing_moves_before_start() {
  for (const ComponentIndex component : {Cell::consumer, Cell::producer}) {
    Machine machine;
    CHECK(machine.executive().control().may_move());
    CHECK_EQUAL(machine.reconfigure(component).outcome, ReconfigureOutcome::done);
    CHECK_EQUAL(machine.life(), Life::running);
    CHECK(!machine.executive().control().may_move());
    // Its thread sees that first.
    CHECK(wait_until([&] { return machine.executive().control().start_motion().is_ok(); }));
  }
}

/// Whoever looks may take as long as he likes.
// [exec-77]
void nobody_waits_for_who_observes() {
  Machine machine;
  const auto lock = machine.executive().cell().observe();
  const std::uint64_t before = machine.steps();
  const std::uint64_t produced = machine.cell.unit_state(Cell::producer).steps;
  CHECK(wait_until([&] {
    return machine.steps() > before + 20 && machine.cell.unit_state(Cell::producer).steps > produced + 20;
  }));
}

// [exec-78]
void what_is_declared_of_a_component_is_known_without_its_object() {
  Machine machine;
  const flexrf::Cell& cell = machine.executive().cell();
  CHECK(cell.component_type(Cell::consumer).runtime.type == &settings_type);
  CHECK_EQUAL(std::string{cell.component_type(actuator).name}, std::string{TestDevice::type.name});
}

// [exec-51]
void after_the_end_everything_is_refused() {
  Machine machine;
  machine.executive().request_end();
  const RunSummary summary = machine.running->join();
  CHECK_EQUAL(summary.exit_code, 0);
  CHECK_EQUAL(summary.cause, EndCause::requested);
  CHECK_EQUAL(machine.act(ComponentAction::start, Cell::consumer).code(), StatusCode::not_permitted);
  const ReconfigureResult result = machine.executive().reconfigure({{Cell::consumer, "offset", "0.75"}});
  CHECK_EQUAL(result.outcome, ReconfigureOutcome::refused);
  CHECK_CONTAINS(result.causes.at(0), "the application has ended");
}

void a_narrowed_range_is_enforced() {
  Cell cell;
  const NarrowedRange ranges[] = {{Cell::producer, ParameterKind::runtime, "gain", 2, 3},
                                  {Cell::producer, ParameterKind::configuration, "offset", 0, 1}};
  Application application = cell.application();
  application.ranges = ranges;
  Executive executive(application, on_the_wall_clock());
  CHECK(executive.prepare().is_ok());
  const auto set_gain = [&](ComponentIndex component, double gain) {
    ParameterRequest request;
    request.component = component;
    request.add(0, 0, &gain, sizeof(gain));
    return executive.cell().parameters(component).apply(request, Time{}).kind;
  };
  CHECK_EQUAL(set_gain(Cell::producer, 2.5), AnswerKind::accepted);
  CHECK_EQUAL(set_gain(Cell::producer, 3.5), AnswerKind::refused);
  CHECK_EQUAL(set_gain(Cell::consumer, 3.5), AnswerKind::accepted);
  const ComponentType& type = executive.cell().component_type(Cell::producer);
  CHECK(type.configuration.parameters[0].has_range);
  CHECK_EQUAL(type.runtime.parameters[0].minimum, 2.0);
  CHECK_EQUAL(&executive.cell().component_type(Cell::consumer), &TestUnit::type);
}

}  // namespace
}  // namespace flexrf::fixture::action_test

int main() {
  using namespace flexrf::fixture::action_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_unit_that_owns_an_actuator_comes_to_rest_before_it_is_stopped),
      CONTAINED_TEST(who_does_not_come_to_rest_has_its_devices_made_safe),
      CONTAINED_TEST(what_is_started_again_waits_for_start),
      CONTAINED_TEST(what_is_held_ends_with_the_unit),
      CONTAINED_TEST(a_unit_without_an_actuator_stops_alone),
      CONTAINED_TEST(a_unit_is_waited_for_as_long_as_its_step_does_not_hang),
      CONTAINED_TEST(a_device_stops_after_its_unit_and_starts_before_it),
      CONTAINED_TEST(the_ports_of_a_device_begin_anew_when_it_is_initialised),
      CONTAINED_TEST(a_bus_stops_after_what_it_carries_and_starts_before_it),
      CONTAINED_TEST(what_is_away_at_an_initialise_is_waited_for),
      CONTAINED_TEST(after_a_fault_initialise_constructs_it_anew),
      CONTAINED_TEST(nobody_waits_for_what_he_asked_for),
      CONTAINED_TEST(what_fails_says_why),
      CONTAINED_TEST(what_moves_is_named),
      CONTAINED_TEST(what_a_fault_has_not_made_safe_moves),
      CONTAINED_TEST(what_a_change_initialises_again_is_known_before),
      CONTAINED_TEST(a_reconfiguration_answers_later),
      CONTAINED_TEST(after_a_reconfiguration_nothing_moves_before_start),
      CONTAINED_TEST(nobody_waits_for_who_observes),
      CONTAINED_TEST(what_is_declared_of_a_component_is_known_without_its_object),
      CONTAINED_TEST(after_the_end_everything_is_refused),
      CONTAINED_TEST(a_narrowed_range_is_enforced),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
