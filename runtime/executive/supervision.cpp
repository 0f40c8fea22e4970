#include "runtime/executive/supervision.hpp"

#include <algorithm>
#include <span>

#include "runtime/log/log.hpp"
#include "runtime/realtime/last_gasp.hpp"

namespace flexrf {
namespace {

constexpr Duration least_safe_timeout = std::chrono::seconds{1};
constexpr Duration least_hang_timeout = std::chrono::milliseconds{500};

}  // namespace

Supervision::Supervision(Cell& cell, Lifecycle& lifecycle, bool watch_for_hangs) noexcept
    : cell_(&cell),
      lifecycle_(&lifecycle),
      watch_for_hangs_(watch_for_hangs),
      steps_(cell.application().threads.size()),
      safe_timeout_(least_safe_timeout),
      cycles_when_quiet_(cell.application().threads.size()) {
  for (const ThreadRecord& thread : cell.application().threads) {
    settle_time_ = std::max({settle_time_, 2 * thread.trigger.period, 2 * thread.trigger.min_interval,
                             2 * thread.trigger.longest});
    safe_timeout_ = std::max(safe_timeout_, hang_timeout(thread));
  }
  settle_time_ += std::chrono::milliseconds{5};
}

Duration Supervision::hang_timeout(const ThreadRecord& thread) noexcept {
  if (thread.hang_timeout.count() > 0) return thread.hang_timeout;
  return std::max(least_hang_timeout, 20 * thread.deadline);
}

void Supervision::observe(Time now) noexcept {
  const Mode mode = cell_->control().mode();
  if (mode != mode_) begin_phase(mode, now);
  watch_faults();
  if (watch_for_hangs_) {
    const Duration missed = missed_time_.until(now);
    entered_at_ += missed;
    watch_hangs(now, missed);
  }
  switch (mode) {
    case Mode::finishing:
      return finish(now);
    case Mode::stopping:
      return stop(now);
    case Mode::safe:
      return make_safe(now);
    case Mode::starting:
    case Mode::running:
    case Mode::ended:
      return;
  }
}

void Supervision::watch_faults() noexcept {
  had_fault_ = had_fault_ || cell_->control().faults() > 0;
}

void Supervision::watch_hangs(Time now, Duration missed) noexcept {
  if (stuck_) return;
  const Application& application = cell_->application();
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    if (hangs(i, now, missed)) {
      const char* const stepped = application.thread_states[i].stepped.load(std::memory_order_relaxed);
      log_error(
          application.threads[i].name,
          "this thread's step does not return: {} has kept it for more than {} ms; end what it waits for, or "
          "have it in a thread with priority = 0 and a hang_timeout",
          StaticText{stepped != nullptr ? stepped : "the executive"},
          std::chrono::duration_cast<std::chrono::milliseconds>(hang_timeout(application.threads[i]))
              .count());
      give_up();
      return;
    }
  }
  const Lifecycle::Operation operation = lifecycle_->operation();
  if (operation.component != nullptr && is_overdue(operation, now, missed)) {
    log_error(operation.component,
              "initialise() or stop() does not return in its time; give it more by initialise_timeout or "
              "stop_timeout");
    give_up();
  }
}

bool Supervision::hangs(std::size_t thread, Time now, Duration missed) noexcept {
  const Application& application = cell_->application();
  const std::int64_t began = application.thread_states[thread].step_began.load(std::memory_order_acquire);
  Step& step = steps_[thread];
  if (began != step.began) {
    step = {began, now};
  } else {
    step.seen_at += missed;
  }
  return began != 0 && now - step.seen_at > hang_timeout(application.threads[thread]);
}

bool Supervision::is_overdue(const Lifecycle::Operation& operation, Time now, Duration missed) noexcept {
  if (operation.overdue_at != operation_overdue_at_) {
    operation_overdue_at_ = operation.overdue_at;
    operation_missed_ = Duration{};
  }
  operation_missed_ += missed;
  return now - operation_missed_ > operation.overdue_at;
}

void Supervision::give_up() noexcept {
  stuck_ = true;
  had_fault_ = true;
  log_error(cell_->application().name,
            "what hangs cannot be ended: every device is made safe, then the process ends");
  cell_->control().set_cause(EndCause::fault);
  cell_->control().rise_to(Mode::safe);
  // Whoever hangs cannot make its own devices safe: their drivers prepared for this.
  last_gasp::fire();
}

