// A run in virtual time depends on nothing but tables, seed and input.
#include <random>
#include <string>
#include <utility>

#include "runtime/executive/tests/running_cell.hpp"
#include "runtime/log/log.hpp"

namespace flexrf::fixture::determinism_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

struct Outcome {
  std::uint64_t digest;
  double position;
};

/// Noise from the device's seed reaches what is published; several threads of different rhythm take part.
Outcome run_with_seed(std::uint64_t seed, bool busy_host = false) {
  Cell cell;
  const std::uint16_t measured = cell.add(SlotPlan{.name = "measured"});
  cell.device(Cell::actuator).output = measured;
  cell.unit(Cell::producer).inputs = {InputPlan{.slot = measured}};
  std::mt19937_64 random;
  double position = 0;
  cell.device(Cell::actuator).script.initialise = [&](TestDevice& device) {
    random.seed(device.environment().seed);
    return Status{};
  };
  cell.device(Cell::actuator).script.send = [&](TestDevice& device, const Tick&) {
    position = device.position + 1e-6 * static_cast<double>(random() % 1000);
    device.output.publish(Item{device.moves, position});
  };
  cell.thread(Cell::consuming).trigger.min_interval = microseconds{1500};
  UnitPlan other;
  other.name = "other";
  other.inputs = {InputPlan{.slot = measured}, InputPlan{.slot = Cell::values}};
  other.script.step = [busy_host](TestUnit& unit, const Tick&) {
    const View<Item> view = unit.inputs[0].latest();
    if (view) unit.feedback = {view.sequence(), view->value};
    const Time until = MonotonicClock::now() + microseconds{busy_host ? 30 : 0};
    while (MonotonicClock::now() < until) {
    }
  };
  ThreadPlan thread;
  thread.name = "watching";
  thread.trigger = TriggerPlan::periodic(microseconds{700});
  thread.units = {cell.add(std::move(other))};
  cell.add(std::move(thread));
  Executive executive(cell.application(), in_virtual_time(milliseconds{500}, seed));
  const RunSummary summary = run_to_the_end(executive);
  CHECK_EQUAL(summary.exit_code, 0);
  CHECK(summary.digest.has_value());
  return {*summary.digest, position};
}

// [exec-54]
void two_runs_have_the_same_digest() {
  const Outcome first = run_with_seed(1);
  const Outcome second = run_with_seed(1);
  CHECK_EQUAL(first.digest, second.digest);
  CHECK_EQUAL(first.position, second.position);
}

// [exec-52] [exec-54]
void however_long_steps_take_on_this_machine() {
  CHECK_EQUAL(run_with_seed(1).digest, run_with_seed(1, true).digest);
}

void another_seed_changes_a_value_not_just_the_digest() {
  const Outcome first = run_with_seed(1);
  const Outcome second = run_with_seed(2);
  CHECK(first.digest != second.digest);
  CHECK(first.position != second.position);
}

/// Digest of a run whose producer publishes this number in step 7.
std::uint64_t digest_with(std::int64_t number, bool wall) {
  Cell cell;
  cell.slot(Cell::values).wall = wall;
  cell.unit(Cell::producer).script.step = [number](TestUnit& unit, const Tick& tick) {
    unit.outputs[0].publish(Item{tick.number == 7 ? number : 0, 0});
  };
  cell.unit(Cell::consumer).script.step = {};
  Executive executive(cell.application(), in_virtual_time(milliseconds{20}));
  const RunSummary summary = run_to_the_end(executive);
  CHECK(summary.digest.has_value());
  return *summary.digest;
}

// [exec-55]
void one_value_changes_the_digest() {
  CHECK_EQUAL(digest_with(1, false), digest_with(1, false));
  CHECK(digest_with(1, false) != digest_with(2, false));
}

// [exec-55]
void what_is_marked_wall_does_not() {
  CHECK_EQUAL(digest_with(1, true), digest_with(2, true));
}

