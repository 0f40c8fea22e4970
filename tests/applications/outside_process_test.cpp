// What comes from outside of a running application: readers that take nothing, signals of every kind, closed
// descriptors, a process that is stopped and goes on.
#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <vector>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "runtime/executive/tests/notify_listener.hpp"
#include "tests/applications/process.hpp"
#include "tests/applications/trial_process.hpp"

namespace flexrf::whole {
namespace {

using namespace trial;

const std::string application = place::application;

std::vector<std::string> words(const std::vector<std::string>& more = {}) {
  return command_line(application, more);
}

void start_moving(const Folder& folder, Process& process, const std::string& keys = "d") {
  process.type(keys);
  wait_until_moving(folder);
}

// ---- readers that take nothing

/// A pipe that takes nothing any more, and that nobody reads.
class FullPipe {
 public:
  FullPipe() {
    // The process leaves the thread behind that writes to it. The thread sanitizer would say so, to this
    // pipe, and wait for its reader.
    CHECK(setenv("TSAN_OPTIONS", "report_thread_leaks=0", 1) == 0);
    CHECK(pipe2(ends_, O_CLOEXEC) == 0);
    CHECK(fcntl(ends_[1], F_SETFL, O_NONBLOCK) == 0);
    const std::string block(4096, '.');
    while (write(ends_[1], block.data(), block.size()) > 0) {
    }
    CHECK(fcntl(ends_[1], F_SETFL, 0) == 0);
  }
  ~FullPipe() {
    unsetenv("TSAN_OPTIONS");
    close(ends_[0]);
    close(ends_[1]);
  }
  FullPipe(const FullPipe&) = delete;
  FullPipe& operator=(const FullPipe&) = delete;
  int end() const { return ends_[1]; }

