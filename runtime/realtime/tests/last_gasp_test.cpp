#include "runtime/realtime/last_gasp.hpp"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "tests/cmocka.hpp"

namespace flexrf::last_gasp_test {
namespace {

std::span<const std::byte> bytes_of(const char* text) {
  return std::as_bytes(std::span(text, std::strlen(text)));
}

struct Outcome {
  int signal = 0;          ///< that ended the process
  char written[256];       ///< on the devices' pipe
  char message[512];       ///< on standard error
  bool canonical = false;  ///< whether the terminal was restored
};

using Crash = void (*)();

struct Terminal {
  int controller = -1;
  int side = -1;
  bool open() {
    controller = posix_openpt(O_RDWR | O_NOCTTY);
    if (controller < 0 || grantpt(controller) != 0 || unlockpt(controller) != 0) return false;
    char name[64];
    if (ptsname_r(controller, name, sizeof(name)) != 0) return false;
    side = ::open(name, O_RDWR | O_NOCTTY);
    return side >= 0;
  }
  void close_both() const {
    close(controller);
    close(side);
  }
};

void read_to_end(int descriptor, char* text, std::size_t capacity) {
  std::size_t size = 0;
  ssize_t count = 0;
  while (size < capacity - 1 && (count = read(descriptor, text + size, capacity - 1 - size)) > 0)
    size += static_cast<std::size_t>(count);
  text[size] = '\0';
}

/// A process with two devices and a raw terminal, which then crashes.
Outcome run_and_crash(Crash crash) {
  Outcome outcome{};
  int device[2];
  int error[2];
  Terminal terminal;
  if (pipe(device) != 0 || pipe(error) != 0 || !terminal.open()) return outcome;
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    dup2(error[1], STDERR_FILENO);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
    termios settings{};
    tcgetattr(terminal.side, &settings);
    last_gasp::prepare_terminal(terminal.side, settings);
    settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    tcsetattr(terminal.side, TCSANOW, &settings);
    const int first = last_gasp::claim_slot();
    const int second = last_gasp::claim_slot();
    const int third = last_gasp::claim_slot();
    last_gasp::prepare_write(first, device[1], bytes_of("not this"));
    last_gasp::prepare_write(first, device[1], bytes_of("brake on;"));
    last_gasp::prepare_write(second, device[1], bytes_of("valve shut;"));
    last_gasp::prepare_write(third, device[1], bytes_of("nor this"));
    last_gasp::clear(third);
    if (!last_gasp::install()) _exit(1);
    last_gasp::set_stepped("jog");
    crash();
    _exit(0);
  }
  close(device[1]);
  close(error[1]);
  read_to_end(device[0], outcome.written, sizeof(outcome.written));
  read_to_end(error[0], outcome.message, sizeof(outcome.message));
  int result = 0;
  waitpid(child, &result, 0);
  outcome.signal = WIFSIGNALED(result) ? WTERMSIG(result) : 0;
  termios settings{};
  tcgetattr(terminal.side, &settings);
  outcome.canonical = (settings.c_lflag & ICANON) != 0 && (settings.c_lflag & ECHO) != 0;
  terminal.close_both();
  close(device[0]);
  close(error[0]);
  return outcome;
}

void check_outcome(const Outcome& outcome, int signal, const char* message) {
  assert_string_equal(outcome.written, "brake on;valve shut;");
  assert_non_null(strstr(outcome.message, message));
  assert_non_null(strstr(outcome.message, "prepared outputs written: 2\n"));
  assert_true(outcome.canonical);
  assert_int_equal(outcome.signal, signal);
}

// [stop-22] [stop-25]
void invalid_memory_access(void**) {
  const Outcome outcome = run_and_crash([] {
    void* const nowhere = mmap(nullptr, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    *static_cast<volatile int*>(nowhere) = 1;
  });
  check_outcome(outcome, SIGSEGV, "flexrf: SIGSEGV (invalid memory access) at 0x");
  assert_non_null(strstr(outcome.message, " while stepping jog;"));
}

// [stop-22]
void memory_that_is_not_there(void**) {
  const Outcome outcome = run_and_crash([] {
    const int file = memfd_create("empty", MFD_CLOEXEC);
    void* const memory = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    *static_cast<volatile int*>(memory) = 1;
  });
  check_outcome(outcome, SIGBUS, "flexrf: SIGBUS (memory not there) at 0x");
}

// [stop-22]
void arithmetic_error(void**) {
  check_outcome(run_and_crash([] { raise(SIGFPE); }), SIGFPE, "flexrf: SIGFPE (arithmetic error) while");
}

// [stop-22]
void invalid_instruction(void**) {
  check_outcome(run_and_crash([] { raise(SIGILL); }), SIGILL, "flexrf: SIGILL (invalid instruction) while");
}

// [stop-22]
void abort_called(void**) {
  check_outcome(run_and_crash([] { abort(); }), SIGABRT, "flexrf: SIGABRT (abort) while");
}

alignas(16) std::byte handler_stack[last_gasp::handler_stack_size];

/// Uses its stack up, as a runaway recursion does: only an alternate stack can still run a handler.
[[gnu::noinline]] int use_up_the_stack(volatile int* depth) {
  volatile char frame[16 * 1024];
  frame[0] = static_cast<char>(*depth);
  *depth = *depth + 1;
  if (*depth < 0) return 0;
  return use_up_the_stack(depth) + frame[0];
}

// [stop-22]
void stack_overflow_in_a_thread(void**) {
#if FLEXRF_SANITIZER
  skip();  // sanitizers do not survive a stack that is used up
#endif
  const Outcome outcome = run_and_crash([] {
    std::thread([] {
      const last_gasp::AlternateStack stack(handler_stack);
      last_gasp::set_stepped("recursive");
      volatile int depth = 0;
      use_up_the_stack(&depth);
    }).join();
  });
  check_outcome(outcome, SIGSEGV, " while stepping recursive;");
}

void a_thread_without_a_unit(void**) {
  const Outcome outcome = run_and_crash([] {
    std::thread([] {
      const last_gasp::AlternateStack stack(handler_stack);
      abort();
    }).join();
  });
  check_outcome(outcome, SIGABRT, "flexrf: SIGABRT (abort); prepared");
}

struct Pipe {
  Pipe() { good = pipe2(ends, O_NONBLOCK) == 0; }
  ~Pipe() { close(ends[0]), close(ends[1]); }
  int ends[2];
  bool good;
};

/// @returns slots written; `text` gets what came out.
int fire_into_pipe(char* text, std::size_t capacity, bool full) {
  const Pipe pipe;
  const int slot = last_gasp::claim_slot();
  char block[4096] = {};
  while (full && write(pipe.ends[1], block, sizeof(block)) > 0) {
  }
  last_gasp::prepare_write(slot, pipe.ends[1], bytes_of("stop"));
  const int written = last_gasp::fire();
  last_gasp::release_slot(slot);
  const int after_release = last_gasp::fire();
  const ssize_t size = read(pipe.ends[0], text, capacity - 1);
  text[size > 0 ? size : 0] = '\0';
  return written + 100 * after_release;
}

void fires_for_an_owner_that_does_not_answer(void**) {
  char text[64];
  assert_int_equal(fire_into_pipe(text, sizeof(text), false), 1);
  assert_string_equal(text, "stop");
  // A device that takes nothing delays the others by 10 ms, no more.
  assert_int_equal(fire_into_pipe(text, sizeof(text), true), 0);
}

/// In the order of their turns, not of their slots.
// [stop-24]
void what_is_last_comes_after_all_others(void**) {
  const Pipe pipe;
  const int last = last_gasp::claim_slot(last_gasp::Turn::last);
  const int first = last_gasp::claim_slot();
  const int second = last_gasp::claim_slot();
  last_gasp::prepare_write(last, pipe.ends[1], bytes_of("all"));
  last_gasp::prepare_write(first, pipe.ends[1], bytes_of("one "));
  last_gasp::prepare_write(second, pipe.ends[1], bytes_of("other "));
  const int written = last_gasp::fire();
  for (const int slot : {last, first, second}) last_gasp::release_slot(slot);
  // The slot itself is for anybody again.
  const int reused = last_gasp::claim_slot();
  const int behind = last_gasp::claim_slot();
  last_gasp::prepare_write(reused, pipe.ends[1], bytes_of("; again "));
  last_gasp::prepare_write(behind, pipe.ends[1], bytes_of("in order"));
  last_gasp::fire();
  for (const int slot : {reused, behind}) last_gasp::release_slot(slot);
  char text[64] = {};
  assert_true(read(pipe.ends[0], text, sizeof(text) - 1) > 0);
  assert_int_equal(written, 3);
  assert_string_equal(text, "one other all; again in order");
}

/// How often this process gave up its CPU, which it does in each attempt that it waits for.
long times_waited() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_nvcsw;
}

/// From now on, as of a network interface whose queue is full, of which the socket, ready to be written,
/// knows nothing.
bool leave_no_room(int descriptor) {
  sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_write, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[0])),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(descriptor), 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOBUFS),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog filter{static_cast<unsigned short>(std::size(program)), program};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

