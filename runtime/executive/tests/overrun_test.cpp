// Steps that take longer than they may: what is left out, what is caught up with, what is a fault.
#include <poll.h>
#include <sys/resource.h>

#include <optional>

#include "runtime/executive/accounting.hpp"
#include "runtime/executive/budget_watch.hpp"
#include "runtime/executive/releases.hpp"
#include "runtime/executive/tests/running_cell.hpp"
#include "tests/log_ear.hpp"

namespace flexrf::fixture::overrun_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr Time beginning{std::chrono::seconds{1}};

/// A producer whose declared budget, which virtual time takes it by, is 2.5 periods.
void make_slow(Cell& cell, OverrunPolicy policy, std::vector<Tick>& ticks) {
  cell.thread(Cell::producing).overrun = policy;
  cell.unit(Cell::producer).budget = microseconds{2500};
  cell.unit(Cell::producer).script.step = [&ticks](TestUnit&, const Tick& tick) {
    if (!tick.stop_requested) ticks.push_back(tick);
  };
}

// [exec-19] [exec-66]
void skipped_releases_are_left_out() {
  Cell cell;
  std::vector<Tick> ticks;
  make_slow(cell, OverrunPolicy::skip, ticks);
  Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
  const RunSummary summary = run_to_the_end(executive);
  CHECK_EQUAL(summary.exit_code, 0);
  CHECK(ticks.size() >= 33);
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    CHECK(ticks[i].nominal - ticks[i - 1].nominal >= milliseconds{2});
    CHECK(ticks[i].lateness < milliseconds{1});
    // Releases stay on the grid of the period.
    CHECK_EQUAL((ticks[i].nominal - beginning).count() % 1'000'000, 0);
  }
  const ThreadState& state = cell.thread_state(Cell::producing);
  CHECK(state.overruns >= ticks.size());
  CHECK(state.skipped >= 50);
  // Each release took place or was left out, none was both.
  const auto releases = static_cast<std::uint64_t>(summary.run_time / milliseconds{1});
  CHECK(state.skipped + state.cycles + 3 >= releases && state.skipped + state.cycles <= releases + 3);
}

// [exec-20] [exec-52]
void every_release_is_caught_up_with() {
  Cell cell;
  std::vector<Tick> ticks;
  make_slow(cell, OverrunPolicy::catch_up, ticks);
  Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK_EQUAL(ticks.size(), 40U);
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    CHECK_EQUAL((ticks[i].nominal - ticks[i - 1].nominal).count(), 1'000'000);
    CHECK_EQUAL((ticks[i].now - ticks[i - 1].now).count(), 2'500'000);
  }
  CHECK_EQUAL(cell.thread_state(Cell::producing).skipped.load(), 0U);
}

// [exec-21] [stop-34]
void an_overrun_may_be_a_fault() {
  Cell cell;
  std::vector<Tick> ticks;
  make_slow(cell, OverrunPolicy::fault, ticks);
  Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  CHECK_EQUAL(ticks.size(), 1U);
  CHECK_EQUAL(cell.unit_state(Cell::producer).life.load(), Life::fault);
  CHECK_CONTAINS(cell.unit_state(Cell::producer).fault.read().cause(),
                 "thread producing reached its overrun limit");
  // The other thread's unit is not concerned.
  CHECK_EQUAL(cell.unit_state(Cell::consumer).life.load(), Life::stopped);
}

// [exec-22] [exec-23] [stop-34]
void so_many_in_a_row_are_a_fault() {
  Cell cell;
  std::vector<Tick> ticks;
  make_slow(cell, OverrunPolicy::skip, ticks);
  cell.thread(Cell::producing).limit = OverrunLimit{false, 4, 0};
  Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  // Each leaves one release out, which counts as well.
  CHECK_EQUAL(ticks.size(), 2U);
}

// ---- the counting itself

struct Counting {
  explicit Counting(OverrunPolicy policy, OverrunLimit limit) {
    record.overrun = policy;
    record.limit = limit;
    record.deadline = milliseconds{1};
  }
  /// One release that took so long; whether it is a fault.
  bool cycle(Duration took, std::uint64_t past = 0) {
    at += milliseconds{10};
    return accounting.count(Release{at, at, 0, false}, at + took, past).limit_reached;
  }
  bool good() { return cycle(microseconds{500}); }
  bool bad() { return cycle(microseconds{1500}); }

