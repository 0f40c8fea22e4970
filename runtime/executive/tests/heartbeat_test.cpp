// Who is alive, and what the service manager is told of it.
#include <unistd.h>

#include <cstdlib>
#include <initializer_list>

#include "runtime/executive/heartbeat_watch.hpp"
#include "runtime/executive/service_manager.hpp"
#include "runtime/executive/tests/notify_listener.hpp"
#include "runtime/executive/tests/running_cell.hpp"
#include "runtime/log/log.hpp"

namespace flexrf::fixture::heartbeat_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Plan = ProducerAndConsumer;

/// None of the threads runs: the test says who turned.
struct Watched {
  StrictProducerAndConsumer plan;
  Options options = on_the_wall_clock();
  Cell cell{plan.application(), options};
  HeartbeatWatch watch{cell};
  Time now{seconds{1}};

  // What was logged names threads that go with the plan.
  ~Watched() { drain_log(-1); }
  Heartbeat& heartbeat() { return cell.heartbeat(); }
  bool is_met() { return heartbeat().is_met(now); }
  void pass(Duration time, std::initializer_list<std::uint16_t> turning, bool stuck = false) {
    for (const Time end = now + time; now < end;) {
      now += milliseconds{5};
      for (const std::uint16_t thread : turning) ++plan.application().thread_states[thread].turns;
      watch.observe(now, stuck);
    }
  }
  std::uint32_t rings(std::uint16_t thread) { return plan.application().threads[thread].bell->listen(); }
};

void nobody_is_judged_before_somebody_asks() {
  Watched cell;
  cell.pass(seconds{2}, {});
  CHECK(!cell.is_met());
  CHECK(cell.heartbeat().missed_by() == nullptr);
}

void it_is_met_while_every_thread_turns() {
  Watched cell;
  cell.heartbeat().watch();
  for (int i = 0; i < 100; ++i) {
    cell.pass(milliseconds{50}, {Plan::producing, Plan::consuming});
    CHECK(cell.is_met());
  }
}

// [exec-34]
void a_silent_thread_is_rung_then_named_and_comes_back() {
  Watched cell;
  cell.heartbeat().watch();
  cell.pass(milliseconds{100}, {Plan::producing, Plan::consuming});
  const std::uint32_t before = cell.rings(Plan::consuming);
  cell.pass(milliseconds{300}, {Plan::producing});
  CHECK(cell.rings(Plan::consuming) != before);
  CHECK(cell.is_met());
  cell.pass(milliseconds{300}, {Plan::producing});
  CHECK(!cell.is_met());
  CHECK_EQUAL(std::string{cell.heartbeat().missed_by()}, "consuming");
  cell.pass(milliseconds{5}, {Plan::producing, Plan::consuming});
  CHECK(cell.is_met());
  CHECK(cell.heartbeat().missed_by() == nullptr);
}

void a_judgement_holds_for_a_second() {
  Watched cell;
  cell.heartbeat().watch();
  cell.pass(milliseconds{100}, {Plan::producing, Plan::consuming});
  CHECK(cell.heartbeat().is_met(cell.now + milliseconds{999}));
  CHECK(!cell.heartbeat().is_met(cell.now + milliseconds{1001}));
}

void after_the_watch_itself_stood_still_nobody_is_blamed() {
  Watched cell;
  cell.heartbeat().watch();
  cell.pass(milliseconds{100}, {Plan::producing, Plan::consuming});
  cell.now += seconds{10};
  CHECK(!cell.is_met());
  cell.pass(milliseconds{50}, {});
  CHECK(cell.is_met());
  cell.pass(milliseconds{600}, {});
  CHECK(!cell.is_met());
}

void what_is_given_up_misses_it() {
  Watched cell;
  cell.heartbeat().watch();
  cell.pass(milliseconds{100}, {Plan::producing, Plan::consuming}, true);
  CHECK(!cell.is_met());
}

// [exec-34]
void a_thread_with_nothing_to_do_answers() {
  Plan plan;
  plan.unit(Plan::producer).script.step = [](TestUnit&, const Tick&) {};
  plan.thread(Plan::consuming).deadline = milliseconds{150};  // rung after a quarter of 3 s
  RunningCell running(plan);
  Heartbeat& heartbeat = running.executive().cell().heartbeat();
  heartbeat.watch();
  running.start();
  CHECK(wait_until([&] { return running.control().mode() == Mode::running; }));
  const std::uint64_t turns = plan.thread_state(Plan::consuming).turns;
  CHECK(wait_until([&] { return plan.thread_state(Plan::consuming).turns > turns + 2; }));
  CHECK(wait_until([&] { return heartbeat.is_met(MonotonicClock::now()); }));
  CHECK_EQUAL(running.finish().exit_code, 0);
}

void a_step_that_hangs_misses_it() {
  std::atomic<bool> released{false};
  Plan plan;
  plan.thread(Plan::producing).deadline = strict_deadline;
  plan.unit(Plan::producer).script.step = [&](TestUnit&, const Tick& tick) {
    while (tick.number == 10 && !released) usleep(1000);
  };
  Executive executive(plan.application(), on_the_wall_clock());
  executive.cell().heartbeat().watch();
  CHECK(executive.prepare().is_ok());
  CHECK(executive.run().stuck);
  released = true;
  CHECK(executive.cell().heartbeat().missed_by() != nullptr);
  CHECK(!executive.cell().heartbeat().is_met(MonotonicClock::now()));
}

