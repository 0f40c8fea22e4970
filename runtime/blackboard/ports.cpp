#include "runtime/blackboard/ports.hpp"

namespace flexrf {

void InputCursor::judge(const ItemHeader* header) noexcept {
  freshness_ = Freshness::null;
  missed_ = 0;
  reason_ = null_reason_of(reader_->slot()->writer_state());
  if (reason_ != NullReason::none) return;
  if (header == nullptr) {
    reason_ = NullReason::nothing_yet;
    return;
  }
  if (max_age_.count() > 0 && age(*header) > max_age_) {
    reason_ = NullReason::too_old;
    return;
  }
  if (header->sequence == cursor_) {
    freshness_ = Freshness::old_item;
    return;
  }
  freshness_ = Freshness::new_item;
  // The first item an input sees misses nothing.
  if (cursor_ != 0) missed_ = sequences_between(cursor_, header->sequence);
  cursor_ = header->sequence;
  read_.store(read() + 1, std::memory_order_relaxed);
  if (missed_ > 0) missed_total_.store(missed() + missed_, std::memory_order_relaxed);
}

}  // namespace flexrf
