#include "runtime/executive/job_control.hpp"

#include <signal.h>
#include <unistd.h>

#include <ctime>
#include <vector>

#include "runtime/log/log.hpp"
#include "runtime/realtime/last_gasp.hpp"
#include "runtime/realtime/signals.hpp"

namespace flexrf {
namespace {

constexpr Duration longest_wait = std::chrono::milliseconds{250};
constexpr timespec pause_between_looks{0, 1'000'000};
/// For the log and the status view, which are written by another thread.
constexpr timespec time_to_write{0, 50'000'000};

}  // namespace

void JobControl::stop(int signal) noexcept {
  Control& control = cell_->control();
  control.begin_break();
  control.require_start();
  let_threads_act();
  log_warning(cell_->application().name,
              "stopped by {}; actuators are inhibited, and need a Start afterwards",
              StaticText{signals::name_of(signal)});
  nanosleep(&time_to_write, nullptr);
  last_gasp::restore_terminal();
  const Time stopped = MonotonicClock::now();
  kill(getpid(), SIGSTOP);
  // Asked for again while the process was stopped: it goes on now, at somebody's wish.
  sigset_t again;
  sigemptyset(&again);
  for (const int one : signals::stopping) sigaddset(&again, one);
  const timespec at_once{};
  while (sigtimedwait(&again, nullptr, &at_once) > 0) {
  }
  // The threads are not judged by what they missed meanwhile, however late they go on.
  let_threads_act();
  control.end_break(MonotonicClock::now());
  log_warning(cell_->application().name, "goes on after {:.1} s; nothing moves before a Start",
              seconds(MonotonicClock::now() - stopped));
}

void JobControl::let_threads_act() const noexcept {
  const Application& application = cell_->application();
  // A periodic thread sends what its actuators are told in the cycle after the one that inhibits them; others
  // have no cycle to come, and only look.
  const auto count_of = [&application](std::size_t thread) {
    const ThreadState& state = application.thread_states[thread];
    const bool periodic = application.threads[thread].trigger.kind == TriggerKind::period;
    return (periodic ? state.cycles : state.turns).load(std::memory_order_acquire);
  };
  std::vector<std::uint64_t> enough(application.threads.size());
  for (std::size_t i = 0; i < enough.size(); ++i) enough[i] = count_of(i) + 2;
  const Time give_up = MonotonicClock::now() + longest_wait;
  const auto have_acted = [&] {
    for (std::size_t i = 0; i < enough.size(); ++i) {
      if (count_of(i) < enough[i]) return false;
    }
    return true;
  };
  while (!have_acted() && MonotonicClock::now() < give_up) {
    cell_->control().wake_all();
    nanosleep(&pause_between_looks, nullptr);
  }
}

}  // namespace flexrf
