// What one step may rely on: order within the thread, one consistent input, parameters that change between
// steps only.
#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::step_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

// [exec-1]
void units_step_in_the_order_of_the_thread() {
  TestApplication cell;
  std::vector<int> order;
  for (int i = 0; i < 5; ++i) {
    UnitPlan unit;
    unit.name = "unit" + std::to_string(i);
    unit.parameters = false;
    unit.script.step = [&order, i](TestUnit&, const Tick& tick) {
      if (!tick.stop_requested) order.push_back(i);
    };
    cell.add(std::move(unit));
  }
  // Not the order of the units' own table.
  cell.add(ThreadPlan{.name = "all",
                      .trigger = TriggerPlan::periodic(milliseconds{1}),
                      .units = {3, 0, 4, 1, 2},
                      .devices = {}});
  Executive executive(cell.application(), in_virtual_time(milliseconds{10}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK_EQUAL(order.size(), 50U);
  for (std::size_t i = 0; i < order.size(); ++i) CHECK_EQUAL(order[i], (std::array{3, 0, 4, 1, 2}[i % 5]));
}

// [exec-59] [exec-60]
void a_bus_receives_before_what_it_carries_and_sends_after_it() {
  Cell cell;
  const std::uint16_t bus = cell.add(DevicePlan{.name = "bus", .script = {}, .actuates = false});
  cell.device(Cell::actuator).bus = bus;
  cell.thread(Cell::consuming).devices = {bus, Cell::actuator};
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  std::vector<std::string> acts;
  for (const std::uint16_t device : {bus, std::uint16_t{Cell::actuator}}) {
    DeviceScript& script = cell.device(device).script;
    script.receive = [&](TestDevice& self, const Tick&) {
      acts.push_back(self.name() + std::string{": receive"});
    };
    script.send = [&](TestDevice& self, const Tick&) { acts.push_back(self.name() + std::string{": send"}); };
    script.make_safe = [&](TestDevice& self) {
      acts.push_back(self.name() + std::string{": make_safe"});
      return true;
    };
  }
  cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick&) { acts.push_back("step"); };
  Executive executive(cell.application(), in_virtual_time(milliseconds{10}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  using Acts = std::vector<std::string>;
  const Acts ordinary{"bus: receive", "actuator: receive", "step", "actuator: send", "bus: send"};
  const Acts safe{"bus: receive",   "actuator: receive", "actuator: make_safe",
                  "bus: make_safe", "actuator: send",    "bus: send"};
  CHECK(Acts(acts.begin(), acts.begin() + 5) == ordinary);
  CHECK(Acts(acts.end() - 6, acts.end()) == safe);
}

// [exec-3]
void a_step_sees_one_input_however_often_it_looks() {
  Cell cell;
  // The writer is much faster than the reader's step.
  cell.thread(Cell::producing).trigger = TriggerPlan::free_running();
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  std::atomic<int> torn{0};
  std::atomic<int> not_new{0};
  std::atomic<std::int64_t> seen{0};
  cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
    unit.outputs[0].publish(Item{static_cast<std::int64_t>(tick.number), static_cast<double>(tick.number)});
  };
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick&) {
    const View<Item> first = unit.inputs[0].latest();
    if (!first) return;
    const Item copy = *first;
    for (int i = 0; i < 200; ++i) {
      const View<Item> again = unit.inputs[0].latest();
      torn += again->number != copy.number || again.sequence() != first.sequence() ? 1 : 0;
      torn += static_cast<double>(again->number) != again->value ? 1 : 0;
      not_new += again.is_new() != first.is_new() ? 1 : 0;
    }
    ++seen;
  };
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return seen > 200; }));
  CHECK_EQUAL(running.finish().exit_code, 0);
  CHECK_EQUAL(torn.load(), 0);
  CHECK_EQUAL(not_new.load(), 0);
}

