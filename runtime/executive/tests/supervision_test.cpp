// What supervision concludes from what it sees, and how often it looks. No thread runs: the tests say who
// does what, and when is looked.
#include "runtime/executive/supervision.hpp"

#include "runtime/executive/lifecycle.hpp"
#include "runtime/executive/tests/running_cell.hpp"
#include "runtime/log/log.hpp"

namespace flexrf::fixture {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Plan = ProducerAndConsumer;

/// The producer's thread has a period of a millisecond; the consumer's waits for events.
struct StrictPlan : StrictProducerAndConsumer {
  StrictPlan() {
    thread(producing).trigger = TriggerPlan::periodic(milliseconds{1});
    thread(consuming).trigger = TriggerPlan::on_slots({values}, {jobs});
  }
};

struct Looked {
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
  Hanging() {
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
}  // namespace flexrf::fixture

int main() {
  using namespace flexrf::fixture;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_step_that_is_watched_all_the_time_hangs_after_its_time_out),
      CONTAINED_TEST(of_a_time_in_which_nobody_watched_the_longest_pause_counts),
      CONTAINED_TEST(who_seldom_watches_finds_what_hangs_all_the_same),
      CONTAINED_TEST(what_an_event_began_is_waited_for_however_late_is_looked),
      CONTAINED_TEST(time_alone_does_not_end_an_application),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
