#include "hal/operator/keyboard/terminal/raw_terminal.hpp"

#include <termios.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "runtime/realtime/last_gasp.hpp"
#include "runtime/realtime/signals.hpp"

namespace flexrf::raw_terminal {
namespace {

// For the signal handlers: written before `raw` becomes true, and not while it is.
termios settings_before;
termios settings_raw;
struct sigaction continue_before;
int descriptor = -1;
std::atomic<bool> raw{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// From the background nothing is set: the terminal is another's. And nowhere is waited for what was written
// to the terminal before (TCSADRAIN): one that a person has stopped by Ctrl-S, or that nobody reads, would
// hold up whoever sets it.

// SIGCONT: after fg, not after bg (the terminal is another's then, until the next fg).
void after_continuing(int) {
  const int error = errno;
  if (raw.load() && !signals::is_in_background(descriptor)) tcsetattr(descriptor, TCSANOW, &settings_raw);
  errno = error;
}

}  // namespace

Status enter(int terminal) noexcept {
  leave();
  if (tcgetattr(terminal, &settings_before) != 0) {
    return Status::error(StatusCode::unavailable, "the terminal does not tell its settings: %s",
                         std::strerror(errno));
  }
  settings_raw = settings_before;
  settings_raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  settings_raw.c_iflag &= ~static_cast<tcflag_t>(ICRNL | IXON);
  settings_raw.c_cc[VMIN] = 1;
  settings_raw.c_cc[VTIME] = 0;
  if (!signals::is_in_background(terminal) && tcsetattr(terminal, TCSANOW, &settings_raw) != 0) {
    return Status::error(StatusCode::unavailable, "the terminal cannot be made raw: %s",
                         std::strerror(errno));
  }
  descriptor = terminal;
  raw.store(true);
  last_gasp::prepare_terminal(terminal, settings_before);
  struct sigaction action {};
  action.sa_handler = after_continuing;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  sigaction(SIGCONT, &action, &continue_before);
  static const bool at_exit = std::atexit(leave) == 0;
  static_cast<void>(at_exit);
  return {};
}

void leave() noexcept {
  if (!raw.load()) return;
  sigaction(SIGCONT, &continue_before, nullptr);
  raw.store(false);
  if (!signals::is_in_background(descriptor)) tcsetattr(descriptor, TCSANOW, &settings_before);
  last_gasp::clear_terminal();
}

}  // namespace flexrf::raw_terminal
