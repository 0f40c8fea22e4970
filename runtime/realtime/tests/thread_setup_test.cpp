#include "runtime/realtime/thread_setup.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "runtime/realtime/rights.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::thread_setup_test {
namespace {

alignas(4096) std::byte stack[256 * 1024];

/// What a thread finds when it looks at itself.
struct Seen {
  std::atomic<bool> ran{false};
  int policy = -1;
  int priority = -1;
  cpu_set_t cpus{};
  char name[16] = {};
  const void* frame = nullptr;
  pid_t id = 0;
};

void look(void* argument) {
  auto& seen = *static_cast<Seen*>(argument);
  sched_param parameters{};
  seen.policy = sched_getscheduler(0);
  sched_getparam(0, &parameters);
  seen.priority = parameters.sched_priority;
  sched_getaffinity(0, sizeof(seen.cpus), &seen.cpus);
  pthread_getname_np(pthread_self(), seen.name, sizeof(seen.name));
  seen.frame = __builtin_frame_address(0);
  seen.id = gettid();
  seen.ran = true;
}

bool may_be_realtime() {
  return probe_rights({10, 0}).is_complete();
}

void helper_thread_is_not_realtime(void**) {
  static Seen seen;
  static RunningThread thread;
  const Status status = thread.start({.name = "a-name-longer-than-fifteen", .cpus = {}}, &look, &seen);
  assert_true(status.is_ok());
  assert_true(thread.id() > 0);
  thread.join();
  assert_true(seen.ran);
  assert_int_equal(seen.policy, SCHED_OTHER);
  assert_int_equal(seen.priority, 0);
  assert_true(CpuSet(seen.cpus) == CpuSet::allowed());
  assert_string_equal(seen.name, "a-name-longer-t");
  assert_int_equal(seen.id, thread.id());
}

void realtime_thread_has_what_was_asked(void**) {
  if (!may_be_realtime()) skip();
  static Seen seen;
  static RunningThread thread;
  ThreadSettings settings{.name = "control", .priority = 10, .cpus = CpuSet::of(CpuSet::allowed().highest())};
  settings.stack = stack;
  settings.stack_size = sizeof(stack);
  for (int round = 0; round < 2; ++round) {  // the same memory serves again
    seen.ran = false;
    assert_true(thread.start(settings, &look, &seen).is_ok());
    assert_true(thread.is_started());
    assert_int_equal(thread.start(settings, &look, &seen).code(), StatusCode::busy);
    thread.join();
    assert_false(thread.is_started());
    assert_true(seen.ran);
    assert_int_equal(seen.policy, SCHED_FIFO);
    assert_int_equal(seen.priority, 10);
    assert_true(CpuSet(seen.cpus) == settings.cpus);
#if !FLEXRF_SANITIZER  // which need a larger stack
    assert_true(seen.frame > static_cast<void*>(stack + 4096) &&
                seen.frame < static_cast<void*>(stack + sizeof(stack)));
#endif
  }
}

struct Nested {
  Seen seen;
  Status status;
};

void start_helper(void* argument) {
  auto& nested = *static_cast<Nested*>(argument);
  RunningThread helper;
  nested.status = helper.start({.name = "helper", .cpus = {}}, &look, &nested.seen);
}

void nothing_is_inherited_from_a_realtime_creator(void**) {
  if (!may_be_realtime()) skip();
  static Nested nested;
  static RunningThread thread;
  const ThreadSettings settings{
      .name = "creator", .priority = 10, .cpus = CpuSet::of(CpuSet::allowed().highest())};
  assert_true(thread.start(settings, &start_helper, &nested).is_ok());
  thread.join();
  assert_true(nested.status.is_ok());
  assert_int_equal(nested.seen.policy, SCHED_OTHER);
  assert_true(CpuSet(nested.seen.cpus) == CpuSet::allowed());
}

void unusable_settings_are_refused(void**) {
  static Seen seen;
  static RunningThread thread;
  ThreadSettings settings{.name = "broken", .cpus = {}};
  settings.stack_size = minimal_stack_size() - 4096;
  assert_int_equal(thread.start(settings, &look, &seen).code(), StatusCode::invalid_argument);
  settings.stack_size = minimal_stack_size() + 1;
  assert_int_equal(thread.start(settings, &look, &seen).code(), StatusCode::invalid_argument);
  settings.stack = stack + 64;
  settings.stack_size = sizeof(stack) - 4096;
  assert_string_equal(thread.start(settings, &look, &seen).cause(),
                      "the stack of thread broken is not page-aligned");
  settings.stack = nullptr;
  settings.stack_size = 0;
  settings.cpus = CpuSet::of(1000);
  const Status status = thread.start(settings, &look, &seen);
  assert_int_equal(status.code(), StatusCode::invalid_argument);
  assert_string_equal(status.cause(),
                      "thread broken cannot be created with priority 0 on CPU 1000: Invalid argument");
  assert_false(thread.is_started());
  assert_false(seen.ran);
}

/// In a process of another user, without rights. @returns its exit code: 0 when refused as promised.
int start_without_rights() {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit none{0, 0};
    setrlimit(RLIMIT_RTPRIO, &none);
    if (geteuid() == 0 && setuid(65534) != 0) _exit(10);
    Seen seen;
    RunningThread thread;
    const Status status = thread.start({.name = "control", .priority = 10, .cpus = {}}, &look, &seen);
    const bool promised = status.code() == StatusCode::not_permitted && !seen.ran &&
                          std::strcmp(status.cause(),
                                      "thread control may not have SCHED_FIFO priority 10: RLIMIT_RTPRIO is "
                                      "too low and CAP_SYS_NICE is not held") == 0;
    _exit(promised ? 0 : 1);
  }
  int result = 0;
  waitpid(child, &result, 0);
  return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

void missing_right_is_named(void**) {
  assert_int_equal(start_without_rights(), 0);
}

void run_into_the_guard(void*) {
  *static_cast<volatile std::byte*>(stack + 4095) = std::byte{1};
}

void guard_stops_an_overflow(void**) {
#if FLEXRF_SANITIZER
  skip();  // sanitizers have reports of their own
#endif
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGSEGV, SIG_DFL);  // CMocka would catch it
    RunningThread thread;
    ThreadSettings settings{.name = "overflow", .cpus = {}};
    settings.stack = stack;
    settings.stack_size = sizeof(stack);
    if (!thread.start(settings, &run_into_the_guard, nullptr)) _exit(1);
    thread.join();
    _exit(0);
  }
  int result = 0;
  waitpid(child, &result, 0);
  assert_true(WIFSIGNALED(result));
  assert_int_equal(WTERMSIG(result), SIGSEGV);
}

}  // namespace
}  // namespace flexrf::thread_setup_test

int main() {
  using namespace flexrf::thread_setup_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(helper_thread_is_not_realtime),
      cmocka_unit_test(realtime_thread_has_what_was_asked),
      cmocka_unit_test(nothing_is_inherited_from_a_realtime_creator),
      cmocka_unit_test(unusable_settings_are_refused),
      cmocka_unit_test(missing_right_is_named),
      cmocka_unit_test(guard_stops_an_overflow),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
