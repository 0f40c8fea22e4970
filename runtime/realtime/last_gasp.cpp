#include "runtime/realtime/last_gasp.hpp"

#include <execinfo.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "runtime/realtime/realtime_scope.hpp"
#include "runtime/realtime/signals.hpp"

namespace flexrf::last_gasp {

namespace {

constexpr std::size_t words = bytes_per_slot / sizeof(std::uint64_t);
constexpr int none = -1;
/// What a descriptor is waited for at most, and what others are given to be through with a call, ms.
constexpr int longest_wait = 10;
constexpr int moment = 1;

/// What a driver prepared. It fills the side that is not current and then makes it current, so that a handler
/// that interrupts it, or runs beside it, finds one side whole.
struct Side {
  std::atomic<std::int32_t> descriptor{none};
  std::atomic<std::uint32_t> size{0};
  std::atomic<std::uint64_t> data[words]{};
};
struct Slot {
  std::atomic<std::uint32_t> generation{0};  ///< its lowest bit is the current side; 0: nothing prepared yet
  std::atomic<bool> claimed{false};
  std::atomic<Turn> turn{Turn::first};
  Side sides[2];
};

struct Terminal {
  std::atomic<int> descriptor{none};
  termios settings{};
};

constinit Slot table[slots];
constinit Terminal terminal;
constinit std::atomic<bool> crashing{false};
/// What the thread that ended the process first has written; −1: nothing yet.
constinit std::atomic<int> written_in_crash{none};
constinit thread_local bool crashed_here [[gnu::tls_model("initial-exec")]] = false;
/// Whose exit is unexpected; 0: nobody's. A child that was forked has another number.
constinit std::atomic<pid_t> exit_is_unexpected_of{0};
constinit thread_local const char* stepped_unit [[gnu::tls_model("initial-exec")]] = nullptr;

struct Prepared {
  int descriptor = none;
  std::size_t size = 0;
  std::byte bytes[bytes_per_slot];
};

/// One side as a whole; false when its owner was faster, every time.
bool copy_prepared(const Slot& slot, Prepared& prepared) noexcept {
  for (int attempt = 0; attempt < 8; ++attempt) {
    const std::uint32_t generation = slot.generation.load(std::memory_order_acquire);
    if (generation == 0) return true;
    const Side& side = slot.sides[generation & 1U];
    // Acquire loads keep the second look at the generation behind them.
    prepared.descriptor = side.descriptor.load(std::memory_order_acquire);
    prepared.size = std::min<std::size_t>(side.size.load(std::memory_order_acquire), bytes_per_slot);
    for (std::size_t i = 0; i < words; ++i) {
      const std::uint64_t word = side.data[i].load(std::memory_order_acquire);
      std::memcpy(prepared.bytes + i * sizeof(word), &word, sizeof(word));
    }
    if (slot.generation.load(std::memory_order_relaxed) == generation) return true;
  }
  prepared.descriptor = none;
  return false;
}

bool write_all(int descriptor, const std::byte* bytes, std::size_t size) noexcept {
  std::size_t written = 0;
  for (int attempt = 0; attempt < longest_wait / moment && written < size; ++attempt) {
    pollfd ready{descriptor, POLLOUT, 0};
    // Anything beside writable is an end that is closed, where writing would raise SIGPIPE.
    if (poll(&ready, 1, longest_wait) <= 0 || ready.revents != POLLOUT) return false;
    const ssize_t count = write(descriptor, bytes + written, size - written);
    if (count > 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno == ENOBUFS) {
      poll(nullptr, 0, moment);  // a network interface's queue is full, which is not seen by the socket
    } else if (errno != EINTR && errno != EAGAIN) {
      return false;
    }
  }
  return written == size;
}

/// Descriptors that took nothing: what else is prepared for them would only wait as long again.
class Refusals {
 public:
  void note(int descriptor) noexcept { descriptors_[count_++] = descriptor; }
  bool has(int descriptor) const noexcept {
    return std::find(descriptors_, descriptors_ + count_, descriptor) != descriptors_ + count_;
  }