 private:
  int ends_[2];
};

// [stop-56]
void a_full_standard_error_holds_up_no_stop() {
  for (const int signal : {SIGTERM, SIGINT}) {
    const Folder folder;
    const FullPipe pipe;
    Process process(folder, words(), Input::pipe, [&] { dup2(pipe.end(), STDERR_FILENO); });
    start_moving(folder, process);
    process.send(signal);
    CHECK_EQUAL(process.wait().exit_code, 128 + signal);
    CHECK_EQUAL(drive_log(folder), moving + at_rest);
  }
}

// [stop-56]
void a_full_standard_error_hides_no_hang() {
  const Folder folder;
  const FullPipe pipe;
  Process process(folder, words(), Input::pipe, [&] { dup2(pipe.end(), STDERR_FILENO); });
  start_moving(folder, process);
  process.type("h");
  CHECK_EQUAL(process.wait().exit_code, 2);
  CHECK_EQUAL(drive_log(folder), moving + last_gasp);
}

// [stop-56]
void a_full_standard_error_holds_up_no_heartbeat() {
  const Folder folder;
  const FullPipe pipe;
  const fixture::NotifyListener manager;
  std::vector<std::string> all{"env", "NOTIFY_SOCKET=" + manager.name(), "WATCHDOG_USEC=20000"};
  for (const std::string& word : words()) all.push_back(word);
  Process process(folder, all, Input::pipe, [&] { dup2(pipe.end(), STDERR_FILENO); });
  start_moving(folder, process);
  // Its socket holds fewer than this: they were sent while nobody read standard error.
  for (int i = 0; i < 100; ++i) CHECK(wait_until([&] { return manager.next() == "WATCHDOG=1"; }));
  process.send(SIGTERM);
  CHECK(wait_until([&] { return manager.next() == "STOPPING=1"; }));
  CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
}

/// The guards of the checked build, too: what was prepared comes before what they say.
// [stop-27]
void a_full_standard_error_holds_up_no_last_gasp() {
  for (const char* const key : {"s", "a", "x", "k", "o"}) {
    const Folder folder;
    const FullPipe pipe;
    Process process(folder, words(), Input::pipe, [&] { dup2(pipe.end(), STDERR_FILENO); });
    start_moving(folder, process);
    process.type(key);
#if !FLEXRF_CHECKED || FLEXRF_SANITIZER
    if (*key == 'k' || *key == 'o') process.send(SIGABRT);
#endif
    process.wait();
    CHECK_EQUAL(drive_log(folder), moving + last_gasp);
  }
}

// [stop-56]
void a_full_standard_output_is_told_and_left() {
  const Folder folder;
  const FullPipe pipe;
  Process process(folder, words(), Input::pipe, [&] { dup2(pipe.end(), STDOUT_FILENO); });
  start_moving(folder, process);
  process.send(SIGTERM);
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.exit_code, 128 + SIGTERM);
  CHECK_CONTAINS(ending.errors, "nobody reads standard output");
  CHECK_EQUAL(drive_log(folder), moving + at_rest);
}

/// A run that came to its end by itself, and has its report to say to a pipe that nobody reads.
void run_to_the_unread_report(const Folder& folder, Process& process) {
  process.type("d");
  process.end_input();
  CHECK(wait_until([&] { return drive_log(folder).ends_with("safe\n"); }));
}

/// Whose input has ended waits for its reader, as every program does; whoever is tired of that says so.
// [stop-59] [stop-60] [stop-72]
void a_reader_that_is_slow_gets_the_report_and_a_signal_ends_the_wait() {
  const Folder folder;
  const FullPipe pipe;
  Process process(folder, words(), Input::pipe, [&] { dup2(pipe.end(), STDOUT_FILENO); });
  run_to_the_unread_report(folder, process);
  usleep(300'000);
  CHECK(!process.has_ended());
  process.send(SIGTERM);
  CHECK_EQUAL(process.wait().exit_code, 1);
}

/// Wherever in the end it comes: whoever asks need not ask twice.
// [stop-59] [stop-60]
void a_signal_just_before_the_report_ends_the_wait_for_its_reader() {
  for (const useconds_t later : {0U, 500U, 2'000U, 8'000U, 30'000U}) {
    const Folder folder;
    const FullPipe pipe;
    Process process(folder, words(), Input::pipe, [&] { dup2(pipe.end(), STDOUT_FILENO); });
    run_to_the_unread_report(folder, process);
    usleep(later);
    process.send(SIGTERM);
    CHECK_EQUAL(process.wait().exit_code, 1);
  }
}

// [stop-60]
void a_standard_output_that_fails_is_an_error() {
  const Folder folder;
  Process process(folder, words(), Input::pipe, [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); });
  process.end_input();
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.exit_code, 1);
  CHECK_CONTAINS(ending.errors, "standard output: No space left on device");
}

/// SIGPIPE and SIGXFSZ would have ended it without a word.
// [stop-82]
void a_write_that_fails_says_why() {
  const Folder folder;
  Process unread(folder, words(), Input::pipe, [] {
    int ends[2];
    if (pipe(ends) == 0 && close(ends[0]) == 0) dup2(ends[1], STDOUT_FILENO);
  });
  unread.end_input();
  const Ending broken = unread.wait();
  CHECK_EQUAL(broken.exit_code, 1);
  CHECK_CONTAINS(broken.errors, "standard output: Broken pipe");
  const Folder small;
  const Ending large = run(small, {"prlimit", "--fsize=2000", application, "--report", "report"});
  CHECK_EQUAL(large.exit_code, 1);
  CHECK_CONTAINS(large.errors, "File too large");
}

/// A device that is full, as a disk. In each way in which a run ends.
// [stop-103]
void a_standard_error_that_fails_is_an_error() {
  for (const bool is_ended : {false, true}) {
    const Folder folder;
    Process process(folder, words(), Input::pipe, [] { dup2(open("/dev/full", O_WRONLY), STDERR_FILENO); });
    start_moving(folder, process);
    is_ended ? process.send(SIGTERM) : process.end_input();
    CHECK_EQUAL(process.wait().exit_code, 1);
  }
}

// [stop-103]
void a_reader_of_standard_error_that_went_away_is_none() {
  const Folder folder;
  Process process(folder, words(), Input::pipe, [] {
    int ends[2];
    if (pipe(ends) == 0 && close(ends[0]) == 0) dup2(ends[1], STDERR_FILENO);
  });
  start_moving(folder, process);
  process.end_input();
  CHECK_EQUAL(process.wait().exit_code, 0);
}

/// The application starts, or says why it does not: neither a bare signal nor an exception that nobody
/// catches.
// [stop-105] [stop-106]
void a_limit_of_the_process_is_told() {
#if !defined(__SANITIZE_THREAD__)  // it writes a file of its own before main() begins
  const Folder small;
  const Ending file = run(small, {"prlimit", "--fsize=0", application, "--report", "report"});
  CHECK_EQUAL(file.exit_code, 1);
#endif
  for (const char* const bytes : {"65536", "131072", "262144", "393216"}) {
    const Folder folder;
    const Ending stack = run(folder, {"prlimit", std::string{"--stack="} + bytes, application});
    CHECK_EQUAL(stack.exit_code, 1);
    CHECK_CONTAINS(stack.errors, "trial: the limit of the stack (RLIMIT_STACK) is ");
    CHECK_CONTAINS(stack.errors, "ulimit -s");
  }
  const Folder folder;
  CHECK_EQUAL(run(folder, {"prlimit", "--stack=524288", application}).exit_code, 0);
}

/// A service is always ended by a signal: what failed is not to hide behind that.
// [stop-62]
void a_standard_output_that_fails_is_seen_behind_a_signal() {
  const Folder folder;
  Process process(folder, words(), Input::pipe, [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); });
  start_moving(folder, process);
  process.send(SIGTERM);
  CHECK_EQUAL(process.wait().exit_code, 1);
}