/// A cell of periodic threads with one unit each, whose steps tell who began when.
struct Rivals : TestApplication {
  struct Begun {
    std::string who;
    Duration at;
  };
  void add_thread(const std::string& name, std::uint8_t priority, const std::vector<Duration>& budgets) {
    ThreadPlan thread;
    thread.name = name;
    thread.trigger = TriggerPlan::periodic(milliseconds{1});
    thread.priority = priority;
    for (const Duration budget : budgets) {
      UnitPlan unit;
      unit.name = name + std::to_string(thread.units.size());
      unit.budget = budget;
      unit.parameters = false;
      unit.script.step = [this, who = unit.name](TestUnit&, const Tick& tick) {
        if (!tick.stop_requested) begun.push_back({who, tick.now - Time{std::chrono::seconds{1}}});
      };
      thread.units.push_back(TestApplication::add(std::move(unit)));
    }
    TestApplication::add(std::move(thread));
  }
  /// In the first three milliseconds.
  std::string all() {
    Executive executive(application(), in_virtual_time(milliseconds{3}));
    CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
    std::string text;
    for (const Begun& one : begun) text += one.who + "@" + std::to_string(one.at / microseconds{1}) + " ";
    return text;
  }
  std::vector<Begun> begun;
};

// [exec-64]
void at_one_instant_priority_counts_and_then_the_order_of_the_table() {
  Rivals cell;
  cell.add_thread("low", 10, {microseconds{50}});
  cell.add_thread("high", 20, {microseconds{50}});
  cell.add_thread("other", 20, {microseconds{50}});
  CHECK_EQUAL(cell.all(),
              "high0@0 other0@0 low0@0 high0@1000 other0@1000 low0@1000 high0@2000 other0@2000 low0@2000 ");
}

/// Whoever is released when a step's budget is over sees what it published.
// [exec-53] [exec-64]
void what_is_completed_at_an_instant_is_there_for_who_is_released_in_it() {
  Cell cell;
  cell.thread(Cell::producing).priority = 1;
  cell.thread(Cell::consuming).priority = 40;
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  // By the table, too, it is the reader's turn first.
  std::swap(cell.thread(Cell::producing), cell.thread(Cell::consuming));
  cell.unit(Cell::producer).budget = milliseconds{1};
  std::vector<std::int64_t> seen;
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
    const View<Item> view = unit.inputs[0].latest();
    if (!tick.stop_requested) seen.push_back(view ? view->number : -1);
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{4}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK((seen == std::vector<std::int64_t>{-1, 0, 1, 2}));
}

