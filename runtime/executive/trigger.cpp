#include "runtime/executive/trigger.hpp"

#include <algorithm>

namespace flexrf {

Status check_triggers(const Application& application) {
  for (const ThreadRecord& thread : application.threads) {
    const std::size_t sources = thread.trigger.sources.size();
    if (sources <= Trigger::max_sources) continue;
    return Status::error(StatusCode::invalid_argument,
                         "thread %s waits for %zu slots and queues, more than %zu; name fewer, or give it a "
                         "period",
                         thread.name, sources, Trigger::max_sources);
  }
  return {};
}

Trigger::Trigger(const TriggerRecord& record, const Application& application) noexcept
    : record_(&record),
      application_(&application),
      backoff_(BackoffLimits{record.shortest, record.longest, std::max<std::uint32_t>(record.tries, 1)}) {}

void Trigger::begin(Time start) noexcept {
  next_ = start + record_->phase;
  last_ = start;
  poll_at_ = start;
  advanced();
  cursors_ = seen_;
}

std::uint64_t Trigger::count_of(std::size_t source) const noexcept {
  const TriggerSource& watched = record_->sources[source];
  return watched.slot != nullptr ? watched.slot->published() : watched.queue->arrivals();
}

std::uint32_t Trigger::advanced() noexcept {
  std::uint32_t fired = 0;
  for (std::size_t i = 0; i < record_->sources.size(); ++i) {
    seen_[i] = count_of(i);
    if (seen_[i] != cursors_[i]) fired |= std::uint32_t{1} << i;
  }
  return fired;
}

Due Trigger::due(Time now, bool readable) noexcept {
  switch (record_->kind) {
    case TriggerKind::period:
      return Due{next_, 0, false};
    case TriggerKind::slots:
      return due_by_sources(now);
    case TriggerKind::device:
      return due_by_device(now, readable);
    case TriggerKind::backoff:
      return due_by_backoff(now);
    case TriggerKind::free:
      return Due{now, 0, false};
  }
  return Due{};
}

void Trigger::add_timeout(Due& due) const noexcept {
  if (record_->timeout.count() == 0) return;
  const Time timeout = last_ + record_->timeout;
  if (timeout < due.at) due = Due{timeout, due.fired, due.fired == 0};
}

Due Trigger::due_by_sources(Time now) noexcept {
  Due due;
  due.fired = advanced();
  if (due.fired != 0) due.at = std::max(now, last_ + record_->min_interval);
  add_timeout(due);
  return due;
}

const Device* Trigger::owned_device() const noexcept {
  const DeviceState& state = application_->device_states[record_->device];
  return state.is_owned_by_thread() ? state.device : nullptr;
}

Due Trigger::due_by_device(Time now, bool readable) const noexcept {
  Due due;
  if (const Device* device = owned_device(); device != nullptr)
    due.at = readable ? now : device->next_event();
  if (due.at != Time::max()) {
    // What is still to come has not fired: the timeout may be first.
    due.fired = due.at <= now ? 1 : 0;
    due.at = std::max(due.at, last_ + record_->min_interval);
  }
  add_timeout(due);
  return due;
}

Due Trigger::due_by_backoff(Time now) noexcept {
  if (!found_ && now < poll_at_) return Due{poll_at_, 0, false};
  advanced();
  if (found_) return Due{now, 1, false};
  const std::uint64_t arrived = seen_[0] - cursors_[0];
  if (arrived == 0) {
    poll_at_ = backoff_.miss(now);
    return Due{poll_at_, 0, false};
  }
  // A slot tells when its item came about; of a queue only the poll's time is known.
  const SlotControl* slot = record_->sources[0].slot;
  poll_at_ = backoff_.hit(now, slot == nullptr ? now : slot->published_at(), arrived);
  found_ = true;
  return Due{now, 1, false};
}

void Trigger::released(Time nominal, Time now) noexcept {
  last_ = now;
  found_ = false;
  if (record_->kind == TriggerKind::period) next_ = nominal + record_->period;
  for (std::size_t i = 0; i < record_->sources.size(); ++i) cursors_[i] = seen_[i];
}

std::uint64_t Trigger::finished(Time ended, OverrunPolicy policy) noexcept {
  if (record_->kind != TriggerKind::period || next_ > ended) return 0;
  const auto past = static_cast<std::uint64_t>((ended - next_) / record_->period);
  // A release that is due just now, or late by less than a period, still takes place; those before it are
  // left out.
  if (policy != OverrunPolicy::catch_up) next_ += record_->period * static_cast<std::int64_t>(past);
  return past;
}

int Trigger::descriptor() const noexcept {
  if (record_->kind != TriggerKind::device) return -1;
  const Device* device = owned_device();
  return device == nullptr ? -1 : device->descriptor();
}

}  // namespace flexrf
