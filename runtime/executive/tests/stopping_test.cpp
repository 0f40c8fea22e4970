// How an application comes to its end: controlled stop, safe state, end of input, a step that hangs.
#include <unistd.h>

#include <csignal>
#include <thread>

#include "runtime/executive/tests/running_cell.hpp"
#include "runtime/run/report.hpp"

namespace flexrf::fixture::stopping_test {
namespace {

using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr Time beginning{std::chrono::seconds{1}};

// [stop-17] [stop-89]
void a_controlled_stop_lets_units_come_to_rest() {
  Cell cell;
  std::int64_t steps_to_rest = 30;
  bool is_stopping = false;
  bool seems_over = false;
  bool safe_too_early = false;
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick& tick) {
    is_stopping = is_stopping || tick.stop_requested;
    seems_over = seems_over || tick.stop_requested != is_stopping;
    if (tick.stop_requested && steps_to_rest > 0) --steps_to_rest;
  };
  cell.unit(Cell::consumer).script.is_idle = [&](const TestUnit&) { return steps_to_rest == 0; };
  cell.device(Cell::actuator).script.make_safe = [&](TestDevice&) {
    safe_too_early |= steps_to_rest > 0;
    return true;
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
  const RunSummary summary = run_to_the_end(executive);
  CHECK_EQUAL(summary.exit_code, 0);
  CHECK(!summary.cut_short);
  CHECK_EQUAL(steps_to_rest, 0);
  CHECK(!seems_over);
  CHECK(!safe_too_early);
  CHECK_EQUAL(cell.events().count_of("actuator: make_safe"), 1U);
  CHECK(summary.run_time >= milliseconds{130} && summary.run_time < milliseconds{200});
}

// [stop-18]
void who_does_not_come_to_rest_is_cut_short() {
  Cell cell;
  cell.stop_timeout = milliseconds{300};
  cell.unit(Cell::producer).script.is_idle = [](const TestUnit&) { return false; };
  Executive executive(cell.application(), in_virtual_time(milliseconds{100}));
  const RunSummary summary = run_to_the_end(executive);
  CHECK(summary.cut_short);
  CHECK_EQUAL(summary.exit_code, 0);
  CHECK_EQUAL(cell.events().count_of("actuator: make_safe"), 1U);
  CHECK(summary.run_time >= milliseconds{400} && summary.run_time < milliseconds{450});
}

// [stop-47] [stop-75]
void signals_stop_it_and_give_the_exit_code() {
  for (const int signal : {SIGINT, SIGTERM}) {
    Cell cell;
    RunningCell running(cell);
    running.start();
    CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 5; }));
    kill(getpid(), signal);
    const RunSummary summary = running.join();
    CHECK_EQUAL(summary.exit_code, 128 + signal);
    CHECK_EQUAL(summary.cause, EndCause::signal);
    CHECK(!summary.cut_short);
    CHECK_EQUAL(cell.events().count_of("actuator: make_safe"), 1U);
    CHECK(cell.events().place_of("actuator: make_safe") < cell.events().place_of("consumer: stop"));
    CHECK_CONTAINS(report_text(running.executive().cell(), summary),
                   signal == SIGINT ? "\nStopped by SIGINT after " : "\nStopped by SIGTERM after ");
  }
}

// [stop-47]
void a_second_signal_does_not_wait() {
  Cell cell;
  cell.stop_timeout = std::chrono::hours{1};
  cell.unit(Cell::producer).script.is_idle = [](const TestUnit&) { return false; };
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 5; }));
  kill(getpid(), SIGINT);
  CHECK(wait_until([&] { return running.control().mode() == Mode::stopping; }));
  kill(getpid(), SIGINT);
  CHECK_EQUAL(running.join().exit_code, 128 + SIGINT);
  CHECK_EQUAL(cell.events().count_of("actuator: make_safe"), 1U);
}

volatile std::sig_atomic_t heard = 0;

/// As a library does that is told something by it.
// [stop-84]
void a_signal_that_somebody_handles_is_left_to_him() {
  Cell cell;
  std::optional<Executive> executive;
  bool handled_at_once = false;
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
    if (tick.number != 5) return;
    raise(SIGUSR2);  // to this thread: where it is blocked, it is for somebody else
    handled_at_once = heard == SIGUSR2;
    executive->request_end();
  };
  std::signal(SIGUSR2, [](int signal) { heard = signal; });
  executive.emplace(cell.application(), on_the_wall_clock());
  const RunSummary summary = run_to_the_end(*executive);
  std::signal(SIGUSR2, SIG_DFL);
  CHECK_EQUAL(summary.exit_code, 0);
  CHECK(handled_at_once);
}