void an_answer_that_is_not_written_is_an_error() {
  for (const char* const option : {"--help", "--version", "--descriptor", "--drivers"}) {
    const Folder folder;
    Process process(folder, {application, option}, Input::pipe,
                    [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); });
    const Ending ending = process.wait();
    CHECK_EQUAL(ending.exit_code, 1);
    CHECK_CONTAINS(ending.errors, "standard output: No space left on device");
  }
}

// ---- signals

// [stop-47] [stop-49] [stop-90]
void what_somebody_ends_it_with_is_a_controlled_stop() {
  for (const int signal : {SIGPWR, SIGQUIT}) {
    const Folder folder;
    Process process(folder, words());
    start_moving(folder, process, "dn");
    if (signal == SIGPWR) process.type("m");
    process.send(signal);
    if (signal == SIGPWR) process.send(SIGTERM);  // it does not come to rest, as it was told
    const Ending ending = process.wait();
    CHECK(ending.exit_code > 128);
    CHECK_EQUAL(ending.signal, 0);  // the kernel writes a core file of what a signal ends
    // SIGQUIT does not wait for units to come to rest.
    CHECK_EQUAL(drive_log(folder), moving + while_moving);
    CHECK_EQUAL(Report(folder / "report")["run"].at("cause").get<std::string>(), "signal");
  }
}

// [stop-22] [stop-50] [stop-51]
void what_takes_the_process_away_is_preceded_by_the_last_gasp() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP, SIGXCPU}) {
    const Folder folder;
    Process process(folder, words());
    start_moving(folder, process);
    process.send(signal);
    const Ending ending = process.wait();
    CHECK_EQUAL(ending.signal, signal);
    CHECK_CONTAINS(ending.errors, "prepared outputs written: 1");
    CHECK_EQUAL(drive_log(folder), moving + last_gasp);
  }
}

// [stop-54] [stop-55]
void what_means_nothing_changes_nothing_and_is_told() {
  std::vector<int> signals{SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF,  SIGIO,  SIGSTKFLT,
                           SIGPIPE, SIGXFSZ, SIGCHLD, SIGURG,    SIGWINCH, SIGCONT};
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) signals.push_back(signal);
  const Folder folder;
  Process process(folder, words());
  start_moving(folder, process);
  for (const int signal : signals) process.send(signal);
  process.wait_for_error("SIGUSR1 from process " + std::to_string(getpid()) + " has no meaning here");
  process.type("m");
  process.send(SIGTERM);
  CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
  CHECK_EQUAL(drive_log(folder), moving + at_rest);
}