void units_of_one_thread_share_the_latch_of_their_own_steps() {
  // Two readers in one thread: each has its own cursor, both the same buffer.
  Cell cell;
  UnitPlan second;
  second.name = "second";
  second.inputs = {InputPlan{.slot = Cell::values}};
  std::vector<std::int64_t> first_seen;
  std::vector<std::int64_t> second_seen;
  second.script.step = [&](TestUnit& unit, const Tick& tick) {
    const View<Item> view = unit.inputs[0].latest();
    if (!tick.stop_requested && view) second_seen.push_back(view->number);
  };
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
    const View<Item> view = unit.inputs[0].latest();
    if (!tick.stop_requested && view) first_seen.push_back(view->number);
  };
  cell.thread(Cell::consuming).units.push_back(cell.add(std::move(second)));
  Executive executive(cell.application(), in_virtual_time(milliseconds{20}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK_EQUAL(first_seen.size(), 20U);
  CHECK(first_seen == second_seen);
}

// [exec-83]
void each_call_of_a_device_is_a_step_to_its_ports() {
  TestApplication cell;
  const std::uint16_t values = cell.add(SlotPlan{.name = "values"});
  const std::uint16_t device =
      cell.add(DevicePlan{.name = "sensor", .script = {}, .actuates = false, .reads = values});
  std::vector<std::int64_t> received, commanded, sent;
  int differing = 0;
  const auto look = [&differing](TestDevice& self, std::vector<std::int64_t>& seen) {
    const View<Item> view = self.input.latest();
    const View<Item> again = self.input.latest();
    differing += again.sequence() != view.sequence() || again.is_new() != view.is_new() ? 1 : 0;
    // A tenth more: it is new.
    seen.push_back(view ? view->number * 10 + (view.is_new() ? 1 : 0) : -1);
  };
  cell.device(device).script.receive = [&](TestDevice& self, const Tick&) { look(self, received); };
  cell.device(device).script.send = [&](TestDevice& self, const Tick&) { look(self, sent); };
  UnitPlan unit;
  unit.name = "writer";
  unit.parameters = false;
  unit.outputs = {values};
  unit.device = device;
  unit.script.step = [&](TestUnit& self, const Tick& tick) {
    look(*self.device, commanded);
    self.outputs[0].publish(Item{static_cast<std::int64_t>(tick.number), 0});
  };
  const std::uint16_t writer = cell.add(std::move(unit));
  cell.add(ThreadPlan{.name = "all",
                      .trigger = TriggerPlan::periodic(milliseconds{1}),
                      .units = {writer},
                      .devices = {device}});
  Executive executive(cell.application(), in_virtual_time(milliseconds{4}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK(received.size() >= 4 && commanded.size() >= 4 && sent.size() >= 4);
  const auto first_four = [](std::vector<std::int64_t> seen) {
    seen.resize(4);
    return seen;
  };
  // What its unit published it sees in send(), and in the next cycle knows it.
  using Seen = std::vector<std::int64_t>;
  CHECK((first_four(received) == Seen{-1, 0, 10, 20}));
  CHECK((first_four(commanded) == Seen{-1, 0, 10, 20}));
  CHECK((first_four(sent) == Seen{1, 11, 21, 31}));
  CHECK_EQUAL(differing, 0);
}

ParameterRequest set_gain(std::uint16_t component, double gain) {
  ParameterRequest request;
  request.component = component;
  request.add(0, 0, &gain, sizeof(gain));
  return request;
}

// [exec-2]
void requests_are_applied_between_steps_and_answered() {
  Cell cell;
  std::atomic<int> changed_within{0};
  std::atomic<double> gain{0};
  cell.unit(Cell::producer).script.accept = [](const Settings& proposed) {
    if (proposed.gain == 7) return Status::error(StatusCode::invalid_argument, "seven is taken");
    return Status{};
  };
  cell.unit(Cell::producer).script.step = [&](TestUnit& unit, const Tick&) {
    const double before = unit.runtime.gain;
    const Time until = MonotonicClock::now() + microseconds{20};
    while (MonotonicClock::now() < until) {
    }
    changed_within += unit.runtime.gain != before ? 1 : 0;
    gain = unit.runtime.gain;
  };
  RunningCell running(cell);
  const std::uint16_t me = running.add_requester();
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(Cell::producer).steps > 3; }));
  CHECK_EQUAL(gain.load(), 1.0);
  for (int i = 0; i < 50; ++i) {
    ParameterRequest request = set_gain(Cell::producer, i % 6);
    request.requester = me;
    request.correlation = static_cast<std::uint64_t>(i);
    const ParameterAnswer answer = running.ask(request);
    CHECK_EQUAL(answer.kind, AnswerKind::accepted);
    CHECK_EQUAL(answer.correlation, static_cast<std::uint64_t>(i));
  }
  ParameterRequest request = set_gain(Cell::producer, 11);
  request.requester = me;
  ParameterAnswer answer = running.ask(request);
  CHECK_EQUAL(answer.kind, AnswerKind::refused);
  CHECK_CONTAINS(answer.reason, "11");
  request = set_gain(Cell::producer, 7);
  request.requester = me;
  answer = running.ask(request);
  CHECK_EQUAL(answer.kind, AnswerKind::refused);
  CHECK_CONTAINS(answer.reason, "seven is taken");
  request = set_gain(99, 1);
  request.requester = me;
  CHECK_EQUAL(running.ask(request).kind, AnswerKind::refused);
  CHECK(wait_until([&] { return gain == 1.0; }));  // 49 % 6
  CHECK_EQUAL(running.finish().exit_code, 0);
  CHECK_EQUAL(changed_within.load(), 0);
}

