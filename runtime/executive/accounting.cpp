#include "runtime/executive/accounting.hpp"

namespace flexrf {

bool Accounting::count(const Release& release, Time ended, std::uint64_t past_releases) noexcept {
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
    return false;
  }
  state_->overruns.store(state_->overruns.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  if (record_->overrun != OverrunPolicy::catch_up) {
    state_->skipped.store(state_->skipped.load(std::memory_order_relaxed) + past_releases,
                          std::memory_order_relaxed);
  }
  if (record_->overrun == OverrunPolicy::fault && record_->limit.limit == 0) return true;
  if (record_->limit.limit == 0 || ++level_ < record_->limit.limit) return false;
  // Counted anew for what is started again, and for what was not yet running when it happened.
  level_ = 0;
  good_ = 0;
  return true;
}

}  // namespace flexrf
