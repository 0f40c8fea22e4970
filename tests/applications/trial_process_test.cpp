// Each level of stopping on each of its causes, in a process: what is written to the drive, to the terminal
// and to the report, and how the process ends.
#include "tests/applications/trial_process.hpp"

#include <termios.h>
#include <unistd.h>

#include <cmath>
#include <csignal>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

using namespace trial;

const std::string application = place::application;

std::vector<std::string> words() {
  return command_line(application);
}

std::string fault_of(const Report& report, const char* array, const std::string& component) {
  const nlohmann::json& fault = report.row(array, component).at("fault");
  return fault.is_null() ? "" : fault.get<std::string>();
}

std::string cause_of(const Report& report) {
  return report["run"].at("cause");
}

enum class More : std::uint8_t { may_come, none };

/// Types the keys to an application whose drive moves, and waits for how it ends.
Ending ending_in_motion(const Folder& folder, const std::string& keys, More more = More::may_come) {
  Process process(folder, words());
  process.type("d");
  wait_until_moving(folder);
  process.type(keys);
  if (more == More::none) process.end_input();
  return process.wait();
}

// ---- faults: the unit's own device is made safe, everything else goes on

void check_survived_fault(const std::string& keys, const std::string& cause) {
  const Folder folder;
  Process process(folder, words());
  process.type(keys);
  process.wait_for_error(cause);
  process.send(SIGTERM);
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.exit_code, 2);
  CHECK_CONTAINS(ending.output, cause);
  CHECK_EQUAL(drive_log(folder), moving + while_moving);
  const Report report(folder / "report");
  CHECK_CONTAINS(fault_of(report, "units", "saboteur"), cause);
  CHECK_EQUAL(report["faults"].get<int>(), 1);
  // The arm's unit lived on and knew why it had no target.
  CHECK_EQUAL(report.row("units", "robot").at("life").get<std::string>(), "stopped");
  CHECK_EQUAL(cause_of(report), "signal");
}

// [stop-36] [stop-37] [stop-73]
void a_fault_makes_its_own_device_safe() {
  check_survived_fault("ddddddddddddf", "told to fail");
}
void an_exception_is_a_fault_with_its_text() {
#if FLEXRF_CHECKED
  // To throw is to allocate: in a real-time thread the guard is there first.
  const Folder folder;
  const Ending ending = ending_in_motion(folder, "t");
  CHECK_EQUAL(ending.signal, SIGABRT);
  CHECK_CONTAINS(ending.errors, "__cxa_allocate_exception");
#else
  check_survived_fault("ddddddddddddt", "a library's text");
#endif
}

// [stop-41]
void a_hung_step_ends_in_the_last_gasp() {
  const Folder folder;
  const Ending ending = ending_in_motion(folder, "h");
  CHECK_EQUAL(ending.exit_code, 2);
  CHECK_CONTAINS(ending.errors, "step does not return");
  CHECK_CONTAINS(ending.output, "\nFault: thread sabotage: its step does not return; ");
  CHECK_EQUAL(drive_log(folder), moving + last_gasp);
  const Report report(folder / "report");
  CHECK(report["run"].at("stuck").get<bool>());
  CHECK(report.row("threads", "sabotage").at("hangs").get<bool>());
  CHECK(!report.row("threads", "control").at("hangs").get<bool>());
}

// ---- signals

// [stop-17] [stop-47] [stop-48] [stop-75]
void a_signal_is_a_controlled_stop() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Folder folder;
    Process process(folder, words());
    process.type("dm");
    wait_until_moving(folder);
    process.send(signal);
    CHECK_EQUAL(process.wait().exit_code, 128 + signal);
    CHECK_EQUAL(drive_log(folder), moving + at_rest);
    const Report report(folder / "report");
    CHECK(!report["run"].at("cut_short").get<bool>());
    CHECK_EQUAL(report["run"].at("signal").get<int>(), signal);
  }
}

// [stop-18]
void stop_timeout_ends_what_does_not_come_to_rest() {
  const Folder folder;
  Process process(folder, words());
  process.type("nd");
  wait_until_moving(folder);
  process.send(SIGTERM);
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.exit_code, 128 + SIGTERM);
  CHECK_CONTAINS(ending.errors, "not at rest within stop_timeout");
  CHECK_EQUAL(drive_log(folder), moving + while_moving);
  CHECK(Report(folder / "report")["run"].at("cut_short").get<bool>());
}

