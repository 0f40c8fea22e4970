#include "runtime/executive/accounting.hpp"

namespace flexrf {
namespace {

/// One writer.
template <class Value>
void add(std::atomic<Value>& counter, Value value) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + value, std::memory_order_relaxed);
}

}  // namespace

Accounting::Verdict Accounting::count(const Release& release, Time ended,
                                      std::uint64_t past_releases) noexcept {
  state_->lateness.add(release.now - release.nominal);
  state_->execution.add(ended - release.now);
  // Late to begin or long to run: what counts is when it was done.
  const bool overrun =
      past_releases > 0 || (record_->deadline.count() > 0 && ended > release.nominal + record_->deadline);
  if (!overrun) {
    if (!record_->limit.leaky) {
      level_ = 0;
    } else if (level_ > 0 && ++good_ >= record_->limit.drain) {
      --level_;
      good_ = 0;
    }
    return {};
  }
  add(state_->overruns, std::uint64_t{1});
  const std::uint64_t skipped = record_->overrun == OverrunPolicy::catch_up ? 0 : past_releases;
  const Duration skipped_time = record_->trigger.period * static_cast<std::int64_t>(skipped);
  add(state_->skipped, skipped);
  add(state_->skipped_time, skipped_time.count());
  // After the deadline, or after the next release was due.
  const Duration allowed = past_releases > 0 ? record_->trigger.period : record_->deadline;
  log_.note(ended, ended - release.nominal - allowed, skipped, skipped_time);
  if (record_->overrun == OverrunPolicy::fault && record_->limit.limit == 0) return {true, true};
  level_ += 1 + skipped;
  if (record_->limit.limit == 0 || level_ < record_->limit.limit) return {true, false};
  // Counted anew for what is started again, and for what was not yet running when it happened.
  level_ = 0;
  good_ = 0;
  return {true, true};
}

}  // namespace flexrf
