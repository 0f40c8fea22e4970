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

Trigger::Trigger(const TriggerRecord& record, const Application& application,
                 std::uint32_t own_queues) noexcept
    : record_(&record),
      application_(&application),
      own_queues_(own_queues),
      backoff_(BackoffLimits{record.shortest, record.longest, std::max<std::uint32_t>(record.tries, 1)}) {}

void Trigger::begin(Time start) noexcept {
  next_ = start + record_->phase;
  last_ = start;
  poll_at_ = start;
  advanced();
  cursors_ = seen_;
  taken_ = taken();
  judged_ = false;
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

std::uint64_t Trigger::taken() const noexcept {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < record_->sources.size(); ++i) {
    const std::uint32_t bit = std::uint32_t{1} << i;
    if ((own_queues_ & bit) != 0) sum += record_->sources[i].queue->departures();
  }
  return sum;
}

std::uint32_t Trigger::waiting(bool holds_items) const noexcept {
  if (holds_items) return own_queues_;
  std::uint32_t queues = 0;
  for (std::size_t i = 0; i < record_->sources.size(); ++i) {
    const std::uint32_t bit = std::uint32_t{1} << i;
    if ((own_queues_ & bit) != 0 && !record_->sources[i].queue->is_empty()) queues |= bit;
  }
  return queues;
}

/// Own queues in which the last step left something that is still there. The first look after a release
/// judges its step; what comes later is an arrival.
std::uint32_t Trigger::left_behind(Time now, bool holds_items) noexcept {
  if (!judged_) {
    judged_ = true;
    left_ = waiting(holds_items);
    const bool is_backoff = record_->kind == TriggerKind::backoff;
    const Duration soonest = is_backoff ? record_->shortest : record_->min_interval;
    const Duration first = is_backoff ? soonest : std::max(soonest, first_pause);
    const Duration longest = is_backoff ? record_->longest : std::max(soonest, longest_pause);
    const bool took = taken() != taken_;
    pause_ = took || left_ == 0 ? Duration{} : std::clamp(2 * pause_, first, longest);
    // The pause counts from the end of the step: a long one must not follow on itself.
    offer_at_ = std::max(last_ + soonest, now + pause_);
  }
  return left_ == 0 ? 0 : left_ & waiting(holds_items);
}

Due Trigger::due(Time now, bool readable, bool holds_items) noexcept {
  switch (record_->kind) {
    case TriggerKind::period:
      return Due{next_, 0, false};
    case TriggerKind::slots:
      return due_by_sources(now, holds_items);
    case TriggerKind::device:
      return due_by_device(now, readable);
    case TriggerKind::backoff:
      return due_by_backoff(now, holds_items);
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

Due Trigger::due_by_sources(Time now, bool holds_items) noexcept {
  const std::uint32_t arrived = advanced();
  const std::uint32_t left = left_behind(now, holds_items);
  Due due;
  due.fired = arrived | left;
  if (arrived != 0)
    due.at = std::max(now, last_ + record_->min_interval);
  else if (left != 0)
    due.at = std::max(now, offer_at_);
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

Due Trigger::due_by_backoff(Time now, bool holds_items) noexcept {
  const Time offer_at = left_behind(now, holds_items) != 0 ? offer_at_ : Time::max();
  if (!found_ && now < std::min(poll_at_, offer_at)) return Due{std::min(poll_at_, offer_at), 0, false};
  advanced();
  if (found_) return Due{now, 1, false};
  const std::uint64_t arrived = seen_[0] - cursors_[0];
  if (arrived == 0) {
    if (now >= poll_at_) poll_at_ = backoff_.miss(now);
    // An offer is no arrival: the rhythm that is learned is the writer's.
    if (now >= offer_at) return Due{now, 1, false};
    return Due{std::min(poll_at_, offer_at), 0, false};
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
  judged_ = false;
  taken_ = taken();
  // An offer may come just before a poll.
  if (record_->kind == TriggerKind::backoff) poll_at_ = std::max(poll_at_, now + record_->shortest);
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

void Trigger::leave_out_before(Time time) noexcept {
  if (record_->kind != TriggerKind::period || next_ >= time) return;
  // Rounded up: the grid of instants stays.
  next_ += record_->period * ((time - next_ + record_->period - Duration{1}) / record_->period);
}

int Trigger::descriptor() const noexcept {
  if (record_->kind != TriggerKind::device) return -1;
  const Device* device = owned_device();
  return device == nullptr ? -1 : device->descriptor();
}

}  // namespace flexrf