bool is_by_default(int signal) {
  struct sigaction present {};
  sigset_t blocked;
  return sigaction(signal, nullptr, &present) == 0 && present.sa_handler == SIG_DFL &&
         pthread_sigmask(SIG_SETMASK, nullptr, &blocked) == 0 && sigismember(&blocked, signal) == 0;
}

/// In a thread that an application on the wall clock has not used: that one waits for its signals.
// [stop-85]
void in_virtual_time_a_signal_ends_it_and_the_second_does_what_it_does() {
  std::string failure;
  std::thread([&] {
    try {
      sigset_t all;
      sigfillset(&all);
      pthread_sigmask(SIG_UNBLOCK, &all, nullptr);
      for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPWR, SIGQUIT}) {
        Cell cell;
        bool others_by_default = false;
        bool second_by_default = false;
        cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
          if (tick.number != 5) return;
          others_by_default = is_by_default(SIGUSR1) && is_by_default(SIGTSTP);
          raise(signal);
          second_by_default = is_by_default(signal);
        };
        Executive executive(cell.application(), in_virtual_time(std::chrono::hours{1}));
        const RunSummary summary = run_to_the_end(executive);
        CHECK_EQUAL(summary.exit_code, 128 + signal);
        CHECK_EQUAL(summary.cause, EndCause::signal);
        CHECK_CONTAINS(report_text(executive.cell(), summary), "\nStopped by SIG");
        CHECK(others_by_default);
        CHECK(second_by_default);
      }
    } catch (const CheckFailed& failed) {
      failure = failed.message;
    }
  }).join();
  CHECK_EQUAL(failure, "");
}

/// A bus in the tables after what it carries, and an arm that needs three calls.
// [stop-19] [stop-20] [stop-77]
void children_are_made_safe_before_their_bus_and_no_unit_steps() {
  for (const bool simulated : {true, false}) {
    Cell cell;
    const std::uint16_t bus = cell.add(DevicePlan{.name = "bus", .script = {}, .actuates = false});
    cell.device(Cell::actuator).bus = bus;
    cell.thread(Cell::consuming).devices = {bus, Cell::actuator};
    int calls = 0;
    int steps_between = 0;
    cell.device(Cell::actuator).script.make_safe = [&](TestDevice&) { return ++calls == 3; };
    Executive executive(cell.application(),
                        simulated ? in_virtual_time(milliseconds{20}) : on_the_wall_clock());
    cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick& tick) {
      if (calls > 0) ++steps_between;
      if (tick.number < 20) return;
      executive.control().set_cause(EndCause::requested);
      executive.control().rise_to(Mode::stopping);
    };
    CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
    Events& events = cell.events();
    CHECK(events.place_of("bus: initialise") < events.place_of("actuator: initialise"));
    CHECK_EQUAL(events.count_of("actuator: make_safe"), 3U);
    CHECK_EQUAL(events.count_of("bus: make_safe"), 1U);
    CHECK_EQUAL(steps_between, 0);
    CHECK(events.place_of("actuator: make_safe") < events.place_of("bus: make_safe"));
    CHECK(events.place_of("actuator: stop") < events.place_of("bus: stop"));
  }
}

// [stop-32] [stop-36] [stop-37]
void a_fault_makes_the_units_own_devices_safe_and_no_others() {
  Cell cell;
  const std::uint16_t gripper = cell.add(DevicePlan{.name = "gripper", .script = {}});
  cell.thread(Cell::producing).devices = {gripper};
  cell.unit(Cell::producer).device = gripper;
  cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
    if (tick.number == 5) unit.fail(Status::error(StatusCode::device_fault, "slipped"));
  };
  std::size_t safe_before_stop = 0;
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick& tick) {
    if (tick.number == 15) safe_before_stop = cell.events().count_of("gripper: make_safe");
    if (tick.number == 15 && cell.events().count_of("actuator: make_safe") > 0)
      throw CheckFailed{"not concerned"};
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{30}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 2);
  CHECK_EQUAL(safe_before_stop, 1U);
  CHECK_EQUAL(cell.unit_state(Cell::consumer).life.load(), Life::stopped);
}

