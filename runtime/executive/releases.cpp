#include "runtime/executive/releases.hpp"

#include <algorithm>

namespace flexrf {
namespace {

/// By the trigger's bits. The drivers are chosen by now.
std::uint32_t own_queues(const Cell& cell, const ThreadRecord& thread) noexcept {
  const auto takes_from = [&](const QueueSource* queue) {
    return std::any_of(thread.units.begin(), thread.units.end(),
                       [&](std::uint16_t unit) { return cell.ports(unit).takes_from(queue); }) ||
           std::any_of(thread.devices.begin(), thread.devices.end(), [&](std::uint16_t device) {
             return cell.ports(cell.application().devices[device].index).takes_from(queue);
           });
  };
  std::uint32_t own = 0;
  for (std::size_t i = 0; i < thread.trigger.sources.size(); ++i) {
    const QueueSource* const queue = thread.trigger.sources[i].queue;
    if (queue != nullptr && takes_from(queue)) own |= std::uint32_t{1} << i;
  }
  return own;
}

/// Units of the thread that take from one of its trigger's queues.
std::vector<const UnitState*> takers(const Cell& cell, const ThreadRecord& thread) {
  std::vector<const UnitState*> found;
  for (const std::uint16_t unit : thread.units) {
    const bool takes = std::any_of(
        thread.trigger.sources.begin(), thread.trigger.sources.end(), [&](const TriggerSource& source) {
          return source.queue != nullptr && cell.ports(unit).takes_from(source.queue);
        });
    if (takes) found.push_back(&cell.application().unit_states[unit]);
  }
  return found;
}

}  // namespace

Releases::Releases(Cell& cell, std::uint16_t thread)
    : control_(&cell.control()),
      record_(&cell.application().threads[thread]),
      stepper_(cell, thread),
      takers_(takers(cell, *record_)),
      trigger_(record_->trigger, cell.application(), own_queues(cell, *record_)),
      accounting_(*record_, cell.application().thread_states[thread]) {}

/// A unit that is not idle holds what it took from a queue and could not complete yet.
bool Releases::holds_items() const noexcept {
  return std::any_of(takers_.begin(), takers_.end(), [](const UnitState* unit) {
    return unit->is_owned_by_thread() && !unit->idle.load(std::memory_order_relaxed);
  });
}

Due Releases::next(Time now, bool readable) noexcept {
  if (const Time from = control_->judged_from(); from != Time::max()) trigger_.leave_out_before(from);
  const Due due = trigger_.due(now, readable, holds_items());
  const Time attention = trigger_.last_release() + Stepper::attention_interval;
  if (due.at <= attention || !stepper_.needs_attention()) return due;
  return Due{attention, due.fired, true};
}

Release Releases::take(const Due& due, Time now) noexcept {
  // A period is late against its own instant; everything else is due when it is noticed.
  const bool periodic = record_->trigger.kind == TriggerKind::period && !due.timed_out;
  const Release release{periodic ? due.at : now, now, due.fired, due.timed_out};
  trigger_.released(release.nominal, now);
  if (record_->trigger.kind == TriggerKind::backoff) {
    ThreadState& state = stepper_.state();
    state.backoff_mean.store(trigger_.backoff().mean().count(), std::memory_order_relaxed);
    state.backoff_spread.store(trigger_.backoff().spread().count(), std::memory_order_relaxed);
  }
  return release;
}

bool Releases::finish(const Release& release, Time ended) noexcept {
  const std::uint64_t past = trigger_.finished(ended, record_->overrun);
  if (release.nominal < control_->judged_from()) return false;
  const Accounting::Verdict verdict = accounting_.count(release, ended, past);
  if (verdict.limit_reached)
    stepper_.fault_all(
        Status::error(StatusCode::timeout, "thread %s reached its overrun limit: %lld us after it was due",
                      record_->name, static_cast<long long>((ended - release.nominal).count() / 1000)));
  return verdict.overrun;
}

}  // namespace flexrf
