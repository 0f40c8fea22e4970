#include "runtime/realtime/signals.hpp"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <iterator>

namespace flexrf::signals {

namespace {

/// Without a use here; what they do by themselves is to end the process.
constexpr int pointless[] = {SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO, SIGSTKFLT};

bool has(const auto& signals, int signal) noexcept {
  return std::find(std::begin(signals), std::end(signals), signal) != std::end(signals);
}

bool does(int signal, void (*action)(int)) noexcept {
  struct sigaction present {};
  return sigaction(signal, nullptr, &present) == 0 && (present.sa_flags & SA_SIGINFO) == 0 &&
         present.sa_handler == action;
}

/// A name for each of the kernel's signals, for a log that copies no texts.
using Names = std::array<std::array<char, 24>, NSIG>;
Names make_names() noexcept {
  Names names{};
  for (int signal = 1; signal < NSIG; ++signal) {
    const char* const known = sigabbrev_np(signal);
    auto& text = names[static_cast<std::size_t>(signal)];
    if (known != nullptr) {
      std::snprintf(text.data(), text.size(), "SIG%s", known);
    } else {
      std::snprintf(text.data(), text.size(), "signal %d", signal);
    }
  }
  return names;
}

}  // namespace

Use use_of(int signal) noexcept {
  if (has(crashing, signal)) return Use::crash;
  if (has(ending, signal)) return Use::end;
  return has(stopping, signal) ? Use::stop : Use::none;
}

sigset_t ending_set() noexcept {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : ending) sigaddset(&set, signal);
  if (does(SIGHUP, SIG_IGN)) sigdelset(&set, SIGHUP);
  return set;
}

sigset_t supervised_set() noexcept {
  sigset_t set = ending_set();
  for (const int signal : stopping) sigaddset(&set, signal);
  for (const int signal : pointless) {
    if (does(signal, SIG_DFL)) sigaddset(&set, signal);
  }
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) {
    if (does(signal, SIG_DFL)) sigaddset(&set, signal);
  }
  return set;
}

void ignore_what_writes_tell() noexcept {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

const char* name_of(int signal) noexcept {
  static const Names names = make_names();
  return signal > 0 && signal < NSIG ? names[static_cast<std::size_t>(signal)].data() : "no signal";
}

bool is_in_background(int terminal) noexcept {
  // None: it is not this session's terminal, and nobody is asked for it.
  const pid_t foreground = tcgetpgrp(terminal);
  return foreground > 0 && foreground != getpgrp();
}

Blocked::Blocked() noexcept {
  sigset_t all;
  sigfillset(&all);
  for (const int signal : crashing) sigdelset(&all, signal);
  pthread_sigmask(SIG_BLOCK, &all, &before_);
}

Blocked::~Blocked() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace flexrf::signals