// [exec-84]
void what_a_unit_has_its_device_publish_is_visible_with_its_own() {
  TestApplication cell;
  const std::uint16_t values = cell.add(SlotPlan{.name = "values"});
  const std::uint16_t device =
      cell.add(DevicePlan{.name = "sensor", .script = {}, .actuates = false, .output = values});
  UnitPlan first;
  first.name = "first";
  first.parameters = false;
  first.budget = microseconds{300};
  first.device = device;
  first.script.step = [](TestUnit& self, const Tick&) { self.device->output.publish(Item{}); };
  UnitPlan second;
  second.name = "second";
  second.parameters = false;
  second.budget = microseconds{400};
  std::vector<std::int64_t> seen;
  UnitPlan watcher;
  watcher.name = "watcher";
  watcher.parameters = false;
  watcher.inputs = {InputPlan{.slot = values}};
  watcher.script.step = [&seen](TestUnit&, const Tick& tick) {
    seen.push_back((tick.now - Time{std::chrono::seconds{1}}) / microseconds{1});
  };
  const std::vector<std::uint16_t> units{cell.add(std::move(first)), cell.add(std::move(second))};
  const std::vector<std::uint16_t> watchers{cell.add(std::move(watcher))};
  cell.add(ThreadPlan{.name = "working",
                      .trigger = TriggerPlan::periodic(milliseconds{1}),
                      .units = units,
                      .devices = {device}});
  cell.add(ThreadPlan{
      .name = "watching", .trigger = TriggerPlan::on_slots({values}), .units = watchers, .devices = {}});
  Executive executive(cell.application(), in_virtual_time(milliseconds{3}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  // The device is served for 1 us before.
  CHECK(seen.size() >= 3);
  CHECK_EQUAL(seen[0], 301);
  CHECK_EQUAL(seen[1], 1301);
  CHECK_EQUAL(seen[2], 2301);
}

// [exec-65] [exec-81]
void units_of_a_thread_take_turns_and_threads_have_a_cpu_each() {
  Rivals cell;
  cell.add_thread("first", 20, {microseconds{300}, microseconds{400}});
  cell.add_thread("second", 10, {microseconds{900}});
  CHECK_EQUAL(cell.all(),
              "first0@0 second0@0 first1@300 first0@1000 second0@1000 first1@1300 first0@2000 second0@2000 "
              "first1@2300 ");
}

void observing_changes_nothing() {
  const auto digest = [](bool observe) {
    Cell cell;
    Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
    const SlotRecord& slot = cell.application().slots[Cell::values];
    cell.unit(Cell::consumer).script.step = [&, observe](TestUnit& unit, const Tick&) {
      if (observe) slot.observer->newest();
      while (unit.jobs.pop()) ++unit.memory;
      unit.feedback.steps = static_cast<std::uint64_t>(unit.memory);
    };
    return *run_to_the_end(executive).digest;
  };
  CHECK_EQUAL(digest(false), digest(true));
}

/// The lines of a run of 2.5 s in which something is said every millisecond, once a second at most, from
/// before its beginning until after its end.
std::string log_of_a_run() {
  const auto lines_after = [](std::uint64_t number, std::string* text) {
    while (drain_log(-1) > 0) {
    }
    return visit_recent_log(number, text, [](void* all, std::uint64_t, std::string_view line) {
      if (all != nullptr) *static_cast<std::string*>(all) += std::string{line} + "\n";
    });
  };
  const std::uint64_t before = lines_after(0, nullptr);
  LogLimit limit;
  Cell cell;
  cell.unit(Cell::producer).script.step = [&limit](TestUnit&, const Tick&) {
    log_warning(limit, "producer", "again");
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{2500}));
  CHECK(executive.prepare().is_ok());
  log_warning(limit, "test", "before");
  executive.run();
  log_warning("test", "after");
  std::string text;
  lines_after(before, &text);
  return text;
}

void two_runs_say_the_same() {
  const std::string text = log_of_a_run();
  CHECK_EQUAL(text, log_of_a_run());
  CHECK_CONTAINS(text, "[   0.000000] warning test: before\n");
  CHECK_CONTAINS(text, "[   1.000000] warning producer: again (1000 more since)\n");
  CHECK_CONTAINS(text, "[   2.000000] warning producer: again (999 more since)\n");
  // The controlled stop took 10 ms.
  CHECK_CONTAINS(text, "[   2.510000] warning test: after\n");
}

}  // namespace
}  // namespace flexrf::fixture::determinism_test

int main() {
  using namespace flexrf::fixture::determinism_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(two_runs_have_the_same_digest),
      CONTAINED_TEST(however_long_steps_take_on_this_machine),
      CONTAINED_TEST(another_seed_changes_a_value_not_just_the_digest),
      CONTAINED_TEST(one_value_changes_the_digest),
      CONTAINED_TEST(what_is_marked_wall_does_not),
      CONTAINED_TEST(at_one_instant_priority_counts_and_then_the_order_of_the_table),
      CONTAINED_TEST(what_is_completed_at_an_instant_is_there_for_who_is_released_in_it),
      CONTAINED_TEST(what_a_unit_has_its_device_publish_is_visible_with_its_own),
      CONTAINED_TEST(units_of_a_thread_take_turns_and_threads_have_a_cpu_each),
      CONTAINED_TEST(observing_changes_nothing),
      CONTAINED_TEST(two_runs_say_the_same),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