 private:
  int descriptors_[slots];
  std::size_t count_ = 0;
};

int write_prepared() noexcept {
  int written = 0;
  Refusals refusals;
  for (const Turn turn : {Turn::first, Turn::last}) {
    for (const Slot& slot : table) {
      Prepared prepared;
      if (slot.turn.load(std::memory_order_relaxed) != turn || !copy_prepared(slot, prepared) ||
          prepared.descriptor < 0 || refusals.has(prepared.descriptor)) {
        continue;
      }
      if (write_all(prepared.descriptor, prepared.bytes, prepared.size)) {
        ++written;
      } else {
        refusals.note(prepared.descriptor);
      }
    }
  }
  return written;
}

/// After has_begun() became true: a thread that looked at it just before gets its call through, so that what
/// was prepared is the last that is said.
int write_last() noexcept {
  poll(nullptr, 0, moment);
  return write_prepared();
}

/// Once: what was prepared leaves the machine before anybody says why.
bool write_first() noexcept {
  if (crashing.exchange(true, std::memory_order_acq_rel)) return false;
  crashed_here = true;
  const int written = write_last();
  restore_terminal();
  written_in_crash.store(written, std::memory_order_release);
  return true;
}

/// Text made of pieces, without the C library's formatting, which a signal handler may not use.
class Message {
 public:
  Message& operator<<(const char* text) noexcept {
    while (*text != '\0' && size_ < sizeof(text_)) text_[size_++] = *text++;
    return *this;
  }
  Message& operator<<(int number) noexcept {
    char digits[12];
    std::size_t place = sizeof(digits);
    digits[--place] = '\0';
    do {
      digits[--place] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number > 0 && place > 0);
    return *this << digits + place;
  }
  Message& address(const void* pointer) noexcept {
    auto value = reinterpret_cast<std::uintptr_t>(pointer);
    char digits[2 * sizeof(value) + 1];
    std::size_t place = sizeof(digits);
    digits[--place] = '\0';
    do {
      digits[--place] = "0123456789abcdef"[value % 16];
      value /= 16;
    } while (value > 0 && place > 0);
    return *this << "0x" << digits + place;
  }
  void write_to(int descriptor) const noexcept {
    write_all(descriptor, reinterpret_cast<const std::byte*>(text_), size_);
  }

 private:
  char text_[256];
  std::size_t size_ = 0;
};

const char* meaning_of(int signal) noexcept {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV (invalid memory access)";
    case SIGBUS:
      return "SIGBUS (memory not there)";
    case SIGFPE:
      return "SIGFPE (arithmetic error)";
    case SIGILL:
      return "SIGILL (invalid instruction)";
    case SIGABRT:
      return "SIGABRT (abort)";
    case SIGSYS:
      return "SIGSYS (system call that is not permitted)";
    case SIGTRAP:
      return "SIGTRAP (breakpoint)";
    case SIGXCPU:
      return "SIGXCPU (limit of processor time; of a real-time thread that never waited, by RLIMIT_RTTIME)";
    default:
      return "a signal";
  }
}

constexpr int exit_fault = 2;

bool exit_is_unexpected() noexcept {
  const pid_t process = exit_is_unexpected_of.load(std::memory_order_acquire);
  return process != 0 && process == getpid();
}

[[noreturn]] void leave(int status) noexcept {
  for (;;) syscall(SYS_exit_group, status);
}

[[noreturn]] void leave_after_last_gasp(const char* called) noexcept {
  // A thread that crashes meanwhile ends the process itself.
  if (write_first()) {
    Message message;
    message << "\nflexrf: " << called << " was called while the application ran";
    if (stepped_unit != nullptr) message << ", in " << stepped_unit;
    message << "; prepared outputs written: " << written_in_crash.load() << "\n";
    message.write_to(STDERR_FILENO);
  }
  leave(exit_fault);
}

void at_exit() noexcept {
  if (exit_is_unexpected()) leave_after_last_gasp("exit()");
}

void at_quick_exit() noexcept {
  if (exit_is_unexpected()) leave_after_last_gasp("quick_exit()");
}

/// By the signal's number; null: handle(). Written at start.
constinit SignalHandler handlers[NSIG] = {};

struct sigaction action_of(int signal) noexcept {
  struct sigaction action {};
  action.sa_sigaction = handlers[signal] != nullptr ? handlers[signal] : &handle;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  // All others wait: a crash in the handler itself then ends the process at once.
  sigfillset(&action.sa_mask);
  return action;
}

bool takes_text(int descriptor) noexcept {
  pollfd ready{descriptor, POLLOUT, 0};
  return poll(&ready, 1, longest_wait) > 0 && ready.revents == POLLOUT;
}

}  // namespace

