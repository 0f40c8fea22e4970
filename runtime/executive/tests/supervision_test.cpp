// What supervision concludes from what it sees, and how often it looks. No thread runs: the tests say who
// does what, and when is looked.
#include "runtime/executive/supervision.hpp"

#include <ctime>

#include "runtime/executive/lifecycle.hpp"
#include "runtime/executive/standstill.hpp"
#include "runtime/executive/tests/running_cell.hpp"
#include "runtime/executive/thread_loop.hpp"
#include "runtime/log/log.hpp"

namespace flexrf::fixture::supervision_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Plan = ProducerAndConsumer;

/// The producer's thread has a period of a millisecond; the consumer's waits for events.
struct StrictPlan : StrictProducerAndConsumer {
  explicit StrictPlan(Duration hang_timeout) {
    thread(producing).hang_timeout = hang_timeout;
    thread(producing).trigger = TriggerPlan::periodic(milliseconds{1});
    thread(consuming).trigger = TriggerPlan::on_slots({values}, {jobs});
    thread(consuming).trigger.timeout = milliseconds{1};
  }
};

struct Looked {
  explicit Looked(Duration hang_timeout = {}) : plan(hang_timeout) {}

  StrictPlan plan;
  Options options = on_the_wall_clock();
  Cell cell{plan.application(), options};
  Lifecycle lifecycle{cell, true};
  Supervision supervision{cell, lifecycle, true};
  Time now{seconds{1}};

  // What was logged names threads that go with the plan.
  ~Looked() { drain_log(-1); }
  void look(Duration later) {
    now += later;
    supervision.observe(now);
  }
  ThreadState& thread(std::uint16_t number) { return plan.application().thread_states[number]; }
  void begin_step(std::uint16_t number) { thread(number).step_began = now.time_since_epoch().count(); }
  void end_step(std::uint16_t number) { thread(number).step_began = 0; }
};

/// A step that has begun and does not end.
struct Hanging : Looked {
  explicit Hanging(Duration hang_timeout = {}) : Looked(hang_timeout) {
    look(Duration{});
    begin_step(Plan::producing);
    look(Duration{});
  }
};

// [stop-40]
void a_step_that_is_watched_all_the_time_hangs_after_its_time_out() {
  Hanging step;
  for (int i = 0; i < 100; ++i) step.look(milliseconds{5});
  CHECK(!step.supervision.is_stuck());
  step.look(milliseconds{5});
  CHECK(step.supervision.is_stuck());
}

// [stop-79]
void a_thread_may_have_a_time_out_of_its_own() {
  Hanging step(seconds{2});
  for (int i = 0; i < 400; ++i) step.look(milliseconds{5});
  CHECK(!step.supervision.is_stuck());
  step.look(milliseconds{5});
  CHECK(step.supervision.is_stuck());
}

// [stop-42]
void of_a_time_in_which_nobody_watched_the_longest_pause_counts() {
  Hanging step;
  step.look(seconds{10});
  CHECK(!step.supervision.is_stuck());
  for (int i = 0; i < 80; ++i) step.look(milliseconds{5});
  CHECK(!step.supervision.is_stuck());
  step.look(milliseconds{5});
  CHECK(step.supervision.is_stuck());
}

// [stop-43]
void who_seldom_watches_finds_what_hangs_all_the_same() {
  Hanging step;
  for (int i = 0; i < 6; ++i) step.look(seconds{1});
  CHECK(step.supervision.is_stuck());
}

/// Permitted to move, and judged by a second.
struct Moving : Looked {
  Moving() {
    options.standstill_limit = seconds{1};
    cell.control().permit_motion_at_power_on();
    cell.control().rise_to(Mode::running);
  }
};

/// A thread without an actuator concerns nobody else.
// [stop-45] [stop-80]
void of_a_process_that_stood_still_every_actuator_is_concerned() {
  for (const std::uint16_t thread :
       {std::uint16_t{Plan::producing}, std::uint16_t{Plan::consuming}, no_index}) {
    Moving application;
    CHECK(application.cell.construct().is_ok());
    Standstill standstill(application.cell, thread);
    const Time now = application.now;
    CHECK(!standstill.judge(now - milliseconds{999}, now));
    CHECK(application.cell.control().may_move());
    CHECK(standstill.judge(now - seconds{1}, now));
    CHECK_EQUAL(application.cell.control().may_move(), thread == Plan::producing);
    CHECK_EQUAL(application.cell.control().faults(), 1U);
  }
}