  ThreadRecord record{};
  ThreadState state;
  Accounting accounting{record, state};
  Time at = beginning;
};

// [exec-22]
void consecutive_overruns_are_forgotten_by_one_good_cycle() {
  Counting counting(OverrunPolicy::skip, OverrunLimit{false, 3, 0});
  for (int i = 0; i < 10; ++i) CHECK(!counting.bad() && !counting.bad() && !counting.good());
  CHECK(!counting.bad());
  CHECK(!counting.bad());
  CHECK(counting.bad());
  CHECK_EQUAL(counting.state.overruns.load(), 23U);
}

/// What ran was put in fault; what is started again, or was only about to start, has its limit, too.
void a_limit_that_was_reached_is_counted_anew() {
  Counting counting(OverrunPolicy::skip, OverrunLimit{false, 3, 0});
  for (int round = 0; round < 4; ++round) {
    CHECK(!counting.bad());
    CHECK(!counting.bad());
    CHECK(counting.bad());
  }
  Counting strict(OverrunPolicy::fault, OverrunLimit{});
  for (int i = 0; i < 4; ++i) CHECK(strict.bad());
}

// [exec-22]
void a_leaky_limit_drains_by_good_cycles() {
  // Rises by one per overrun, falls by one per 4 good cycles, faults at 3.
  Counting steady(OverrunPolicy::skip, OverrunLimit{true, 3, 4});
  for (int i = 0; i < 50; ++i) {
    CHECK(!steady.bad());
    for (int good = 0; good < 4; ++good) CHECK(!steady.good());
  }
  Counting rising(OverrunPolicy::skip, OverrunLimit{true, 3, 4});
  const auto bad_and_three_good = [&] {
    const bool fault = rising.bad();
    return rising.good() || rising.good() || rising.good() || fault;
  };
  int faults_after = 0;
  for (bool fault = false; !fault && faults_after < 100; ++faults_after) fault = bad_and_three_good();
  CHECK(faults_after >= 4 && faults_after < 20);
}

// [exec-17]
void without_a_limit_overruns_are_only_counted() {
  Counting counting(OverrunPolicy::skip, OverrunLimit{});
  for (int i = 0; i < 1000; ++i) CHECK(!counting.cycle(milliseconds{2}, 3));
  CHECK_EQUAL(counting.state.overruns.load(), 1000U);
  CHECK_EQUAL(counting.state.skipped.load(), 3000U);
}

/// What was left out is time that was missed: 712 releases are no single overrun.
// [exec-23]
void a_limit_counts_every_release_that_was_left_out() {
  Counting counting(OverrunPolicy::skip, OverrunLimit{false, 700, 0});
  counting.record.trigger.period = milliseconds{7};
  CHECK(counting.cycle(milliseconds{5000}, 712));
  CHECK_EQUAL(counting.state.overruns.load(), 1U);
  CHECK_EQUAL(counting.state.skipped_time.load(), 712 * 7'000'000LL);
  // What is caught up with is not left out: each of them ends late by itself.
  Counting patient(OverrunPolicy::catch_up, OverrunLimit{false, 3, 0});
  CHECK(!patient.cycle(milliseconds{50}, 4));
  CHECK(!patient.cycle(milliseconds{50}, 3));
  CHECK(patient.cycle(milliseconds{50}, 2));
}

// [stop-46]
void overruns_are_said_at_once_and_then_as_a_sum() {
  LogEar ear;
  Counting counting(OverrunPolicy::skip, OverrunLimit{});
  counting.record.name = "control";
  counting.record.trigger.period = milliseconds{1};
  Accounting accounting(counting.record, counting.state);
  Time at = beginning;
  accounting.count(Release{at, at, 0, false}, at + milliseconds{4}, 3);
  CHECK(ear.has_heard("control: overrun: 3.0 ms late, 3 releases (3.0 ms) left out"));
  for (int i = 0; i < 4; ++i) {
    at += std::chrono::seconds{2};
    accounting.count(Release{at, at, 0, false}, at + milliseconds{3}, 2);
    accounting.say(at);
  }
  CHECK(!ear.has_heard("since then"));
  accounting.say(beginning + std::chrono::seconds{11});
  CHECK(ear.has_heard("control: overruns since then: 4, 2.0 ms late at most, 8 releases (8.0 ms) left out"));
  accounting.count(Release{at, at, 0, false}, at + milliseconds{3}, 0);
  accounting.say(Time::max());
  CHECK(ear.has_heard("control: overruns since then: 1,"));
}