void the_manager_is_told_how_it_stands() {
  NotifyListener listener;
  Heartbeat heartbeat;
  Control control({});
  Time now{seconds{1}};
  ServiceManager manager("cell", ServiceManagerAddress{.socket = listener.name()}, heartbeat);
  const auto observe = [&] { manager.observe(now += milliseconds{5}, control); };
  observe();
  CHECK_EQUAL(listener.next(), "STATUS=starting");
  control.rise_to(Mode::running);
  observe();
  CHECK_EQUAL(listener.next(), "READY=1");
  CHECK_EQUAL(listener.next(), "STATUS=running, waits for Start");
  observe();
  CHECK_EQUAL(listener.next(), "");
  CHECK(control.start_motion().is_ok());
  observe();
  CHECK_EQUAL(listener.next(), "STATUS=running, actuators may move");
  control.note_fault();
  control.stop_motion();
  observe();
  CHECK_EQUAL(listener.next(), "STATUS=running, motion is stopped, 1 fault");
  control.rise_to(Mode::stopping);
  observe();
  CHECK_EQUAL(listener.next(), "STOPPING=1");
  CHECK_EQUAL(listener.next(), "STATUS=stopping, 1 fault");
  CHECK(!heartbeat.is_watched());
}

// [exec-34]
void the_manager_hears_the_heartbeat_twice_in_its_interval_and_only_while_it_is_met() {
  NotifyListener listener;
  Heartbeat heartbeat;
  Control control({});
  Time now{seconds{1}};
  ServiceManager manager("cell", ServiceManagerAddress{.socket = listener.name(), .watchdog = seconds{2}},
                         heartbeat);
  CHECK(heartbeat.is_watched());
  const auto heard_in = [&](Duration time, const char* missed_by) {
    int heard = 0;
    for (const Time end = now + time; now < end;) {
      now += milliseconds{5};
      heartbeat.judge(now, missed_by);
      manager.observe(now, control);
      for (std::string text = listener.next(); !text.empty(); text = listener.next())
        heard += text == "WATCHDOG=1" ? 1 : 0;
    }
    return heard;
  };
  CHECK_EQUAL(heard_in(seconds{20}, nullptr), 20);
  CHECK_EQUAL(heard_in(seconds{20}, "control"), 0);
  CHECK_EQUAL(heard_in(seconds{20}, nullptr), 20);
}

void nobody_listens_and_nothing_happens() {
  Heartbeat heartbeat;
  Control control({});
  for (const std::string& socket : {std::string{"/no/such/folder/notify"}, std::string(200, 'x')}) {
    ServiceManager manager("cell", ServiceManagerAddress{.socket = socket}, heartbeat);
    for (int i = 1; i < 5; ++i) manager.observe(Time{seconds{i}}, control);
  }
  ServiceManager none("cell", std::nullopt, heartbeat);
  none.observe(Time{seconds{1}}, control);
  CHECK(!heartbeat.is_watched());
}

/// The variables as they were, when it goes.
struct Environment {
  ~Environment() {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
  }
};

void the_environment_says_who_listens() {
  const Environment environment;
  CHECK(!ServiceManagerAddress::of_environment());
  setenv("WATCHDOG_USEC", "3000000", 1);
  CHECK(!ServiceManagerAddress::of_environment());
  setenv("NOTIFY_SOCKET", "/run/notify", 1);
  CHECK_EQUAL(ServiceManagerAddress::of_environment()->socket, "/run/notify");
  CHECK(ServiceManagerAddress::of_environment()->watchdog == seconds{3});
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  CHECK(ServiceManagerAddress::of_environment()->watchdog == seconds{3});
  setenv("WATCHDOG_PID", std::to_string(getppid()).c_str(), 1);
  CHECK(ServiceManagerAddress::of_environment()->watchdog == Duration{0});
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  setenv("WATCHDOG_USEC", "soon", 1);
  CHECK(ServiceManagerAddress::of_environment()->watchdog == Duration{0});
}

// [exec-34]
void a_running_application_tells_of_itself() {
  NotifyListener listener;
  const Environment environment;
  setenv("NOTIFY_SOCKET", listener.name().c_str(), 1);
  setenv("WATCHDOG_USEC", "20000", 1);
  const auto hears = [&](const std::string& message) {
    return wait_until([&] { return listener.next() == message; });
  };
  // While nobody listens the socket fills, and what finds it full is told again: it comes to its end only
  // when all was heard.
  std::atomic<bool> may_rest{false};
  Plan plan;
  plan.unit(Plan::producer).script.is_idle = [&](const TestUnit&) { return may_rest.load(); };
  RunningCell running(plan);
  running.start();
  CHECK(hears("READY=1"));
  for (int i = 0; i < 3; ++i) CHECK(hears("WATCHDOG=1"));
  running.stop();
  CHECK(hears("STOPPING=1"));
  may_rest = true;
  CHECK_EQUAL(running.join().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::fixture::heartbeat_test

int main() {
  using namespace flexrf::fixture::heartbeat_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(nobody_is_judged_before_somebody_asks),
      CONTAINED_TEST(it_is_met_while_every_thread_turns),
      CONTAINED_TEST(a_silent_thread_is_rung_then_named_and_comes_back),
      CONTAINED_TEST(a_judgement_holds_for_a_second),
      CONTAINED_TEST(after_the_watch_itself_stood_still_nobody_is_blamed),
      CONTAINED_TEST(what_is_given_up_misses_it),
      CONTAINED_TEST(a_thread_with_nothing_to_do_answers),
      CONTAINED_TEST(a_step_that_hangs_misses_it),
      CONTAINED_TEST(the_manager_is_told_how_it_stands),
      CONTAINED_TEST(the_manager_hears_the_heartbeat_twice_in_its_interval_and_only_while_it_is_met),
      CONTAINED_TEST(nobody_listens_and_nothing_happens),
      CONTAINED_TEST(the_environment_says_who_listens),
      CONTAINED_TEST(a_running_application_tells_of_itself),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