/// Its own clock does not tell it when it should have run.
// [stop-45] [stop-81]
void who_waits_for_events_takes_for_missed_what_nobody_watched() {
  Moving application;
  Control& control = application.cell.control();
  bool is_inhibited = false;
  application.plan.unit(Plan::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
    is_inhibited = tick.motion_inhibited && unit.device->is_inhibited();
    control.rise_to(Mode::ended);
  };
  CHECK(application.cell.construct().is_ok());
  CHECK(application.lifecycle.start_all().is_ok());
  ThreadLoop loop(application.cell, Plan::consuming);
  CHECK(loop.prepare().is_ok());
  control.note_look(MonotonicClock::now() - seconds{5});
  loop.run();
  CHECK(is_inhibited);
  CHECK(application.thread(Plan::consuming).longest_standstill >= 5'000'000'000);
}

TriggerPlan polling_the_queue() {
  TriggerPlan plan = TriggerPlan::backing_off(Plan::values, milliseconds{1}, milliseconds{5});
  plan.slots = {};
  plan.queues = {Plan::jobs};
  return plan;
}

/// Job control stopped the process in the middle of a step, for longer than the limit: no thread is judged by
/// that, whatever releases it. The supervising thread looks again only later.
// [stop-53]
void a_stop_by_job_control_is_no_standstill() {
  for (const TriggerPlan& trigger :
       {TriggerPlan::periodic(milliseconds{1}), TriggerPlan::on_slots({}, {Plan::jobs}), polling_the_queue(),
        TriggerPlan::free_running()}) {
    Moving application;
    application.options.standstill_limit = milliseconds{500};
    application.plan.thread(Plan::consuming).trigger = trigger;
    Control& control = application.cell.control();
    int steps = 0;
    application.plan.unit(Plan::consumer).script.step = [&](TestUnit&, const Tick&) {
      if (++steps == 1) {
        control.begin_break();
        const timespec stopped{0, 600'000'000};
        nanosleep(&stopped, nullptr);
        control.end_break(MonotonicClock::now());
      }
      if (steps == 3) control.rise_to(Mode::ended);
    };
    CHECK(application.cell.construct().is_ok());
    CHECK(application.lifecycle.start_all().is_ok());
    ThreadLoop loop(application.cell, Plan::consuming);
    CHECK(loop.prepare().is_ok());
    // Never taken: it is offered again and again.
    const Item item{};
    CHECK(application.plan.application().queues[Plan::jobs].sinks[0]->push(&item, MonotonicClock::now()));
    control.note_look(MonotonicClock::now());
    loop.run();
    CHECK_EQUAL(steps, 3);
    CHECK_EQUAL(control.faults(), 0U);
    CHECK_EQUAL(application.thread(Plan::consuming).longest_standstill.load(), 0);
  }
}

// [stop-53]
void what_is_missed_after_a_stop_by_job_control_counts_from_there() {
  Moving application;
  CHECK(application.cell.construct().is_ok());
  Control& control = application.cell.control();
  Standstill standstill(application.cell, Plan::consuming);
  const Time resumed = application.now + seconds{10};
  control.begin_break();
  CHECK(!standstill.judge(application.now, resumed));
  control.end_break(resumed);
  CHECK(!standstill.judge(application.now, resumed + milliseconds{999}));
  CHECK(standstill.judge(application.now, resumed + seconds{1}));
}

/// A thread that owns an actuator and ends every release too late: the arm would move on in jerks.
// [stop-98]
void a_thread_that_is_always_late_moves_nothing_any_more() {
  Moving application;
  CHECK(application.cell.construct().is_ok());
  Control& control = application.cell.control();
  Standstill standstill(application.cell, Plan::consuming);
  Time now = application.now;
  // Each release ends 300 ms after it was due. How many until Stop motion; 0: none of ten.
  const auto releases_until_stop = [&](auto overrun) {
    for (int i = 1; i <= 10; ++i) {
      const Time due = now;
      now += milliseconds{300};
      if (standstill.judge_release(due, now, overrun(i))) return i;
    }
    return 0;
  };
  const auto always = [](int) { return true; };
  // One in time begins anew.
  CHECK_EQUAL(releases_until_stop([](int i) { return i % 3 != 0; }), 0);
  CHECK_EQUAL(control.faults(), 0U);
  CHECK(!standstill.judge_release(now, now + milliseconds{1}, false));
  CHECK_EQUAL(releases_until_stop(always), 4);
  CHECK_EQUAL(control.faults(), 1U);
  CHECK(control.motion_stopped());
  CHECK(application.thread(Plan::consuming).longest_standstill >= 1'000'000'000);
  // Nothing moves: nothing is judged, and the next Start has the whole limit again.
  CHECK_EQUAL(releases_until_stop(always), 0);
  control.clear_stop_motion();
  control.permit_motion_at_power_on();
  CHECK_EQUAL(releases_until_stop(always), 4);
  // A stop by job control in between does not count.
  control.clear_stop_motion();
  control.permit_motion_at_power_on();
  CHECK(!standstill.judge_release(now, now + milliseconds{300}, true));
  control.begin_break();
  now += seconds{10};
  CHECK(!standstill.judge_release(now - seconds{10}, now, true));
  control.end_break(now);
  CHECK_EQUAL(releases_until_stop(always), 4);
  // Others are late for themselves.
  Standstill other(application.cell, Plan::producing);
  control.clear_stop_motion();
  control.permit_motion_at_power_on();
  for (int i = 0; i < 10; ++i) CHECK(!other.judge_release(now, now + seconds{1}, true));
}

/// An application whose input is over, of which an event is being handled.
struct Finishing : Looked {
  Finishing() {
    cell.control().rise_to(Mode::finishing);
    look(Duration{});
    begin_step(Plan::consuming);
    look(milliseconds{1});
  }
  bool is_over() { return cell.control().mode() != Mode::finishing; }
};

void what_an_event_began_is_waited_for_however_late_is_looked() {
  Finishing application;
  // Who looks was held up; the event was handled until just now, with something to do for the periodic
  // thread.
  application.thread(Plan::producing).cycles += 100;
  application.end_step(Plan::consuming);
  application.look(milliseconds{300});
  CHECK(!application.is_over());
  application.thread(Plan::producing).cycles += 2;
  application.look(milliseconds{1});
  CHECK(!application.is_over());
  application.look(milliseconds{20});
  CHECK(application.is_over());
}

void time_alone_does_not_end_an_application() {
  Finishing application;
  application.end_step(Plan::consuming);
  for (int i = 0; i < 100; ++i) application.look(milliseconds{5});
  CHECK(!application.is_over());
  application.thread(Plan::producing).cycles += 2;
  application.look(milliseconds{5});
  CHECK(application.is_over());
}

}  // namespace
}  // namespace flexrf::fixture::supervision_test

int main() {
  using namespace flexrf::fixture::supervision_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_step_that_is_watched_all_the_time_hangs_after_its_time_out),
      CONTAINED_TEST(a_thread_may_have_a_time_out_of_its_own),
      CONTAINED_TEST(of_a_process_that_stood_still_every_actuator_is_concerned),
      CONTAINED_TEST(who_waits_for_events_takes_for_missed_what_nobody_watched),
      CONTAINED_TEST(a_stop_by_job_control_is_no_standstill),
      CONTAINED_TEST(what_is_missed_after_a_stop_by_job_control_counts_from_there),
      CONTAINED_TEST(a_thread_that_is_always_late_moves_nothing_any_more),
      CONTAINED_TEST(of_a_time_in_which_nobody_watched_the_longest_pause_counts),
      CONTAINED_TEST(who_seldom_watches_finds_what_hangs_all_the_same),
      CONTAINED_TEST(what_an_event_began_is_waited_for_however_late_is_looked),
      CONTAINED_TEST(time_alone_does_not_end_an_application),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
