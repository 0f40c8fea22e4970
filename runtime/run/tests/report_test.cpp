#include "runtime/run/report.hpp"

#include "runtime/executive/executive.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "runtime/executive/tests/fixture.hpp"
#include "runtime/run/report_data.hpp"
#include "tests/log_ear.hpp"

namespace flexrf::fixture {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct Report {
  RunSummary summary;
  std::string text;
  std::string json;
};

Report report_of(TestApplication& cell, const Options& options) {
  Executive executive(cell.application(), options);
  CHECK(executive.prepare().is_ok());
  Report report{executive.run(), {}, {}};
  report.text = report_text(executive.cell(), report.summary);
  report.json = report_json(executive.cell(), report.summary);
  return report;
}

/// Less than was commanded: told in the log once while it lasts, counted, and read by whoever looks.
// [exec-24] [exec-26]
void a_restraint_is_told_once_while_it_lasts() {
  ProducerAndConsumer cell;
  const LogEar ear;
  Restraint seen;
  std::uint64_t step = 0;
  // In steps of 1 ms: from the 10th to the 100th with a step in between that is without, and again 2 s later.
  cell.unit(ProducerAndConsumer::producer).script.step = [&](TestUnit& unit, const Tick& tick) {
    const bool held = (step >= 10 && step <= 100 && step != 50) || step >= 2500;
    if (held && !tick.stop_requested) unit.restrain("a position above `highest` is not gone to", 12.5, 10);
    if (step == 60) seen = cell.unit_state(ProducerAndConsumer::producer).restraint.read();
    if (step == 2000)
      CHECK(cell.unit_state(ProducerAndConsumer::producer).restraint.read().reason == nullptr);
    ++step;
  };
  const Report report = report_of(cell, in_virtual_time(seconds{3}));
  CHECK_EQUAL(std::string{seen.reason}, "a position above `highest` is not gone to");
  CHECK_EQUAL(seen.asked, 12.5);
  CHECK_EQUAL(seen.given, 10.0);
  CHECK(ear.has_heard("producer: a position above `highest` is not gone to: 12.5 was asked for, 10 is done"));
  CHECK_EQUAL(cell.unit_state(ProducerAndConsumer::producer).restraint.count(), 2U);
  CHECK_CONTAINS(report.json, "\"restraints\": 2");
  CHECK_CONTAINS(report.text, "Warnings and errors in the log: ");
}

void an_ordinary_run_tells_all_and_ends_in_a_sentence() {
  ProducerAndConsumer cell;
  const Report report = report_of(cell, in_virtual_time(milliseconds{100}));
  CHECK_EQUAL(report.summary.exit_code, 0);
  CHECK_CONTAINS(report.text, "test_cell: 1");
  CHECK_CONTAINS(report.text, "of virtual time in ");
  CHECK_CONTAINS(report.text, "producing");
  CHECK_CONTAINS(report.text, "consumer.first");
  CHECK_CONTAINS(report.text, "\nCounts and times\n");
  CHECK_CONTAINS(report.text, "producer   steps  ");
  CHECK_CONTAINS(report.text, "Faults: none\n");
  CHECK_CONTAINS(report.text, "\nFinished: the virtual time asked for is over after 1");
  CHECK(report.text.ends_with(" ms.\n"));
}

/// Its steps take no time that a machine could keep, so whoever reads the run's times has to know.
// [exec-56]
void a_thread_without_a_budget_is_told_in_virtual_time() {
  ProducerAndConsumer with;
  const LogEar before;
  CHECK_CONTAINS(report_of(with, in_virtual_time(milliseconds{20})).text,
                 "  Simulated: each step lasts its declared budget.\n");
  CHECK(!before.has_heard("without a budget"));

  ProducerAndConsumer without;
  const LogEar ear;
  without.unit(ProducerAndConsumer::consumer).budget = Duration::zero();
  CHECK_CONTAINS(report_of(without, in_virtual_time(milliseconds{20})).text,
                 "  Simulated: each step lasts its declared budget; without one, as in consuming, 1 us.\n");
  CHECK(ear.has_heard(
      "1 of 2 threads have units without a budget, the first is consuming: in virtual time a step of "
      "those lasts 1 us"));
}

/// Given up for one that hangs, the application still has threads that run, and are in a step at times.
void a_thread_that_is_in_a_step_does_not_hang() {
  ProducerAndConsumer cell;
  Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
  CHECK(executive.prepare().is_ok());
  RunSummary summary = executive.run();
  summary.stuck = true;
  const Time now = MonotonicClock::now();
  const std::span<ThreadState> threads = executive.cell().application().thread_states;
  threads[ProducerAndConsumer::producing].step_began = nanoseconds(now - std::chrono::minutes{1});
  // As it will be for longer than any standstill of this test.
  threads[ProducerAndConsumer::consuming].step_began = nanoseconds(now + std::chrono::minutes{1});
  const ReportData data(executive.cell(), summary);
  CHECK(data.threads[ProducerAndConsumer::producing].hangs);
  CHECK_EQUAL(data.found.size(), 1U);
  CHECK_EQUAL(data.found[0].who + ": " + data.found[0].cause, "thread producing: its step does not return");
  CHECK(!data.threads[ProducerAndConsumer::consuming].hangs);
}

void readers_are_counted() {
  ProducerAndConsumer cell;
  // The consumer looks every third time only.
  cell.thread(ProducerAndConsumer::consuming).trigger =
      TriggerPlan::periodic(milliseconds{3}, milliseconds{1});
  Executive executive(cell.application(), in_virtual_time(milliseconds{300}));
  CHECK(executive.prepare().is_ok());
  const RunSummary summary = executive.run();
  const ReportData data(executive.cell(), summary);
  const std::span<const SlotInput> readers = data.statistics.slot(ProducerAndConsumer::values).readers;
  const std::uint64_t published = cell.slot_control(ProducerAndConsumer::values).published();
  CHECK_EQUAL(readers.size(), 1U);
  CHECK_EQUAL(readers[0].name, "consumer.first");
  const InputCounters seen = readers[0].counters();
  CHECK(seen.read >= 100 && seen.read <= data.statistics.component(ProducerAndConsumer::consumer).steps);
  // All but what came before the first and after the last reading.
  CHECK(seen.read + seen.missed <= published);
  CHECK(seen.read + seen.missed + 3 >= published);
  CHECK_CONTAINS(report_text(executive.cell(), summary),
                 "producer.out_first  consumer.first   " + std::to_string(seen.read));
}

void drops_of_queues_are_shown() {
  ProducerAndConsumer cell;
  cell.queue(ProducerAndConsumer::jobs).capacity = 4;
  cell.unit(ProducerAndConsumer::consumer).script.step = [](TestUnit&, const Tick&) {};
  const Report report = report_of(cell, in_virtual_time(milliseconds{20}));
  CHECK_CONTAINS(report.json,
                 "\"capacity\": 4,\n      \"fill\": 4,\n      \"writers\": [\n        {\n          \"name\": "
                 "\"producer.orders\",\n          \"pushed\": 4,\n          \"popped\": 0,\n");
  CHECK_CONTAINS(report.text, "producer.orders       4       0");
}

void a_fault_is_told_with_its_cause() {
  ProducerAndConsumer cell;
  cell.unit(ProducerAndConsumer::producer).script.step = [](TestUnit& unit, const Tick& tick) {
    if (tick.number == 5) unit.fail(Status::error(StatusCode::device_fault, "the \"arm\" is on fire"));
  };
  const Report report = report_of(cell, in_virtual_time(milliseconds{20}));
  CHECK_EQUAL(report.summary.exit_code, 2);
  CHECK_CONTAINS(report.text, "Faults: 1 in all\n  component  cause\n  producer   the \"arm\" is on fire\n");
  CHECK_CONTAINS(report.text, "\nFault: producer: the \"arm\" is on fire; ");
  CHECK_CONTAINS(report.json, "\"fault\": \"the \\\"arm\\\" is on fire\"");
}

void the_end_of_input_is_named() {
  ProducerAndConsumer cell;
  cell.device(ProducerAndConsumer::actuator).script.is_closed = [] { return true; };
  const Report report = report_of(cell, in_virtual_time(seconds{10}));
  CHECK_EQUAL(report.summary.exit_code, 0);
  CHECK_CONTAINS(report.text, "Finished: end of input after ");
  CHECK_CONTAINS(report.json, "\"cause\": \"end of input\"");
}

void on_the_wall_clock_units_are_measured() {
  ProducerAndConsumer cell;
  cell.device(ProducerAndConsumer::actuator).script.is_closed = [steps = 0]() mutable {
    return ++steps > 20;
  };
  const Report report = report_of(cell, on_the_wall_clock());
  CHECK_EQUAL(report.summary.exit_code, 0);
  CHECK_CONTAINS(report.text, "without real-time priorities");
  CHECK_CONTAINS(report.text, "execution");
  CHECK_CONTAINS(report.text, "p99.9");
  CHECK(report.json.find("response_estimate_ns\": 0") == std::string::npos);
}

}  // namespace
}  // namespace flexrf::fixture

int main() {
  using namespace flexrf::fixture;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_restraint_is_told_once_while_it_lasts),
      CONTAINED_TEST(an_ordinary_run_tells_all_and_ends_in_a_sentence),
      CONTAINED_TEST(a_thread_without_a_budget_is_told_in_virtual_time),
      CONTAINED_TEST(a_thread_that_is_in_a_step_does_not_hang),
      CONTAINED_TEST(readers_are_counted),
      CONTAINED_TEST(drops_of_queues_are_shown),
      CONTAINED_TEST(a_fault_is_told_with_its_cause),
      CONTAINED_TEST(the_end_of_input_is_named),
      CONTAINED_TEST(on_the_wall_clock_units_are_measured),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
