#include "units/saboteur/saboteur.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "runtime/log/log.hpp"

namespace flexrf::user {
namespace {

[[noreturn]] void hang() {
  for (;;) ppoll(nullptr, 0, nullptr, nullptr);  // as on a lock: the checked build lets nobody pause()
}

[[noreturn]] void work_for_ever() {
  for (volatile int count = 0;;) count = count + 1;
}

/// The signal is wanted, not a sanitizer's word for what causes it.
__attribute__((no_sanitize("address", "thread", "undefined"))) void write_where_nothing_is() {
  volatile int* volatile nowhere = nullptr;
  *nowhere = 1;
}

}  // namespace

Status Saboteur::initialise() {
  target_.reset();
  drives_ = silent_ = never_idle_ = refused_ = false;
  return {};
}

void Saboteur::step(const Tick& tick) {
  if (!target_) {
    if (const auto pose = actual.latest()) target_ = *pose;
  }
  if (target_) {
    // One a step, so that what a key begins has begun before the next.
    if (const auto key = keys.pop()) {
      ++feedback.keys_done;
      obey(static_cast<char>(key->character));
    }
  }
  if ((tick.stop_requested || tick.finishing) && never_idle_) {
    if (tick.stop_requested && !refused_) log_warning(name(), "does not come to rest, as it was told");
    refused_ = tick.stop_requested;
  } else if (tick.stop_requested || tick.finishing) {
    drives_ = false;
  }
  drive->command(drives_ ? 1.0 : 0.0);
  feedback.speed = drive->speed();
  if (target_ && !silent_) target.publish(*target_);
}

void Saboteur::obey(char key) {
  switch (key) {
    case 'd':
      drives_ = true;
      break;
    case 'm':
      target_->position[1] += runtime.step;
      break;
    case 'l':
      silent_ = true;
      break;
    case 'n':
      never_idle_ = true;
      break;
    case 'f':
      fail(Status::error(StatusCode::device_fault, "told to fail"));
      break;
    case 't':
      throw std::runtime_error("a library's text");
    case 'h':
      hang();
    case 'w':
      work_for_ever();
    case 's':
      write_where_nothing_is();
      break;
    case 'a':
      std::abort();
    case 'x':
      std::exit(0);
    case 'q':
      std::quick_exit(0);
    case 'y':
      _exit(0);
    case 'z':
      std::_Exit(0);
    case 'c': {
      // A child's end is its own. Nobody waits for it: the process that started this one gets it.
      const pid_t child = fork();
      if (child == 0) std::exit(0);
      break;
    }
    case 'i':
      for (const int signal : {SIGINT, SIGTERM, SIGTSTP}) std::signal(signal, SIG_IGN);
      break;
    case 'v':
      for (const int signal : {SIGSEGV, SIGABRT}) std::signal(signal, SIG_DFL);
      break;
    case 'o':
      if (const int file = open("/dev/null", O_RDONLY | O_CLOEXEC); file >= 0) close(file);
      break;
    case 'k': {
      void* volatile memory = std::malloc(100);
      std::free(memory);
      break;
    }
    default:
      break;
  }
}

}  // namespace flexrf::user