// [stop-47]
void a_second_signal_does_not_wait() {
  const Folder folder;
  Process process(folder, words());
  process.type("nd");
  wait_until_moving(folder);
  process.send(SIGINT);
  process.wait_for_error("does not come to rest");
  process.send(SIGINT);
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.exit_code, 128 + SIGINT);
  CHECK_EQUAL(ending.errors.find("stop_timeout"), std::string::npos);
  CHECK_EQUAL(drive_log(folder), moving + while_moving);
}

// [stop-22] [stop-50]
void crash_signals_write_the_last_gasp() {
  struct Case {
    char key;
    int signal;
    const char* name;
  };
  for (const Case& one : {Case{'s', SIGSEGV, "SIGSEGV"}, Case{'a', SIGABRT, "SIGABRT"}}) {
    const Folder folder;
    const Ending ending = ending_in_motion(folder, std::string{one.key});
    CHECK_EQUAL(ending.exit_code, -1);
    CHECK_EQUAL(ending.signal, one.signal);
    CHECK_CONTAINS(ending.errors, std::string{"flexrf: "} + one.name);
    CHECK_CONTAINS(ending.errors, " while stepping saboteur; prepared outputs written: 1\n");
    CHECK_EQUAL(drive_log(folder), moving + last_gasp);
  }
}

void check_leaving(const char* key, const std::string& call) {
  const Folder folder;
  const Ending ending = ending_in_motion(folder, key);
  CHECK_EQUAL(ending.exit_code, 2);
  CHECK_CONTAINS(ending.errors,
                 call + " was called while the application ran, in saboteur; prepared outputs written: 1");
  CHECK_EQUAL(drive_log(folder), moving + last_gasp);
}

// [stop-23] [stop-99]
void exit_from_a_unit_writes_the_last_gasp() {
  check_leaving("x", "exit()");
  check_leaving("q", "quick_exit()");
}

// [stop-100]
void an_exit_without_handlers_writes_the_last_gasp() {
#if FLEXRF_SANITIZER
  skip();
#endif
  check_leaving("y", "_exit()");
  check_leaving("z", "_Exit()");
}

/// What a child does on its way out would brake the drive of a process that goes on.
// [stop-99]
void a_childs_exit_is_its_own() {
#if FLEXRF_CHECKED
  skip();  // no real-time thread may start a process there
#endif
  const Folder folder;
  Process process(folder, words());
  process.type("d");
  wait_until_moving(folder);
  process.type("cm");
  usleep(300'000);
  CHECK_EQUAL(drive_log(folder), moving);
  process.send(SIGTERM);
  CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
  CHECK_EQUAL(drive_log(folder), moving + at_rest);
}

// [stop-101]
void signals_that_a_unit_ignores_do_what_they_did() {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Folder folder;
    Process process(folder, words());
    process.type("d");
    wait_until_moving(folder);
    process.type("im");
    usleep(200'000);
    process.send(signal);
    CHECK_EQUAL(process.wait().exit_code, 128 + signal);
    CHECK_EQUAL(drive_log(folder), moving + at_rest);
  }
}

// [stop-102]
void the_handler_of_a_crash_is_put_back() {
  const Folder folder;
  Process process(folder, words());
  process.type("d");
  wait_until_moving(folder);
  process.type("v");
  process.wait_for_error("SIGSEGV was given to another handler");
  process.type("s");
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.signal, SIGSEGV);
  CHECK_CONTAINS(ending.errors, "prepared outputs written: 1");
  CHECK_EQUAL(drive_log(folder), moving + last_gasp);
}

// ---- the end of the input

// [stop-29] [stop-30] [stop-71]
void the_end_of_input_is_the_gentlest() {
  const Folder folder;
  const Ending ending = run(folder, words(), "ddddm");
  CHECK_EQUAL(ending.exit_code, 0);
  CHECK(drive_log(folder).ends_with(at_rest));
  const Report report(folder / "report");
  CHECK(!report["run"].at("cut_short").get<bool>());
  CHECK_EQUAL(cause_of(report), "end of input");
  // The last key had its effect: the arm went where it was sent.
  CHECK_EQUAL(report.last("saboteur.feedback").at("keys_done").get<int>(), 5);
  const double off = report.last("target").at("position").at(1).get<double>() -
                     report.last("tool_pose").at("position").at(1).get<double>();
  CHECK(std::abs(off) < 1e-3);
}

// [stop-31]
void finish_timeout_ends_what_does_not_finish() {
  const Folder folder;
  const Ending ending = run(folder, words(), "dn");
  CHECK_EQUAL(ending.exit_code, 0);
  CHECK_CONTAINS(ending.errors, "not finished within finish_timeout");
  CHECK(Report(folder / "report")["run"].at("cut_short").get<bool>());
}

