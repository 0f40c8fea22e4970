// Last gasp: what is still done when the process crashes, or when the owner of a device does not answer. Each
// driver prepares the bytes that make its device safe; a handler that needs nothing else writes them.
#pragma once

#include <signal.h>
#include <termios.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/status.hpp"

namespace flexrf::last_gasp {

inline constexpr std::size_t slots = 64;
inline constexpr std::size_t bytes_per_slot = 64;
/// Each thread that may crash needs a stack of its own for the handler.
inline constexpr std::size_t handler_stack_size = 64 * 1024;

/// Handles the signals of a crash (signals::crashing): writes everything prepared, restores the terminal,
/// says which signal and which unit, and lets the signal's default action end the process. Once, by the main
/// thread. It and every other thread that may crash take an AlternateStack.
Status install() noexcept;
/// A handler of one of these signals that is the runtime's own and calls handle() for what it does not know.
using SignalHandler = void (*)(int signal, siginfo_t* information, void* context);
/// From here `handler` handles `signal`, also after install() and put_handlers_back(). At start, main thread.
/// @returns false, with errno: the signal cannot be handled.
bool handle_with(int signal, SignalHandler handler) noexcept;
/// Where something else was installed for one of these signals since, as by a library, puts the handler back.
/// @returns the first such signal; 0: there was none. Any thread.
int put_handlers_back() noexcept;
/// The handler of these signals where handle_with() has set no other.
void handle(int signal, siginfo_t* information, void* context) noexcept;

/// For a guard that ends the process: writes everything prepared and restores the terminal, then says `text`
/// and where the program stood on standard error, as far as it takes that at once, and aborts. Also in a
/// signal handler; a thread of any kind.
[[noreturn]] void abort_with_trace(const char* text) noexcept;

/// While on, exit(), quick_exit(), _exit() and _Exit() from anywhere in this process do as a crash does:
/// prepared bytes, terminal, a message. The process then ends at once with code 2, before destructors of
/// static objects take away what running threads use. The system call itself (exit_group) cannot be caught.
/// A child of this process ends as it asks to. With a sanitizer only exit() and quick_exit(). Main thread.
void expect_no_exit(bool on) noexcept;

/// What is written when. `last`: after all that is `first`, as a message by which several devices do at the
/// same time what each of them was told before.
enum class Turn : std::uint8_t { first, last };

/// A slot for one device's bytes; −1 when all 64 are taken. Lifecycle thread.
int claim_slot(Turn turn = Turn::first) noexcept;
/// Frees it; nothing is written for it any more. Lifecycle thread.
void release_slot(int slot) noexcept;
/// What is written to `descriptor` in the last gasp, at most 64 bytes; replaces what was prepared before. The
/// owner of the slot, every cycle if need be: wait-free, no system call. False: slot or size out of range.
bool prepare_write(int slot, int descriptor, std::span<const std::byte> bytes) noexcept;
/// Nothing is written for this slot until something is prepared again. The owner of the slot.
void clear(int slot) noexcept;

/// How a terminal is to be left. One terminal; not while a signal may come for it. Non-real-time threads.
void prepare_terminal(int descriptor, const termios& settings) noexcept;
/// Before the descriptor is closed.
void clear_terminal() noexcept;
/// As prepare_terminal() was told; before the process is stopped. Async-signal-safe.
void restore_terminal() noexcept;

/// Writes everything prepared now and restores the terminal; the process goes on. For a supervising thread
/// when an owner does not answer. A descriptor that would block for more than 10 ms is left out.
/// Async-signal-safe. Not when a crash or an exit() is writing them already.
/// @returns number of slots written in full.
int fire() noexcept;

/// A crash or an exit() is ending the process. Whoever sends in every cycle then says nothing any more, or
/// might take back what was prepared: what is under way is let through first, a new one is not to begin. Any
/// thread; no system call.
bool has_begun() noexcept;

/// The unit that this thread steps (a name that lives for ever; null: none), for the crash's message. Its
/// thread.
void set_stepped(const char* unit) noexcept;
/// As set last; null: none. Its thread, also in a signal handler.
const char* stepped() noexcept;

/// An alternate stack for this thread's signal handlers while it lives. Memory is the caller's, preallocated,
/// at least handler_stack_size bytes.
class AlternateStack {
 public:
  explicit AlternateStack(std::span<std::byte> memory) noexcept;
  ~AlternateStack();
  AlternateStack(const AlternateStack&) = delete;
  AlternateStack& operator=(const AlternateStack&) = delete;

 private:
  void* outer_;
  std::size_t outer_size_;
  int outer_flags_;
};

}  // namespace flexrf::last_gasp