void handle(int signal, siginfo_t* information, void* /*context*/) noexcept {
  if (write_first() || crashed_here) {
    Message message;
    message << "\nflexrf: " << meaning_of(signal);
    if (signal == SIGSEGV || signal == SIGBUS) (message << " at ").address(information->si_addr);
    if (stepped_unit != nullptr) message << " while stepping " << stepped_unit;
    message << "; prepared outputs written: " << written_in_crash.load(std::memory_order_acquire) << "\n";
    message.write_to(STDERR_FILENO);
  } else {
    // Another thread crashed first and is about to end the process: leave it the time to.
    for (int i = 0; i < 10; ++i) {
      const timespec time{0, 100'000'000};
      ppoll(nullptr, 0, &time, nullptr);  // a real-time thread of the checked build may not sleep
    }
  }
  // Delivered with the default action as soon as this handler returns.
  ::signal(signal, SIG_DFL);
  syscall(SYS_tgkill, getpid(), gettid(), signal);
}

void abort_with_trace(const char* text) noexcept {
  // What is done on the way out may allocate.
  detail::allocation_counter = nullptr;
  write_first();
  write_all(STDERR_FILENO, reinterpret_cast<const std::byte*>(text), std::strlen(text));
  void* frames[64];
  const int count = backtrace(frames, 64);
  // Each by itself: a reader that is stuck must not keep the process from its end.
  for (int i = 0; i < count && takes_text(STDERR_FILENO); ++i)
    backtrace_symbols_fd(frames + i, 1, STDERR_FILENO);
  std::abort();
}

void restore_terminal() noexcept {
  const int descriptor = terminal.descriptor.load(std::memory_order_acquire);
  if (descriptor >= 0 && !signals::is_in_background(descriptor))
    tcsetattr(descriptor, TCSANOW, &terminal.settings);
}

Status install() noexcept {
  for (const int signal : signals::crashing) {
    const struct sigaction action = action_of(signal);
    if (sigaction(signal, &action, nullptr) != 0)
      return Status::error(StatusCode::internal, "%s cannot be handled: %s", meaning_of(signal),
                           strerrordesc_np(errno));
  }
  return {};
}

bool handle_with(int signal, SignalHandler handler) noexcept {
  handlers[signal] = handler;
  const struct sigaction action = action_of(signal);
  return sigaction(signal, &action, nullptr) == 0;
}

int put_handlers_back() noexcept {
  int replaced = 0;
  for (const int signal : signals::crashing) {
    const struct sigaction action = action_of(signal);
    struct sigaction present {};
    if (sigaction(signal, nullptr, &present) != 0 || present.sa_sigaction == action.sa_sigaction) continue;
    // In a crash the handler itself asks for the default.
    if (crashing.load(std::memory_order_acquire)) return 0;
    sigaction(signal, &action, nullptr);
    if (replaced == 0) replaced = signal;
  }
  return replaced;
}

void expect_no_exit(bool on) noexcept {
  static const bool registered = std::atexit(at_exit) == 0 && std::at_quick_exit(at_quick_exit) == 0;
  exit_is_unexpected_of.store(on && registered ? getpid() : 0, std::memory_order_release);
}