// [stop-48]
void nohup_is_respected() {
  const Folder folder;
  Process process(folder, words(), Input::pipe, [] { std::signal(SIGHUP, SIG_IGN); });
  start_moving(folder, process);
  process.send(SIGHUP);
  usleep(100'000);
  CHECK(!process.has_ended());
  process.send(SIGTERM);
  CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
}

// [stop-51]
void a_real_time_thread_that_never_waits_is_ended_by_the_kernel_and_leaves_the_drive_safe() {
#if FLEXRF_SANITIZER
  skip();
#endif
  const Folder folder;
  // 0.2 s, then SIGXCPU; SIGKILL would follow after 2 s.
  Process process(folder, {"prlimit", "--rttime=200000:2000000", application, "--report", "report"});
  start_moving(folder, process);
  process.type("w");
  const Ending ending = process.wait();
  if (geteuid() != 0) skip();  // without the rights no thread is real-time
  CHECK_EQUAL(ending.signal, SIGXCPU);
  CHECK_CONTAINS(ending.errors, "SIGXCPU (limit of processor time");
  CHECK_EQUAL(drive_log(folder), moving + last_gasp);
}

// ---- stopped, and going on

// [stop-52] [stop-53] [stop-83]
void whoever_stops_it_finds_its_actuators_inhibited() {
  for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) {
    const Folder folder;
    Process process(folder, words({"--standstill-limit", "3s"}));
    start_moving(folder, process);
    process.send(signal);
    process.wait_until_stopped();
    CHECK_EQUAL(drive_log(folder), moving + "inhibited\n");
    usleep(3'500'000);
    process.send(SIGCONT);
    process.wait_for_error("nothing moves before a Start");
    // Had it been let go of in between, its drive would say again that it is inhibited.
    process.send(signal);
    process.wait_until_stopped();
    CHECK_EQUAL(drive_log(folder), moving + "inhibited\n");
    process.send(SIGCONT);
    process.send(SIGTERM);
    // Somebody wanted it so: no fault.
    CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
  }
}

