#include "runtime/realtime/system_call_filter.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <thread>

#include "runtime/blackboard/doorbell.hpp"
#include "runtime/realtime/last_gasp.hpp"
#include "runtime/realtime/thread_setup.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

struct Call {
  const char* name;  ///< as the message has it
  void (*call)();
};

constexpr timespec moment{0, 1000};

// What each gives back is of no interest: it does not come back.
template <class Value>
void ignore(Value /*value*/) {}

const Call caught[] = {
    {"openat", [] { ignore(open("/dev/null", O_RDONLY | O_CLOEXEC)); }},
    {"fsync", [] { ignore(fsync(STDERR_FILENO)); }},
    {"clock_nanosleep", [] { nanosleep(&moment, nullptr); }},
    {"mmap", [] { ignore(mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)); }},
    {"munmap", [] { ignore(munmap(nullptr, 4096)); }},
    {"clone", [] { ignore(fork()); }},
    {"execve", [] { ignore(execl("/bin/true", "true", static_cast<char*>(nullptr))); }},
    {"pause", [] { pause(); }},
    {"poll", [] { poll(nullptr, 0, 11); }},
    {"poll", [] { poll(nullptr, 0, -1); }},
    {"accept4", [] { ignore(accept4(-1, nullptr, nullptr, SOCK_CLOEXEC)); }},
    {"socket", [] { ignore(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)); }},
};

struct Outcome {
  int signal;
  int exit_code;
  char message[8192];
};

/// The body of a filtered thread; 0 or what went wrong.
using Body = int (*)();
int result_of_body;

/// From here on this process is told that its kernel knows nothing of filters.
bool lose_filters() {
  const scmp_filter_ctx context = seccomp_init(SCMP_ACT_ALLOW);
  const bool lost =
      context != nullptr &&
      seccomp_rule_add_array(context, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(seccomp), 0, nullptr) == 0 &&
      seccomp_load(context) == 0;
  seccomp_release(context);
  return lost;
}

