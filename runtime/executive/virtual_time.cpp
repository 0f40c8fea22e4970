#include "runtime/executive/virtual_time.hpp"

#include <unistd.h>

#include <algorithm>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

constexpr Duration least_budget = std::chrono::microseconds{1};
constexpr std::uint32_t events_between_drains = 64;

/// One line for all: an application may have hundreds of threads.
void tell_missing_budgets(const Application& application) noexcept {
  std::size_t count = 0;
  const char* first = "";
  for (const ThreadRecord& thread : application.threads) {
    if (lacks_budget(application, thread) && count++ == 0) first = thread.name;
  }
  if (count == 0) return;
  log_warning(
      application.name,
      "{} of {} threads have units without a budget, the first is {}: in virtual time a step of those lasts "
      "1 us",
      count, application.threads.size(), first);
}

}  // namespace

bool lacks_budget(const Application& application, const ThreadRecord& thread) noexcept {
  return std::any_of(thread.units.begin(), thread.units.end(),
                     [&](std::uint16_t unit) { return application.units[unit].budget <= Duration::zero(); });
}

VirtualTime::Thread::Thread(Cell& cell, std::uint16_t index) : releases(cell, index) {
  for (const std::uint16_t device : record().devices) {
    const PortBinding& ports = cell.ports(cell.application().devices[device].index);
    receives = receives || !ports.outputs.empty() || !ports.queue_outputs.empty();
  }
}

VirtualTime::VirtualTime(Cell& cell, Lifecycle& lifecycle, Supervision& supervision)
    : cell_(&cell), lifecycle_(&lifecycle), supervision_(&supervision), now_(beginning) {
  lifecycle.use_clock(&now_);
  cell.control().use_clock(&now_);
  const std::size_t count = cell.application().threads.size();
  threads_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) threads_.emplace_back(cell, static_cast<std::uint16_t>(i));
  set_log_clock(&now_);
  set_log_origin(beginning);
  tell_missing_budgets(cell.application());
}

VirtualTime::~VirtualTime() {
  set_log_clock(nullptr);
}

Duration VirtualTime::run(Duration duration) noexcept {
  const Time limit = now_ + duration;
  for (Thread& thread : threads_) {
    thread.releases.begin(now_);
    look_for_release(thread);
  }
  Control& control = cell_->control();
  for (std::uint32_t events = 0; control.mode() != Mode::ended; ++events) {
    Thread* thread = next_event();
    Time at = thread == nullptr ? Time::max() : thread->next;
    // With nothing to come the clock still has to reach what supervision waits for.
    at = std::min(
        at, now_ + (control.mode() == Mode::running ? Duration{limit - now_} : Stepper::attention_interval));
    if (control.mode() == Mode::running && at >= limit) {
      now_ = limit;
      control.set_cause(EndCause::virtual_time_over);
      control.rise_to(Mode::stopping);
      supervision_->observe(now_);
      for (Thread& other : threads_) look_for_release(other);
      continue;
    }
    const bool event = thread != nullptr && thread->next <= at;
    now_ = at;
    if (event) {
      if (thread->phase == Phase::waiting) {
        begin(*thread);
      } else {
        complete(*thread);
      }
    }
    if (control.mode() > Mode::running) supervision_->observe(now_);
    if (events % events_between_drains == 0) drain_log(STDERR_FILENO);
    if (lifecycle_->has_jobs()) lifecycle_->run_jobs();
    if (control.mode() == Mode::running) lifecycle_->seek_missing();
    if (control.faults() != faults_) {
      faults_ = control.faults();
      if (control.mode() == Mode::running) lifecycle_->restart_by_policy();
    }
  }
  supervision_->observe(now_);
  for (Thread& thread : threads_) thread.releases.say(Time::max());
  return now_ - beginning;
}

VirtualTime::Thread* VirtualTime::next_event() noexcept {
  Thread* first = nullptr;
  for (Thread& thread : threads_) {
    if (thread.phase == Phase::waiting && thread.record().bell->listen() != thread.heard)
      look_for_release(thread);
    if (thread.next == Time::max()) continue;
    if (first == nullptr || thread.next < first->next) {
      first = &thread;
      continue;
    }
    if (thread.next > first->next) continue;
    const bool completes = thread.phase != Phase::waiting;
    const bool first_completes = first->phase != Phase::waiting;
    if (completes != first_completes) {
      if (completes) first = &thread;
    } else if (thread.record().priority > first->record().priority) {
      first = &thread;
    }
  }
  return first;
}

void VirtualTime::look_for_release(Thread& thread) noexcept {
  if (thread.phase != Phase::waiting) return;
  thread.heard = thread.record().bell->listen();
  thread.stepper().serve(now_);
  thread.due = thread.releases.next(now_, false);
  // Never twice at one instant: that would be without end.
  thread.next = std::max({thread.due.at, now_, thread.released_at + least_budget});
}

void VirtualTime::begin(Thread& thread) noexcept {
  // What was published since the release became due belongs to it.
  look_for_release(thread);
  if (thread.next > now_) return;
  thread.release = thread.releases.take(thread.due, now_);
  thread.released_at = now_;
  thread.stepper().begin(thread.release);
  thread.stepper().receive(now_);
  thread.place = 0;
  if (thread.receives) {
    thread.phase = Phase::receiving;
    thread.next = now_ + least_budget;
    return;
  }
  go_on(thread);
}

void VirtualTime::commit_devices(const Thread& thread) noexcept {
  for (const std::uint16_t device : thread.record().devices)
    cell_->commit(cell_->application().devices[device].index);
}

void VirtualTime::complete(Thread& thread) noexcept {
  // Of the devices also what they published in the unit's step, when it called them.
  commit_devices(thread);
  if (thread.phase != Phase::receiving) {
    cell_->commit(thread.record().units[thread.place]);
    ++thread.place;
  }
  go_on(thread);
}

void VirtualTime::go_on(Thread& thread) noexcept {
  const ThreadRecord& record = thread.record();
  for (; thread.place < record.units.size(); ++thread.place) {
    if (!thread.stepper().step(thread.place, now_)) continue;
    thread.phase = Phase::stepping;
    thread.next =
        now_ + std::max(cell_->application().units[record.units[thread.place]].budget, least_budget);
    return;
  }
  end(thread);
}

void VirtualTime::end(Thread& thread) noexcept {
  thread.stepper().send(now_);
  thread.stepper().finish();
  commit_devices(thread);
  thread.releases.finish(thread.release, now_);
  thread.releases.say(now_);
  thread.phase = Phase::waiting;
  look_for_release(thread);
}

}  // namespace flexrf
