#include "runtime/executive/releases.hpp"

namespace flexrf {

Releases::Releases(Cell& cell, std::uint16_t thread)
    : record_(&cell.application().threads[thread]),
      stepper_(cell, thread),
      trigger_(record_->trigger, cell.application()),
      accounting_(*record_, cell.application().thread_states[thread]) {}

Due Releases::next(Time now, bool readable) noexcept {
  const Due due = trigger_.due(now, readable);
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

void Releases::finish(const Release& release, Time ended) noexcept {
  const std::uint64_t past = trigger_.finished(ended, record_->overrun);
  if (!accounting_.count(release, ended, past)) return;
  stepper_.fault_all(
      Status::error(StatusCode::timeout, "thread %s reached its overrun limit: %lld us after it was due",
                    record_->name, static_cast<long long>((ended - release.nominal).count() / 1000)));
}

}  // namespace flexrf