/// A process with a thread that is made as the executive makes them, and filtered before its body.
void run_in_child(Body body, Outcome& outcome, bool has_filters = true) {
  int ends[2];
  outcome = {};
  if (pipe(ends) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    std::signal(SIGABRT, SIG_DFL);
    dup2(ends[1], STDERR_FILENO);
    close(ends[1]);
    if (!has_filters && !lose_filters()) _exit(94);
    // Here, as CMocka handles SIGSYS too.
    const Status prepared = prepare_system_call_filter();
    if (prepared.is_ok() != has_filters) _exit(93);
    if (!has_filters) dprintf(STDERR_FILENO, "%s", prepared.cause());
    ThreadSettings settings;
    settings.name = "filtered";
    RunningThread thread;
    const Status status = thread.start(
        settings,
        [](void* argument) {
          if (!filter_system_calls("the thread's name")) _exit(90);
          result_of_body = reinterpret_cast<Body>(argument)();
        },
        reinterpret_cast<void*>(body));
    thread.join();
    // Only that thread was filtered.
    const int file = open("/dev/null", O_RDONLY | O_CLOEXEC);
    _exit(!status || file < 0 ? 91 : result_of_body);
  }
  close(ends[1]);
  std::size_t size = 0;
  ssize_t count = 0;
  while (size < sizeof(outcome.message) - 1 &&
         (count = read(ends[0], outcome.message + size, sizeof(outcome.message) - 1 - size)) > 0)
    size += static_cast<std::size_t>(count);
  close(ends[0]);
  int result = 0;
  waitpid(child, &result, 0);
  outcome.signal = WIFSIGNALED(result) ? WTERMSIG(result) : 0;
  outcome.exit_code = WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

const Call* current;

// [exec-30] [exec-31]
void what_may_wait_is_caught_and_named(void**) {
  static Outcome outcome;
  for (const Call& call : caught) {
    current = &call;
    run_in_child(
        [] {
          last_gasp::set_stepped("the unit");
          current->call();
          return 92;
        },
        outcome);
    char expected[120];
    snprintf(expected, sizeof(expected), "\nflexrf: system call %s (", call.name);
    assert_memory_equal(outcome.message, expected, strlen(expected));
    assert_int_equal(outcome.signal, SIGABRT);
    assert_non_null(strstr(outcome.message, ") at 0x"));
    assert_non_null(
        strstr(outcome.message, " in the real-time thread the thread's name, in the step of the unit, "));
    assert_non_null(strstr(outcome.message, "system_call_filter_test("));
  }
}

void between_steps_nobody_is_blamed(void**) {
  static Outcome outcome;
  run_in_child(
      [] {
        nanosleep(&moment, nullptr);
        return 92;
      },
      outcome);
  assert_int_equal(outcome.signal, SIGABRT);
  assert_non_null(strstr(outcome.message, "the thread's name, between its steps, "));
}

/// The numbers tell which of them failed.
int do_what_is_allowed() {
  Doorbell bell;
  if (bell.wait(bell.listen(), MonotonicClock::now() + std::chrono::milliseconds{1})) return 1;
  if (ppoll(nullptr, 0, &moment, nullptr) != 0) return 2;
  if (poll(nullptr, 0, 10) != 0 || sched_yield() != 0) return 3;
  const int connection = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  char byte = 0;
  if (connection < 0 || read(connection, &byte, 1) >= 0) return 4;
  // An address that nobody has; what is made in a cycle is a connection that comes and goes.
  const sockaddr_un nobody{AF_UNIX, "no such path"};
  if (connect(connection, reinterpret_cast<const sockaddr*>(&nobody), sizeof(nobody)) == 0 || errno != ENOENT)
    return 6;
  if (accept4(connection, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC) >= 0 || errno != EINVAL) return 7;
  int waiting = 0;
  socklen_t size = sizeof(waiting);
  if (ioctl(connection, FIONREAD, &waiting) != 0) return 8;
  if (getsockopt(connection, SOL_SOCKET, SO_ERROR, &waiting, &size) != 0 || close(connection) != 0) return 9;
  rusage usage{};
  if (getrusage(RUSAGE_THREAD, &usage) != 0) return 5;
  return 0;
}

// [exec-29]
void what_a_thread_needs_is_let_through_to_its_end(void**) {
  static Outcome outcome;
  run_in_child(&do_what_is_allowed, outcome);
  assert_string_equal(outcome.message, "");
  assert_int_equal(outcome.exit_code, 0);
}

// [exec-29]
void a_crash_of_a_filtered_thread_has_its_last_gasp(void**) {
  static Outcome outcome;
  run_in_child(
      [] {
        ignore(last_gasp::install());
        constexpr std::byte text[] = {std::byte{'s'}, std::byte{'a'}, std::byte{'f'}, std::byte{'e'}};
        last_gasp::prepare_write(last_gasp::claim_slot(), STDERR_FILENO, text);
        std::raise(SIGFPE);
        return 92;
      },
      outcome);
  assert_int_equal(outcome.signal, SIGFPE);
  assert_memory_equal(outcome.message, "safe", 4);
  assert_non_null(strstr(outcome.message, "prepared outputs written: 1"));
}

/// Injected: a filter of the test's keeps the call that makes filters from the kernel.
// [exec-33]
void without_filters_it_says_so_and_goes_on(void**) {
  static Outcome outcome;
  run_in_child([] { return nanosleep(&moment, nullptr); }, outcome, false);
  assert_int_equal(outcome.exit_code, 0);
  assert_string_equal(outcome.message,
                      "the system calls of real-time threads are not watched: Function not implemented");
}

/// A SIGSYS of another origin does what it always did.
void a_signal_that_was_sent_is_not_a_trap(void**) {
  static Outcome outcome;
  run_in_child(
      [] {
        std::raise(SIGSYS);
        return 92;
      },
      outcome);
  assert_int_equal(outcome.signal, SIGSYS);
  // The crash's own words, and none of a system call that nobody made.
  assert_null(std::strstr(outcome.message, "in the real-time thread"));
  assert_non_null(std::strstr(outcome.message, "SIGSYS"));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_may_wait_is_caught_and_named),
      cmocka_unit_test(between_steps_nobody_is_blamed),
      cmocka_unit_test(what_a_thread_needs_is_let_through_to_its_end),
      cmocka_unit_test(a_crash_of_a_filtered_thread_has_its_last_gasp),
      cmocka_unit_test(without_filters_it_says_so_and_goes_on),
      cmocka_unit_test(a_signal_that_was_sent_is_not_a_trap),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