bool Supervision::units_are_idle() const noexcept {
  const Application& application = cell_->application();
  return std::all_of(application.unit_states.begin(), application.unit_states.end(),
                     [](const UnitState& state) {
                       return state.life.load(std::memory_order_acquire) != Life::running ||
                              state.idle.load(std::memory_order_acquire);
                     });
}

bool Supervision::an_event_is_handled() const noexcept {
  const Application& application = cell_->application();
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    if (application.threads[i].trigger.kind == TriggerKind::period) continue;
    if (application.thread_states[i].step_began.load(std::memory_order_acquire) != 0) return true;
  }
  return false;
}

bool Supervision::is_quiet() const noexcept {
  for (const QueueRecord& queue : cell_->application().queues) {
    for (const QueueSource* source : queue.sources) {
      if (!source->is_empty() && !cell_->is_abandoned(source)) return false;
    }
  }
  // What a step took out of a queue is in nobody's hands until it ends, and the machine may stand still in
  // it.
  return !an_event_is_handled() && units_are_idle();
}

void Supervision::enter(Mode mode, Time now) noexcept {
  cell_->control().rise_to(mode);
  begin_phase(cell_->control().mode(), now);
}

void Supervision::begin_phase(Mode mode, Time now) noexcept {
  mode_ = mode;
  entered_at_ = now;
  was_quiet_ = false;
}

/// From the first look on that saw it: what was under way at the look before may have ended just now, with
/// something for others to do.
void Supervision::note_quiet(bool quiet, Time now) noexcept {
  const bool begins = quiet && !was_quiet_;
  was_quiet_ = quiet;
  if (!begins) return;
  quiet_since_ = now;
  const std::span<const ThreadState> states = cell_->application().thread_states;
  for (std::size_t i = 0; i < states.size(); ++i) {
    cycles_when_quiet_[i] = states[i].cycles.load(std::memory_order_relaxed);
  }
}

/// Quiet counts only when it has lasted, and when every periodic thread has had two turns in which to find
/// something to do: on a loaded machine time alone says nothing about who ran in it. Asked before it is
/// looked whether all is quiet still: then what those turns began is seen.
bool Supervision::has_settled(Time now) const noexcept {
  if (!was_quiet_ || now - quiet_since_ <= settle_time_) return false;
  const Application& application = cell_->application();
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    const bool periodic = application.threads[i].trigger.kind == TriggerKind::period;
    const std::uint64_t cycles = application.thread_states[i].cycles.load(std::memory_order_acquire);
    if (periodic && cycles - cycles_when_quiet_[i] < 2) return false;
  }
  return true;
}

void Supervision::finish(Time now) noexcept {
  const bool has_lasted = has_settled(now);
  const bool quiet = is_quiet();
  note_quiet(quiet, now);
  if (now - entered_at_ > cell_->application().finish_timeout) {
    log_warning(cell_->application().name, "not finished within finish_timeout; stopping now");
    cut_short_ = true;
    enter(Mode::stopping, now);
  } else if (has_lasted && quiet) {
    enter(Mode::stopping, now);
  }
}

void Supervision::stop(Time now) noexcept {
  const bool has_lasted = has_settled(now);
  const bool at_rest = units_are_idle();
  note_quiet(at_rest, now);
  if (now - entered_at_ > cell_->application().stop_timeout) {
    log_warning(cell_->application().name, "not at rest within stop_timeout; every device is made safe");
    cut_short_ = true;
    enter(Mode::safe, now);
  } else if (has_lasted && at_rest) {
    enter(Mode::safe, now);
  }
}

void Supervision::make_safe(Time now) noexcept {
  const Application& application = cell_->application();
  const bool safe = std::all_of(
      application.device_states.begin(), application.device_states.end(), [](const DeviceState& state) {
        return state.ownership.load(std::memory_order_acquire) != Ownership::thread ||
               state.safe.load(std::memory_order_acquire);
      });
  if (safe) {
    enter(Mode::ended, now);
  } else if (now - entered_at_ > safe_timeout_) {
    for (std::size_t i = 0; i < application.devices.size(); ++i) {
      if (!application.device_states[i].safe.load())
        log_error(application.devices[i].name, "did not become safe in time");
    }
    // For a thread that hangs it was done at once.
    if (!stuck_) last_gasp::fire();
    had_fault_ = true;
    enter(Mode::ended, now);
  }
}

}  // namespace flexrf