// [stop-44] [stop-45]
void a_process_that_stood_still_says_so_and_moves_nothing() {
  const Folder folder;
  Process process(folder, words({"--standstill-limit", "3s"}));
  start_moving(folder, process);
  process.send(SIGSTOP);
  process.wait_until_stopped();
  usleep(4'000'000);
  process.send(SIGCONT);
  process.wait_for_error("the process stood still for ");
  process.wait_for_error("motion is stopped: clear the stop and give Start");
  CHECK(wait_until([&] { return drive_log(folder) == moving + "inhibited\n"; }));
  process.send(SIGTERM);
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.exit_code, 2);
  CHECK_CONTAINS(ending.output, "stood still for ");
  const Report report(folder / "report");
  CHECK(report.row("threads", "sabotage").at("longest_standstill_ns").get<std::int64_t>() > 1'000'000'000);
  CHECK(report.row("threads", "sabotage").at("skipped_time_ns").get<std::int64_t>() > 1'000'000'000);
}

// [stop-46]
void a_shorter_stop_is_a_warning() {
  const Folder folder;
  Process process(folder, words());
  start_moving(folder, process);
  process.send(SIGSTOP);
  process.wait_until_stopped();
  usleep(300'000);
  process.send(SIGCONT);
  process.wait_for_error("overrun: ");
  process.wait_for_error(" left out");
  process.send(SIGTERM);
  CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
}

// ---- the terminal

tcflag_t modes_of(const Process& process) {
  termios settings{};
  CHECK(tcgetattr(process.terminal(), &settings) == 0);
  return settings.c_lflag & (ICANON | ECHO);
}

// [stop-25]
void the_terminal_comes_back_from_every_signal() {
  for (const int signal : {SIGQUIT, SIGXCPU, SIGSYS, SIGTRAP, SIGPWR}) {
    const Folder folder;
    Process process(folder, words(), Input::terminal);
    CHECK(wait_until([&] { return modes_of(process) == 0; }));
    process.wait_for_error("autostart");
    process.send(signal);
    process.wait();
    CHECK_EQUAL(modes_of(process), static_cast<tcflag_t>(ICANON | ECHO));
  }
}

// [stop-52]
void control_z_lends_the_terminal_back_and_fg_takes_it() {
  const Folder folder;
  Process process(folder, words(), Input::terminal);
  CHECK(wait_until([&] { return modes_of(process) == 0; }));
  process.wait_for_error("autostart");
  process.type("\x1a");
  process.wait_until_stopped();
  CHECK_EQUAL(modes_of(process), static_cast<tcflag_t>(ICANON | ECHO));
  process.send(SIGCONT);
  CHECK(wait_until([&] { return modes_of(process) == 0; }));
  process.type("\x04");
  CHECK_EQUAL(process.wait().exit_code, 0);
}

/// As by Ctrl-S, or behind a line that is cut: the terminal takes nothing any more.
// [stop-56]
void a_terminal_that_is_held_holds_up_no_stop() {
  const Folder folder;
  Process process(folder, words(), Input::terminal, [] {
    dup2(STDIN_FILENO, STDOUT_FILENO);
    const int terminal = open("/dev/tty", O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    const char block[256] = {};
    while (write(terminal, block, sizeof(block)) > 0) {
    }
  });
  CHECK(wait_until([&] { return modes_of(process) == 0; }));
  process.wait_for_error("autostart");
  process.send(SIGTERM);
  CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
  CHECK_EQUAL(modes_of(process), static_cast<tcflag_t>(ICANON | ECHO));
}

// ---- descriptors

/// A file that is opened takes the number of one that is closed: it must not be read as keys, or written
/// over.
// [stop-64]
void closed_descriptors_are_nobodys() {
  for (const int closed : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const Folder folder;
    Process process(folder, words(), Input::pipe, [&] { close(closed); });
    if (closed == STDIN_FILENO) {
      // No input: the end of it.
      CHECK_EQUAL(process.wait().exit_code, 0);
      CHECK_EQUAL(Report(folder / "report").last("saboteur.feedback").at("keys_done").get<int>(), 0);
    } else {
      start_moving(folder, process);
      process.send(SIGTERM);
      CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
    }
    const std::string lock = contents_of(folder / "flexrf-trial.lock");
    CHECK(lock.starts_with("process "));
    CHECK_EQUAL(lock.find('\n'), lock.size() - 1);
  }
}

// ---- input without end

/// `yes ''`: bytes that are no key presses, as fast as they are taken.
void bytes_that_are_no_keys_harm_nothing() {
  const Folder folder;
  Process process(folder, words());
  process.type("d" + std::string(10'000, '\n') + "m");
  CHECK(wait_until([&] { return drive_log(folder) == moving; }));
  process.end_input();
  CHECK_EQUAL(process.wait().exit_code, 0);
  const Report report(folder / "report");
  CHECK_EQUAL(report.last("saboteur.feedback").at("keys_done").get<int>(), 2);
  CHECK_EQUAL(report["faults"].get<int>(), 0);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_full_standard_error_holds_up_no_stop),
      CONTAINED_TEST(a_full_standard_error_hides_no_hang),
      CONTAINED_TEST(a_full_standard_error_holds_up_no_heartbeat),
      CONTAINED_TEST(a_full_standard_error_holds_up_no_last_gasp),
      CONTAINED_TEST(a_full_standard_output_is_told_and_left),
      CONTAINED_TEST(a_reader_that_is_slow_gets_the_report_and_a_signal_ends_the_wait),
      CONTAINED_TEST(a_signal_just_before_the_report_ends_the_wait_for_its_reader),
      CONTAINED_TEST(a_standard_output_that_fails_is_an_error),
      CONTAINED_TEST(a_write_that_fails_says_why),
      CONTAINED_TEST(a_standard_error_that_fails_is_an_error),
      CONTAINED_TEST(a_reader_of_standard_error_that_went_away_is_none),
      CONTAINED_TEST(a_limit_of_the_process_is_told),
      CONTAINED_TEST(a_standard_output_that_fails_is_seen_behind_a_signal),
      CONTAINED_TEST(an_answer_that_is_not_written_is_an_error),
      CONTAINED_TEST(what_somebody_ends_it_with_is_a_controlled_stop),
      CONTAINED_TEST(what_takes_the_process_away_is_preceded_by_the_last_gasp),
      CONTAINED_TEST(what_means_nothing_changes_nothing_and_is_told),
      CONTAINED_TEST(nohup_is_respected),
      CONTAINED_TEST(a_real_time_thread_that_never_waits_is_ended_by_the_kernel_and_leaves_the_drive_safe),
      CONTAINED_TEST(whoever_stops_it_finds_its_actuators_inhibited),
      CONTAINED_TEST(a_process_that_stood_still_says_so_and_moves_nothing),
      CONTAINED_TEST(a_shorter_stop_is_a_warning),
      CONTAINED_TEST(the_terminal_comes_back_from_every_signal),
      CONTAINED_TEST(control_z_lends_the_terminal_back_and_fg_takes_it),
      CONTAINED_TEST(a_terminal_that_is_held_holds_up_no_stop),
      CONTAINED_TEST(closed_descriptors_are_nobodys),
      CONTAINED_TEST(bytes_that_are_no_keys_harm_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