// [exec-2]
void a_sleeping_thread_serves_requests_without_a_step() {
  Cell cell;
  cell.unit(Cell::producer).script.step = {};  // so that the consumer is never released
  RunningCell running(cell);
  const std::uint16_t me = running.add_requester();
  running.start();
  CHECK(wait_until([&] { return running.control().mode() == Mode::running; }));
  ParameterRequest request = set_gain(Cell::consumer, 3);
  request.requester = me;
  CHECK_EQUAL(running.ask(request).kind, AnswerKind::accepted);
  CHECK_EQUAL(cell.unit_state(Cell::consumer).steps.load(), 0U);
  CHECK_EQUAL(running.finish().exit_code, 0);
}

// [exec-5]
void a_button_counts_presses_since_the_last_step() {
  Cell cell;
  Executive executive(cell.application(), in_virtual_time(milliseconds{20}));
  std::vector<std::uint32_t> presses;
  cell.unit(Cell::producer).script.step = [&](TestUnit& unit, const Tick& tick) {
    if (tick.stop_requested) return;
    presses.push_back(unit.runtime.kick);
    ParameterRequest request;
    request.kind = RequestKind::press;
    request.component = Cell::producer;
    request.add_presses(1);
    for (std::uint64_t i = 0; i < tick.number % 3; ++i) executive.cell().send(request);
  };
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK_EQUAL(presses.size(), 20U);
  for (std::size_t i = 0; i < presses.size(); ++i) CHECK_EQUAL(presses[i], i == 0 ? 0 : (i - 1) % 3);
}

// [exec-4]
void feedback_is_published_after_the_step() {
  Cell cell;
  Executive executive(cell.application(), in_virtual_time(milliseconds{20}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  for (const SlotRecord& slot : cell.application().slots) {
    if (std::string_view{slot.name} != "producer.feedback") continue;
    CHECK_EQUAL(slot.control->published(), cell.unit_state(Cell::producer).steps.load());
    const ItemHeader* header = slot.observer->newest();
    CHECK(header != nullptr);
    CHECK_EQUAL(static_cast<const Readings*>(slot.observer->payload())->steps, header->sequence);
    return;
  }
  CHECK(false);
}

/// Who steps when, while somebody asks, and only then.
void steps_are_traced_while_somebody_asks() {
  Cell cell;
  RunningCell running(cell);
  flexrf::Cell& inside = running.executive().cell();
  inside.keep_step_traces();
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(Cell::producer).steps > 5; }));
  std::vector<TracedStep> steps(StepTrace::most);
  const StepTrace& trace = inside.step_traces()->of(Cell::producing);
  CHECK_EQUAL(trace.copy(Time{}, steps).count, 0U);
  const Time asked_at = MonotonicClock::now();
  inside.step_traces()->ask(asked_at + std::chrono::seconds{60});
  CHECK(wait_until([&] { return trace.copy(Time{}, steps).count > 5; }));
  inside.step_traces()->ask(Time{});
  const std::size_t count = trace.copy(Time{}, steps).count;
  for (std::size_t i = 0; i < count; ++i) {
    CHECK_EQUAL(steps[i].unit, Cell::producer);
    CHECK(steps[i].begin >= asked_at - std::chrono::seconds{1} && steps[i].took.count() >= 0);
    if (i > 0) CHECK(steps[i].begin >= steps[i - 1].begin + steps[i - 1].took);
  }
  CHECK_EQUAL(running.finish().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::fixture::step_test

int main() {
  using namespace flexrf::fixture::step_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(units_step_in_the_order_of_the_thread),
      CONTAINED_TEST(a_bus_receives_before_what_it_carries_and_sends_after_it),
      CONTAINED_TEST(a_step_sees_one_input_however_often_it_looks),
      CONTAINED_TEST(units_of_one_thread_share_the_latch_of_their_own_steps),
      CONTAINED_TEST(each_call_of_a_device_is_a_step_to_its_ports),
      CONTAINED_TEST(requests_are_applied_between_steps_and_answered),
      CONTAINED_TEST(a_sleeping_thread_serves_requests_without_a_step),
      CONTAINED_TEST(a_button_counts_presses_since_the_last_step),
      CONTAINED_TEST(feedback_is_published_after_the_step),
      CONTAINED_TEST(steps_are_traced_while_somebody_asks),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