// [stop-21]
void a_device_that_does_not_become_safe_is_a_fault() {
  Cell cell;
  cell.thread(Cell::producing).deadline = strict_deadline;
  cell.thread(Cell::consuming).deadline = strict_deadline;
  cell.device(Cell::actuator).script.make_safe = [](TestDevice&) { return false; };
  Executive executive(cell.application(), in_virtual_time(milliseconds{20}));
  const RunSummary summary = run_to_the_end(executive);
  CHECK_EQUAL(summary.exit_code, 2);
  CHECK(summary.run_time > std::chrono::seconds{1} && summary.run_time < std::chrono::seconds{2});
}

/// A step of its thread that takes as long would not hang yet.
// [stop-21]
void a_slow_threads_devices_have_as_long_as_its_steps() {
  Cell cell;
  Time now{};
  cell.thread(Cell::consuming).deadline = milliseconds{100};
  cell.device(Cell::actuator).script.receive = [&](TestDevice&, const Tick& tick) { now = tick.now; };
  cell.device(Cell::actuator).script.make_safe = [&](TestDevice&) {
    return now > beginning + milliseconds{1800};
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{20}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
}

/// Input that ends after ten jobs, which are left in a queue that is emptied slowly.
// [stop-29] [stop-71]
void at_the_end_of_input_queues_are_drained() {
  const TriggerPlan periodic = TriggerPlan::periodic(milliseconds{2});
  // Nothing arrives any more, and its reader is to take what waits all the same.
  const TriggerPlan by_queue = TriggerPlan::on_slots({}, {Cell::jobs});
  const std::pair<bool, TriggerPlan> runs[] = {
      {true, periodic}, {false, periodic}, {true, by_queue}, {false, by_queue}};
  for (const auto& [simulated, trigger] : runs) {
    Cell cell;
    std::atomic<std::int64_t> pushed{0};
    std::int64_t popped = 0;
    bool told = false;
    cell.thread(Cell::consuming).trigger = trigger;
    cell.device(Cell::actuator).script.is_closed = [&] { return pushed >= 10; };
    cell.unit(Cell::producer).script.step = [&](TestUnit& unit, const Tick& tick) {
      if (tick.number < 15 && !tick.finishing && unit.orders.push(Item{})) ++pushed;
    };
    cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
      told |= tick.finishing;
      if (told && tick.number % 2 == 0 && unit.jobs.pop()) ++popped;
    };
    Executive executive(cell.application(),
                        simulated ? in_virtual_time(std::chrono::seconds{60}) : on_the_wall_clock());
    const RunSummary summary = run_to_the_end(executive);
    CHECK_EQUAL(summary.exit_code, 0);
    CHECK_EQUAL(summary.cause, EndCause::end_of_input);
    CHECK(!summary.cut_short);
    CHECK(told);
    CHECK(pushed >= 10);
    CHECK_EQUAL(popped, pushed.load());
  }
}

// [stop-30]
void a_unit_finishes_what_it_has_begun() {
  Cell cell;
  cell.device(Cell::actuator).script.is_closed = [] { return true; };
  Time finished{};
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
    if (tick.number == 700) finished = tick.now;
  };
  cell.unit(Cell::producer).script.is_idle = [&](const TestUnit&) { return finished != Time{}; };
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  Executive executive(cell.application(), in_virtual_time(std::chrono::seconds{60}));
  const RunSummary summary = run_to_the_end(executive);
  CHECK_EQUAL(summary.cause, EndCause::end_of_input);
  CHECK(!summary.cut_short);
  CHECK_EQUAL((finished - beginning).count(), 700'000'000);
  CHECK(summary.run_time < milliseconds{800});
}

// [stop-31]
void finishing_has_its_timeout() {
  Cell cell;
  cell.finish_timeout = milliseconds{500};
  cell.device(Cell::actuator).script.is_closed = [] { return true; };
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  cell.unit(Cell::producer).script.is_idle = [](const TestUnit&) { return false; };
  cell.stop_timeout = milliseconds{100};
  Executive executive(cell.application(), in_virtual_time(std::chrono::seconds{60}));
  const RunSummary summary = run_to_the_end(executive);
  CHECK(summary.cut_short);
  CHECK_EQUAL(summary.cause, EndCause::end_of_input);
  CHECK(summary.run_time >= milliseconds{600} && summary.run_time < milliseconds{650});
}

