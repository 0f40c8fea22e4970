// What supervision concludes from what it sees, and how often it looks. No thread runs: the tests say who
// does what, and when is looked.
#include "runtime/executive/supervision.hpp"

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
    CHECK(!standstill.judge(milliseconds{999}));
    CHECK(application.cell.control().may_move());
    CHECK(standstill.judge(seconds{1}));
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
      CONTAINED_TEST(of_a_time_in_which_nobody_watched_the_longest_pause_counts),
      CONTAINED_TEST(who_seldom_watches_finds_what_hangs_all_the_same),
      CONTAINED_TEST(what_an_event_began_is_waited_for_however_late_is_looked),
      CONTAINED_TEST(time_alone_does_not_end_an_application),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