// ---- the process was stopped by job control

/// What was due while the process was stopped, and a release that was under way, are no overruns: neither
/// counted, nor made up for, nor a fault, whatever the policy.
// [stop-53]
void a_stop_by_job_control_is_no_overrun() {
  constexpr Duration stop = std::chrono::seconds{5};
  for (const OverrunPolicy policy : {OverrunPolicy::skip, OverrunPolicy::catch_up, OverrunPolicy::fault}) {
    for (const bool in_a_step : {true, false}) {
      for (const bool goes_on_before_the_break_ends : {true, false}) {
        Cell cell;
        const Options options = on_the_wall_clock();
        cell.thread(Cell::producing).overrun = policy;
        if (policy != OverrunPolicy::fault) cell.thread(Cell::producing).limit = OverrunLimit{false, 2, 0};
        flexrf::Cell running(cell.application(), options);
        Control& control = running.control();
        CHECK(running.construct().is_ok());
        Releases releases(running, Cell::producing);
        Time now = beginning;
        releases.begin(now);
        std::optional<Release> under_way;
        if (in_a_step) under_way = releases.take(releases.next(now, false), now);
        control.begin_break();
        const Time resumed = now + stop + microseconds{300};
        now = resumed + microseconds{100};
        if (!goes_on_before_the_break_ends) control.end_break(resumed);
        if (under_way) CHECK(!releases.finish(*under_way, now));
        if (goes_on_before_the_break_ends) {
          const Release first = releases.take(releases.next(now, false), now);
          CHECK(!releases.finish(first, now + microseconds{10}));
          control.end_break(resumed);
        }
        now += milliseconds{1};
        for (int i = 0; i < 3; ++i) {
          const Due due = releases.next(now, false);
          CHECK(due.at >= resumed);
          CHECK_EQUAL((due.at - beginning).count() % 1'000'000, 0);
          now = due.at;
          CHECK(!releases.finish(releases.take(due, now), now + microseconds{10}));
        }
        CHECK_EQUAL(cell.thread_state(Cell::producing).overruns.load(), 0U);
        CHECK_EQUAL(cell.thread_state(Cell::producing).skipped.load(), 0U);
        CHECK(cell.thread_state(Cell::producing).execution.maximum() < milliseconds{1});
        CHECK_EQUAL(control.faults(), 0U);
      }
    }
  }
}

/// The whole way, on the wall clock.
// [stop-98]
void a_step_that_always_takes_too_long_ends_the_motion() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  cell.thread(Cell::consuming).deadline = milliseconds{1};
  cell.unit(Cell::consumer).script.step = [](TestUnit& unit, const Tick& tick) {
    while (unit.jobs.pop()) continue;
    const Time until = MonotonicClock::now() + milliseconds{10};
    while (MonotonicClock::now() < until && !tick.stop_requested) {
    }
  };
  Options options = on_the_wall_clock();
  options.standstill_limit = milliseconds{200};
  RunningCell running(cell, options);
  running.start();
  CHECK(wait_until([&] { return running.control().motion_stopped(); }));
  CHECK_EQUAL(running.finish().exit_code, 2);
}

// ---- budgets

void work_for(Duration time) {
  const Time until = MonotonicClock::now() + time;
  while (MonotonicClock::now() < until) {
  }
}
void wait_for(Duration time) {
  poll(nullptr, 0, static_cast<int>(time / milliseconds{1}));  // the checked build lets nobody sleep
}

// [exec-89] [exec-90]
void a_unit_that_exceeds_its_budget_is_logged_and_counted() {
  for (const auto& takes_long : {&work_for, &wait_for}) {
    LogEar ear;
    Cell cell;
    cell.thread(Cell::producing).priority = 40;
    cell.unit(Cell::producer).budget = milliseconds{1};
    cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick&) { takes_long(milliseconds{5}); };
    RunningCell running(cell);
    running.start();
    CHECK(wait_until([&] { return cell.unit_state(Cell::producer).budget_overruns > 3; }));
    CHECK_EQUAL(running.finish().exit_code, 0);
    CHECK(ear.has_heard("producing: a step of producer took "));
    CHECK(ear.has_heard("ms of its own, its budget is 1.00 ms; shorten the step or raise the budget"));
    CHECK(ear.has_heard("producing: steps beyond their budget since then: "));
    CHECK_EQUAL(cell.unit_state(Cell::consumer).budget_overruns.load(), 0U);
  }
}

