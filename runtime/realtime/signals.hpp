// Signals: what each of them does to a running application. docs/stopping.md has the table for people.
#pragma once

#include <csignal>

namespace flexrf::signals {

/// What is about to take the process away, or has found it broken: the last gasp, then the signal's own
/// action. Never blocked. SIGXCPU is what RLIMIT_RTTIME sends to a real-time thread that never waits, SIGKILL
/// follows it.
inline constexpr int crashing[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP, SIGXCPU};
/// Somebody wants the application to end: the controlled stop; SIGQUIT does not wait for units to come to
/// rest.
inline constexpr int ending[] = {SIGINT, SIGTERM, SIGHUP, SIGPWR, SIGQUIT};
/// Somebody wants the process to stop for a while.
inline constexpr int stopping[] = {SIGTSTP, SIGTTIN, SIGTTOU};

/// Which use a signal is of, where it is not ignored.
enum class Use { crash, end, stop, none };
Use use_of(int signal) noexcept;

/// `ending`, but SIGHUP where whoever started the process has it ignored (nohup).
sigset_t ending_set() noexcept;
/// What the supervising thread waits for: ending, stopping, and all that would end the process for nothing
/// (SIGUSR1, SIGALRM, real-time ones, ...) unless a library handles it.
sigset_t supervised_set() noexcept;

/// What a write tells by its error as well: SIGPIPE, SIGXFSZ. For the whole process.
void ignore_what_writes_tell() noexcept;

/// "SIGTERM", "signal 35"; lives for ever.
const char* name_of(int signal) noexcept;

/// The terminal is lent to other processes now: to set it would disturb them, to read from it gives nothing.
/// Async-signal-safe.
bool is_in_background(int terminal) noexcept;

/// While it lives, its thread, and threads that it starts, take no signal but those of a crash.
class Blocked {
 public:
  Blocked() noexcept;
  ~Blocked();
  Blocked(const Blocked&) = delete;
  Blocked& operator=(const Blocked&) = delete;

 private:
  sigset_t before_;
};

}  // namespace flexrf::signals