/// Ten attempts for all that is prepared for the one that is full, not for each.
// [stop-87]
void a_full_queue_holds_up_no_other(void**) {
  const Pipe full;
  const Pipe other;
  const pid_t child = fork();
  if (child == 0) {
    if (!leave_no_room(full.ends[1])) _exit(100);
    for (int i = 0; i < 30; ++i) {
      last_gasp::prepare_write(last_gasp::claim_slot(), full.ends[1], bytes_of("no"));
      last_gasp::prepare_write(last_gasp::claim_slot(), other.ends[1], bytes_of("stop;"));
    }
    const long before = times_waited();
    if (last_gasp::fire() != 30) _exit(1);
    _exit(times_waited() - before < 100 ? 0 : 2);
  }
  int result = 0;
  waitpid(child, &result, 0);
  char text[256] = {};
  const ssize_t size = read(other.ends[0], text, sizeof(text) - 1);
  assert_true(WIFEXITED(result));
  assert_int_equal(WEXITSTATUS(result), 0);
  assert_int_equal(size, 30 * 5);
}

void slots_are_bounded(void**) {
  int claimed[last_gasp::slots];
  for (int& slot : claimed) slot = last_gasp::claim_slot();
  const int beyond = last_gasp::claim_slot();
  for (const int slot : claimed) last_gasp::release_slot(slot);
  for (const int slot : claimed) assert_true(slot >= 0);
  assert_int_equal(beyond, -1);
  const std::byte bytes[last_gasp::bytes_per_slot + 1]{};
  assert_false(last_gasp::prepare_write(0, 1, bytes));
  assert_false(last_gasp::prepare_write(-1, 1, {}));
  assert_false(last_gasp::prepare_write(static_cast<int>(last_gasp::slots), 1, {}));
  last_gasp::release_slot(-1);
}

