#include "runtime/executive/thread_loop.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "runtime/log/log.hpp"
#include "runtime/realtime/last_gasp.hpp"
#include "runtime/realtime/realtime_scope.hpp"
#include "runtime/realtime/system_call_filter.hpp"

namespace flexrf {
namespace {

rusage usage_of_this_thread() noexcept {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage;
}

}  // namespace

ThreadLoop::ThreadLoop(Cell& cell, std::uint16_t thread)
    : cell_(&cell),
      record_(&cell.application().threads[thread]),
      releases_(cell, thread),
      standstill_(cell, thread) {}

ThreadLoop::~ThreadLoop() {
  if (event_descriptor_ >= 0) close(event_descriptor_);
}

Status ThreadLoop::prepare() {
  handler_stack_ = std::make_unique<std::byte[]>(last_gasp::handler_stack_size);
  if (record_->trigger.kind != TriggerKind::device) return {};
  event_descriptor_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (event_descriptor_ < 0) {
    return Status::error(StatusCode::internal, "thread %s: no eventfd: %s", record_->name,
                         std::strerror(errno));
  }
  record_->bell->use_descriptor(event_descriptor_);
  return {};
}

void ThreadLoop::run() noexcept {
  const last_gasp::AlternateStack handler_stack({handler_stack_.get(), last_gasp::handler_stack_size});
  std::optional<RealtimeScope> guard;
  if (record_->priority > 0) {
    watch_system_calls();
    guard.emplace(releases_.stepper().state().allocations);
  }
  const rusage before = usage_of_this_thread();
  releases_.begin(MonotonicClock::now());
  while (cell_->control().mode() != Mode::ended) turn(record_->bell->listen());
  const rusage after = usage_of_this_thread();
  const auto count = [](std::atomic<std::uint64_t>& counter, long from, long to) {
    counter.store(static_cast<std::uint64_t>(to - from), std::memory_order_relaxed);
  };
  ThreadState& state = releases_.stepper().state();
  count(state.minor_faults, before.ru_minflt, after.ru_minflt);
  count(state.major_faults, before.ru_majflt, after.ru_majflt);
  count(state.voluntary_switches, before.ru_nvcsw, after.ru_nvcsw);
  count(state.involuntary_switches, before.ru_nivcsw, after.ru_nivcsw);
  releases_.say(Time::max());
  // What the lifecycle thread still asks for is given back here; after this nobody steps.
  releases_.stepper().serve(MonotonicClock::now());
}

void ThreadLoop::watch_system_calls() noexcept {
  if (filter_system_calls == nullptr) return;
  if (const Status status = filter_system_calls(record_->name); !status) {
    log_warning(record_->name, "{}", status.cause());
  }
}

void ThreadLoop::turn(std::uint32_t heard) noexcept {
  const Time now = MonotonicClock::now();
  Stepper& stepper = releases_.stepper();
  std::atomic<std::uint64_t>& turns = stepper.state().turns;
  turns.store(turns.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  stepper.serve(now);
  releases_.say(now);
  const Due due = releases_.next(now, readable_);
  if (due.at <= now) {
    release(due, now);
  } else {
    wait(heard, due.at);
  }
}

void ThreadLoop::release(const Due& due, Time now) noexcept {
  const Release release = releases_.take(due, now);
  readable_ = false;
  // Before the step: what was commanded before the standstill is not to go on by itself.
  if (standstill_.judge(due_since(release), now)) releases_.stepper().serve(now);
  const Time ended = releases_.stepper().run(release);
  if (record_->hang_timeout.count() == 0) standstill_.judge(now, ended);
  const bool overrun = releases_.finish(release, ended);
  standstill_.judge_release(release.nominal, ended, overrun);
}

Time ThreadLoop::due_since(const Release& release) const noexcept {
  if (record_->trigger.kind == TriggerKind::period) return release.nominal;
  // Nothing tells when it should have run; while the process is stopped, nobody supervises either.
  const Time looked = cell_->control().looked_at();
  return looked == Time{} ? release.now : looked;
}

void ThreadLoop::wait(std::uint32_t heard, Time until) noexcept {
  if (event_descriptor_ >= 0) {
    // What is there already waits for min_interval too: to look at it again would end the wait at once.
    const bool waits_for_us = readable_;
    wait_with_descriptor(heard, until, waits_for_us ? -1 : releases_.descriptor());
    readable_ = readable_ || waits_for_us;
  } else {
    record_->bell->wait(heard, until);
  }
}

void ThreadLoop::wait_with_descriptor(std::uint32_t heard, Time until, int descriptor) noexcept {
  if (!record_->bell->announce(heard)) return;
  pollfd watched[2] = {{event_descriptor_, POLLIN, 0}, {descriptor, POLLIN, 0}};
  timespec timeout{};
  if (until != Time::max()) {
    const Duration left = std::max(until - MonotonicClock::now(), Duration{0});
    timeout.tv_sec = static_cast<time_t>(left.count() / 1'000'000'000);
    timeout.tv_nsec = static_cast<long>(left.count() % 1'000'000'000);
  }
  const int ready =
      ppoll(watched, descriptor < 0 ? 1 : 2, until == Time::max() ? nullptr : &timeout, nullptr);
  record_->bell->settle();
  // Hang-up and error are something to receive too, and so is a descriptor that somebody else has closed: the
  // driver reads and learns of it.
  readable_ = ready > 0 && (watched[1].revents & (POLLIN | POLLHUP | POLLERR | POLLNVAL)) != 0;
}

}  // namespace flexrf
