#include "runtime/blackboard/ports.hpp"

namespace flexrf {

void InputCursor::judge(const ItemHeader* header) noexcept {
  freshness_ = Freshness::null;
  missed_ = 0;
  switch (reader_->slot()->writer_state()) {
    case WriterState::stopped:
      reason_ = NullReason::writer_stopped;
      return;
    case WriterState::faulted:
      reason_ = NullReason::writer_faulted;
      return;
    case WriterState::retired:
      reason_ = NullReason::writer_retired;
      return;
    case WriterState::waiting:
    case WriterState::running:
      break;
  }
  if (header == nullptr) {
    reason_ = NullReason::nothing_yet;
    return;
  }
  if (max_age_.count() > 0 && age(*header) > max_age_) {
    reason_ = NullReason::too_old;
    return;
  }
  reason_ = NullReason::none;
  if (header->sequence == cursor_) {
    freshness_ = Freshness::old_item;
    return;
  }
  freshness_ = Freshness::new_item;
  // Sequences wrap around modulo 2^64; the first item an input sees misses nothing.
  missed_ = cursor_ == 0 ? 0 : header->sequence - cursor_ - 1;
  cursor_ = header->sequence;
  ++read_;
  missed_total_ += missed_;
}

const char* name_of(NullReason reason) noexcept {
  switch (reason) {
    case NullReason::none:
      return "none";
    case NullReason::nothing_yet:
      return "nothing yet";
    case NullReason::too_old:
      return "too old";
    case NullReason::writer_stopped:
      return "writer stopped";
    case NullReason::writer_faulted:
      return "writer in fault";
    case NullReason::writer_retired:
      return "writer retired";
    case NullReason::not_registered:
      return "not registered";
    case NullReason::wrong_type:
      return "wrong type";
    case NullReason::no_longer_kept:
      return "no longer kept";
  }
  return "unknown";
}

}  // namespace flexrf