/// One thread prepares without pause what another fires: each write comes out whole.
bool writes_come_out_whole(int rounds) {
  const Pipe pipe;
  const int slot = last_gasp::claim_slot();
  std::atomic<bool> running{true};
  std::thread driver([&] {
    std::byte bytes[last_gasp::bytes_per_slot];
    for (unsigned value = 0; running; ++value) {
      std::memset(bytes, static_cast<int>('a' + value % 26), sizeof(bytes));
      last_gasp::prepare_write(slot, pipe.ends[1], bytes);
    }
  });
  bool whole = true;
  int seen = 0;
  for (int i = 0; i < rounds || seen == 0; ++i) {
    last_gasp::fire();
    char text[last_gasp::bytes_per_slot];
    if (read(pipe.ends[0], text, sizeof(text)) <= 0) continue;
    ++seen;
    for (const char character : text) whole = whole && character == text[0];
  }
  running = false;
  driver.join();
  last_gasp::release_slot(slot);
  return whole;
}

void preparing_beside_firing_is_safe(void**) {
  assert_true(writes_come_out_whole(20'000));
}

}  // namespace
}  // namespace flexrf::last_gasp_test

int main() {
  using namespace flexrf::last_gasp_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(invalid_memory_access),
      cmocka_unit_test(memory_that_is_not_there),
      cmocka_unit_test(arithmetic_error),
      cmocka_unit_test(invalid_instruction),
      cmocka_unit_test(abort_called),
      cmocka_unit_test(stack_overflow_in_a_thread),
      cmocka_unit_test(a_thread_without_a_unit),
      cmocka_unit_test(fires_for_an_owner_that_does_not_answer),
      cmocka_unit_test(what_is_last_comes_after_all_others),
      cmocka_unit_test(a_full_queue_holds_up_no_other),
      cmocka_unit_test(slots_are_bounded),
      cmocka_unit_test(preparing_beside_firing_is_safe),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