/// Lets go of what hangs when the test is over, so that its thread can be joined after all.
struct Hook {
  std::atomic<bool> released{false};
  std::atomic<bool> hung{false};
  void hang() {
    hung = true;
    while (!released) usleep(1000);
  }
};

// [stop-41]
void a_step_that_hangs_brings_the_safe_state() {
  Hook hook;
  Cell cell;
  cell.thread(Cell::producing).deadline = strict_deadline;
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick& tick) {
    if (tick.number == 10) hook.hang();
  };
  RunSummary summary;
  std::string report;
  {
    Executive executive(cell.application(), on_the_wall_clock());
    CHECK(executive.prepare().is_ok());
    summary = executive.run();
    report = report_text(executive.cell(), summary);
    hook.released = true;
  }
  CHECK(hook.hung);
  CHECK_EQUAL(summary.exit_code, 2);
  CHECK(summary.stuck);
  CHECK_EQUAL(summary.cause, EndCause::fault);
  // The other thread answers, and makes its devices safe.
  CHECK_EQUAL(cell.events().count_of("actuator: make_safe"), 1U);
  CHECK_CONTAINS(report, "\nFault: thread producing: its step does not return; ");
}

void an_initialise_that_hangs_is_given_up() {
  Hook hook;
  Cell cell;
  cell.unit(Cell::consumer).initialise_timeout = milliseconds{100};
  cell.unit(Cell::consumer).script.initialise = [&](TestUnit&) {
    hook.hang();
    return Status{};
  };
  RunSummary summary;
  {
    Executive executive(cell.application(), on_the_wall_clock());
    CHECK(executive.prepare().is_ok());
    summary = executive.run();
    hook.released = true;
  }
  CHECK(hook.hung);
  CHECK_EQUAL(summary.exit_code, 2);
  CHECK(summary.stuck);
  CHECK_EQUAL(cell.events().count_of("actuator: make_safe"), 1U);
}

void a_real_actuator_is_refused_without_real_time() {
  Cell cell;
  cell.device(Cell::actuator).kind = DriverKind::real;
  Executive executive(cell.application(), on_the_wall_clock());
  const Status status = executive.prepare();
  CHECK(!status);
  CHECK_CONTAINS(status.cause(), "a real actuator is chosen");
}

void a_driver_that_cannot_live_in_virtual_time_is_refused_by_name() {
  Cell cell;
  cell.device(Cell::actuator).virtual_time = false;
  Executive executive(cell.application(), in_virtual_time(milliseconds{10}));
  const Status status = executive.prepare();
  CHECK(!status);
  CHECK_CONTAINS(status.cause(), "`actuator`");
  CHECK_CONTAINS(status.cause(), "`mock`");
}

}  // namespace
}  // namespace flexrf::fixture::stopping_test

int main() {
  using namespace flexrf::fixture::stopping_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_controlled_stop_lets_units_come_to_rest),
      CONTAINED_TEST(who_does_not_come_to_rest_is_cut_short),
      CONTAINED_TEST(signals_stop_it_and_give_the_exit_code),
      CONTAINED_TEST(a_second_signal_does_not_wait),
      CONTAINED_TEST(a_signal_that_somebody_handles_is_left_to_him),
      CONTAINED_TEST(in_virtual_time_a_signal_ends_it_and_the_second_does_what_it_does),
      CONTAINED_TEST(children_are_made_safe_before_their_bus_and_no_unit_steps),
      CONTAINED_TEST(a_fault_makes_the_units_own_devices_safe_and_no_others),
      CONTAINED_TEST(a_device_that_does_not_become_safe_is_a_fault),
      CONTAINED_TEST(a_slow_threads_devices_have_as_long_as_its_steps),
      CONTAINED_TEST(at_the_end_of_input_queues_are_drained),
      CONTAINED_TEST(a_unit_finishes_what_it_has_begun),
      CONTAINED_TEST(finishing_has_its_timeout),
      CONTAINED_TEST(a_step_that_hangs_brings_the_safe_state),
      CONTAINED_TEST(an_initialise_that_hangs_is_given_up),
      CONTAINED_TEST(a_real_actuator_is_refused_without_real_time),
      CONTAINED_TEST(a_driver_that_cannot_live_in_virtual_time_is_refused_by_name),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
