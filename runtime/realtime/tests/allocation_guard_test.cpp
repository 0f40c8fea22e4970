#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include "runtime/realtime/realtime_scope.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

/// Through it the compiler cannot see that memory is not used.
void* volatile memory;

struct Call {
  const char* function;  ///< named in the message
  void (*prepare)();
  void (*call)();
};

const Call calls[] = {
    {"malloc", [] {}, [] { memory = std::malloc(64); }},
    {"free", [] { memory = std::malloc(64); }, [] { std::free(memory); }},
    {"calloc", [] {}, [] { memory = std::calloc(4, 16); }},
    {"realloc", [] { memory = std::malloc(64); }, [] { memory = std::realloc(memory, 128); }},
    {"memalign", [] {}, [] { memory = memalign(64, 128); }},
    {"aligned_alloc", [] {}, [] { memory = std::aligned_alloc(64, 128); }},
    {"posix_memalign", [] {},
     [] {
       void* made = nullptr;
       if (posix_memalign(&made, 64, 128) == 0) memory = made;
     }},
    {"malloc", [] {}, [] { memory = new char[64]; }},
    {"free", [] { memory = new char[64]; }, [] { delete[] static_cast<char*>(memory); }},
    {"malloc", [] {}, [] { memory = strdup("a text"); }},  // from inside the C library
};

#if FLEXRF_CHECKED

struct Outcome {
  int signal;
  char message[8192];
};

/// A process in which a real-time thread makes the call.
void run_in_child(const Call& call, Outcome& outcome) {
  int ends[2];
  outcome = {};
  if (pipe(ends) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    std::signal(SIGABRT, SIG_DFL);
    dup2(ends[1], STDERR_FILENO);
    std::thread([&call] {
      AllocationCounter counter{0};
      call.prepare();
      const RealtimeScope scope(counter);
      call.call();
    }).join();
    _exit(0);
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
}

// [exec-28]
void a_forbidden_call_aborts_with_a_trace(void**) {
  static Outcome outcome;
  for (const Call& call : calls) {
    run_in_child(call, outcome);
    assert_int_equal(outcome.signal, SIGABRT);
    char expected[160];
    snprintf(expected, sizeof(expected),
             "\nflexrf: %s called in a real-time thread, where nothing may be allocated or freed:\n",
             call.function);
    assert_memory_equal(outcome.message, expected, strlen(expected));
    assert_non_null(strstr(outcome.message, "allocation_guard_test("));
  }
}

#else

// [exec-27]
void forbidden_calls_are_counted(void**) {
  for (const Call& call : calls) {
    AllocationCounter counter{0};
    call.prepare();
    {
      const RealtimeScope scope(counter);
      call.call();
    }
    assert_int_equal(counter.load(), 1);
  }
}

void nested_scopes_count_for_the_innermost(void**) {
  AllocationCounter outer{0};
  AllocationCounter inner{0};
  {
    const RealtimeScope outer_scope(outer);
    memory = std::malloc(1);
    {
      const RealtimeScope inner_scope(inner);
      memory = std::malloc(1);
      memory = std::malloc(1);
    }
    std::free(memory);
  }
  assert_int_equal(outer.load(), 2);
  assert_int_equal(inner.load(), 2);
}

/// A thread of its own, with a scope of its own or none.
std::uint64_t count_in_thread(bool with_scope, AllocationCounter& counter) {
  std::thread([with_scope, &counter] {
    if (!with_scope) {
      memory = std::malloc(1);
      return;
    }
    const RealtimeScope scope(counter);
    memory = std::malloc(1);
  }).join();
  return counter.load();
}

void threads_count_apart(void**) {
  AllocationCounter mine{0};
  AllocationCounter others{0};
  assert_int_equal(count_in_thread(false, others), 0);
  assert_int_equal(count_in_thread(true, others), 1);
  assert_int_equal(mine.load(), 0);
}

#endif

void what_is_allowed_is_not_counted(void**) {
  AllocationCounter counter{0};
  {
    const RealtimeScope scope(counter);
    std::free(nullptr);
    {
      const AllocationAllowed allowed;
      memory = std::malloc(16);
    }
  }
  std::free(memory);
  assert_int_equal(counter.load(), 0);
}

void allocation_still_works(void**) {
  assert_true(has_allocation_guard());
  void* aligned = nullptr;
  assert_int_equal(posix_memalign(&aligned, 3, 8), EINVAL);
  assert_int_equal(posix_memalign(&aligned, 4096, 8), 0);
  assert_int_equal(reinterpret_cast<std::uintptr_t>(aligned) % 4096, 0);
  std::free(aligned);
  auto* const zeroed = static_cast<char*>(std::calloc(100, 1));
  for (int i = 0; i < 100; ++i) assert_int_equal(zeroed[i], 0);
  std::strcpy(zeroed, "kept");
  auto* const larger = static_cast<char*>(std::realloc(zeroed, 100'000));
  assert_string_equal(larger, "kept");
  std::free(larger);
}

int prepare(void**) {
  prepare_allocation_guard();
  return 0;
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
#if FLEXRF_CHECKED
    cmocka_unit_test(a_forbidden_call_aborts_with_a_trace),
#else
    cmocka_unit_test(forbidden_calls_are_counted),
    cmocka_unit_test(nested_scopes_count_for_the_innermost),
    cmocka_unit_test(threads_count_apart),
#endif
    cmocka_unit_test(what_is_allowed_is_not_counted),
    cmocka_unit_test(allocation_still_works),
  };
  return cmocka_run_group_tests(tests, prepare, nullptr);
}