// ---- what must not be done in a real-time thread

/// Linked with the guard: the checked build ends with a trace, others count.
// [exec-27] [exec-28] [exec-32]
void an_allocation_is_caught() {
#if FLEXRF_SANITIZER
  skip();  // the sanitizers' own allocator, and no guard
#endif
  const Folder folder;
  const Ending ending = ending_in_motion(folder, "kk", More::none);
#if FLEXRF_CHECKED
  CHECK_EQUAL(ending.signal, SIGABRT);
  CHECK_CONTAINS(ending.errors,
                 "malloc called in a real-time thread, where nothing may be allocated or freed:");
  CHECK_CONTAINS(ending.errors, " while stepping saboteur");
  CHECK_EQUAL(drive_log(folder), moving + last_gasp);
#else
  CHECK_EQUAL(ending.exit_code, 0);
  const Report report(folder / "report");
  // Each k allocates and frees.
  CHECK_EQUAL(report.row("threads", "sabotage").at("allocations").get<int>(), 4);
  CHECK_EQUAL(report.row("threads", "control").at("allocations").get<int>(), 0);
  CHECK(report["memory"].at("allocation_guard").get<bool>());
#endif
}

/// Only the checked build filters system calls.
// [exec-30] [exec-31] [exec-32]
void a_system_call_that_may_wait_is_caught() {
  const Folder folder;
  const Ending ending = ending_in_motion(folder, "oo", More::none);
#if FLEXRF_CHECKED
  CHECK_EQUAL(ending.signal, SIGABRT);
  CHECK_CONTAINS(ending.errors, "flexrf: system call openat (");
  CHECK_CONTAINS(ending.errors, " in the real-time thread sabotage, in the step of saboteur, ");
  CHECK_CONTAINS(ending.errors, "open, map and start things in initialise()");
  CHECK_CONTAINS(ending.errors, "/trial(");  // the trace
  CHECK_CONTAINS(ending.errors, " while stepping saboteur; prepared outputs written: 1");
  CHECK_EQUAL(drive_log(folder), moving + last_gasp);
#else
  CHECK_EQUAL(ending.exit_code, 0);
#endif
}

// ---- the terminal

termios settings_of(const Process& process) {
  termios settings{};
  CHECK(tcgetattr(process.terminal(), &settings) == 0);
  return settings;
}

/// Raw while it runs, and afterwards as it was, however it ends.
// [stop-25]
void the_terminal_is_restored_on_every_exit() {
  struct Case {
    const char* keys;
    int signal;
  };
  for (const Case& one : {Case{"s", 0}, Case{"a", 0}, Case{"x", 0}, Case{"h", 0}, Case{"\x04", 0},
                          Case{"\x03", 0}, Case{"", SIGTERM}}) {
    const Folder folder;
    Process process(folder, words(), Input::terminal);
    CHECK(wait_until([&] { return (settings_of(process).c_lflag & (ICANON | ECHO)) == 0; }));
    process.wait_for_error("autostart");
    process.type(one.keys);
    if (one.signal != 0) process.send(one.signal);
    process.wait();
    const tcflag_t cooked = ICANON | ECHO;
    if ((settings_of(process).c_lflag & cooked) != cooked)
      throw fixture::CheckFailed{std::string{"the terminal is still raw after the key "} + one.keys};
  }
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_fault_makes_its_own_device_safe),
      CONTAINED_TEST(an_exception_is_a_fault_with_its_text),
      CONTAINED_TEST(a_hung_step_ends_in_the_last_gasp),
      CONTAINED_TEST(a_signal_is_a_controlled_stop),
      CONTAINED_TEST(stop_timeout_ends_what_does_not_come_to_rest),
      CONTAINED_TEST(a_second_signal_does_not_wait),
      CONTAINED_TEST(crash_signals_write_the_last_gasp),
      CONTAINED_TEST(exit_from_a_unit_writes_the_last_gasp),
      CONTAINED_TEST(an_exit_without_handlers_writes_the_last_gasp),
      CONTAINED_TEST(a_childs_exit_is_its_own),
      CONTAINED_TEST(signals_that_a_unit_ignores_do_what_they_did),
      CONTAINED_TEST(the_handler_of_a_crash_is_put_back),
      CONTAINED_TEST(the_end_of_input_is_the_gentlest),
      CONTAINED_TEST(finish_timeout_ends_what_does_not_finish),
      CONTAINED_TEST(an_allocation_is_caught),
      CONTAINED_TEST(a_system_call_that_may_wait_is_caught),
      CONTAINED_TEST(the_terminal_is_restored_on_every_exit),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