long waits_of_this_thread() {
  rusage counted{};
  getrusage(RUSAGE_THREAD, &counted);
  return counted.ru_nvcsw;
}

/// @returns false: this thread waited meanwhile, as for a page of memory, and nothing can be said.
bool kept_from_the_processor() {
  Cell cell;
  cell.thread(Cell::producing).priority = 40;
  cell.unit(Cell::producer).budget =
      milliseconds{5};  // of the processor, more than a look at the clock takes
  const Application& application = cell.application();
  const long waits = waits_of_this_thread();
  BudgetWatch watch(application, application.threads[Cell::producing]);
  Time now = beginning;
  for (int i = 0; i < 10; ++i) {
    watch.begin();
    now += milliseconds{10};
    // By the clock it took 10 ms, of which it hardly had anything.
    watch.note(Cell::producer, milliseconds{10}, now);
  }
  if (waits_of_this_thread() != waits) return false;
  CHECK_EQUAL(cell.unit_state(Cell::producer).budget_overruns.load(), 0U);
  return true;
}

/// Time in which others had the processor is not the unit's own.
// [exec-89]
void a_unit_that_was_kept_from_the_processor_exceeds_nothing() {
  CHECK(wait_until([] { return kept_from_the_processor(); }));
}

// [exec-18]
void a_late_beginning_counts_too() {
  Counting counting(OverrunPolicy::skip, OverrunLimit{});
  const Time due = beginning;
  counting.accounting.count(Release{due, due + microseconds{900}, 0, false}, due + microseconds{1100}, 0);
  CHECK_EQUAL(counting.state.overruns.load(), 1U);
  CHECK_EQUAL(counting.state.lateness.maximum().count(), 900'000);
  CHECK_EQUAL(counting.state.execution.maximum().count(), 200'000);
}

// [exec-17] [exec-21] [stop-34]
void a_real_overrun_is_noticed_on_the_wall_clock() {
  Cell cell;
  cell.thread(Cell::producing).overrun = OverrunPolicy::fault;
  cell.unit(Cell::producer).script.step = [](TestUnit&, const Tick& tick) {
    if (tick.number < 3) return;  // on a loaded machine the third itself may be skipped
    const Time until = MonotonicClock::now() + milliseconds{5};
    while (MonotonicClock::now() < until) {
    }
  };
  cell.thread(Cell::producing).trigger = TriggerPlan::periodic(milliseconds{2});
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(Cell::producer).life == Life::fault; }));
  CHECK_EQUAL(running.finish().exit_code, 2);
  CHECK_CONTAINS(cell.unit_state(Cell::producer).fault.read().cause(), "overrun limit");
}

}  // namespace
}  // namespace flexrf::fixture::overrun_test

int main() {
  using namespace flexrf::fixture::overrun_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(skipped_releases_are_left_out),
      CONTAINED_TEST(every_release_is_caught_up_with),
      CONTAINED_TEST(an_overrun_may_be_a_fault),
      CONTAINED_TEST(so_many_in_a_row_are_a_fault),
      CONTAINED_TEST(consecutive_overruns_are_forgotten_by_one_good_cycle),
      CONTAINED_TEST(a_limit_that_was_reached_is_counted_anew),
      CONTAINED_TEST(a_leaky_limit_drains_by_good_cycles),
      CONTAINED_TEST(without_a_limit_overruns_are_only_counted),
      CONTAINED_TEST(a_limit_counts_every_release_that_was_left_out),
      CONTAINED_TEST(overruns_are_said_at_once_and_then_as_a_sum),
      CONTAINED_TEST(a_stop_by_job_control_is_no_overrun),
      CONTAINED_TEST(a_step_that_always_takes_too_long_ends_the_motion),
      CONTAINED_TEST(a_unit_that_exceeds_its_budget_is_logged_and_counted),
      CONTAINED_TEST(a_unit_that_was_kept_from_the_processor_exceeds_nothing),
      CONTAINED_TEST(a_late_beginning_counts_too),
      CONTAINED_TEST(a_real_overrun_is_noticed_on_the_wall_clock),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