int claim_slot(Turn turn) noexcept {
  for (std::size_t i = 0; i < slots; ++i) {
    bool expected = false;
    if (!table[i].claimed.compare_exchange_strong(expected, true, std::memory_order_acq_rel)) continue;
    table[i].turn.store(turn, std::memory_order_relaxed);
    return static_cast<int>(i);
  }
  return -1;
}

void release_slot(int slot) noexcept {
  if (slot < 0 || static_cast<std::size_t>(slot) >= slots) return;
  clear(slot);
  table[slot].claimed.store(false, std::memory_order_release);
}

bool prepare_write(int slot, int descriptor, std::span<const std::byte> bytes) noexcept {
  if (slot < 0 || static_cast<std::size_t>(slot) >= slots || bytes.size() > bytes_per_slot) return false;
  Slot& entry = table[slot];
  std::uint32_t generation = entry.generation.load(std::memory_order_relaxed) + 1;
  if (generation == 0) generation = 2;  // 0 means nothing prepared; the side stays right
  // Release stores keep behind the earlier one that made the other side current: who sees one of them knows
  // then that this side is current no more.
  Side& side = entry.sides[generation & 1U];
  side.descriptor.store(descriptor, std::memory_order_release);
  side.size.store(static_cast<std::uint32_t>(bytes.size()), std::memory_order_release);
  for (std::size_t i = 0; i * sizeof(std::uint64_t) < bytes.size(); ++i) {
    std::uint64_t word = 0;
    const std::size_t offset = i * sizeof(word);
    std::memcpy(&word, bytes.data() + offset, std::min(sizeof(word), bytes.size() - offset));
    side.data[i].store(word, std::memory_order_release);
  }
  entry.generation.store(generation, std::memory_order_release);
  return true;
}

void clear(int slot) noexcept {
  prepare_write(slot, none, {});
}

void prepare_terminal(int descriptor, const termios& settings) noexcept {
  terminal.descriptor.store(none, std::memory_order_release);
  terminal.settings = settings;
  terminal.descriptor.store(descriptor, std::memory_order_release);
}

void clear_terminal() noexcept {
  terminal.descriptor.store(none, std::memory_order_release);
}

int fire() noexcept {
  // What a crash or an exit() writes is written once.
  if (crashing.load(std::memory_order_acquire)) return 0;
  const int written = write_prepared();
  restore_terminal();
  return written;
}

bool has_begun() noexcept {
  return crashing.load(std::memory_order_acquire);
}

void set_stepped(const char* unit) noexcept {
  stepped_unit = unit;
}

const char* stepped() noexcept {
  return stepped_unit;
}

AlternateStack::AlternateStack(std::span<std::byte> memory) noexcept {
  stack_t stack{};
  stack.ss_sp = memory.data();
  stack.ss_size = memory.size();
  stack_t outer{};
  sigaltstack(&stack, &outer);
  outer_ = outer.ss_sp;
  outer_size_ = outer.ss_size;
  outer_flags_ = outer.ss_flags;
}

AlternateStack::~AlternateStack() {
  // A sanitizer's thread frees the stack that is set when the thread ends: it must be its own again.
  stack_t outer{};
  outer.ss_sp = outer_;
  outer.ss_size = outer_size_;
  outer.ss_flags = outer_flags_;
  sigaltstack(&outer, nullptr);
}

#if !FLEXRF_SANITIZER
namespace {

[[noreturn]] void end_process(const char* called, int status) noexcept {
  if (exit_is_unexpected()) leave_after_last_gasp(called);
  leave(status);
}

}  // namespace
#endif

}  // namespace flexrf::last_gasp

#if !FLEXRF_SANITIZER
// In place of the C library's, which run no handler: a unit or a library that calls them would leave its
// actuators as they were commanded last. A sanitizer has its own.
extern "C" void _exit(int status) {  // NOLINT(bugprone-reserved-identifier)
  flexrf::last_gasp::end_process("_exit()", status);
}
extern "C" void _Exit(int status) noexcept {  // NOLINT(bugprone-reserved-identifier)
  flexrf::last_gasp::end_process("_Exit()", status);
}
#endif
