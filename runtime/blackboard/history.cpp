#include "runtime/blackboard/history.hpp"

#include <algorithm>

namespace flexrf {

void History::append(const ItemHeader& header, const void* value) noexcept {
  const std::uint64_t position = appended_.load(std::memory_order_relaxed);
  RingEntry::write(entry(position), position, header, value, type_->size);
  appended_.store(position + 1, std::memory_order_release);
}

NullReason History::at(Time time, ItemHeader& header, void* value) const noexcept {
  for (int tries = 0; tries < 2; ++tries) {
    const std::uint64_t appended = appended_.load(std::memory_order_acquire);
    if (appended == 0) return NullReason::nothing_yet;
    const std::uint64_t kept = std::min<std::uint64_t>(appended, capacity_);
    bool overwritten = false;
    for (std::uint64_t back = 1; back <= kept && !overwritten; ++back) {
      const std::uint64_t position = appended - back;
      Time sampled_at{};
      if (!RingEntry::read_time(entry(position), position, sampled_at)) {
        overwritten = true;
      } else if (sampled_at <= time) {
        if (RingEntry::read(entry(position), position, header, value, type_->size)) return NullReason::none;
        overwritten = true;
      }
    }
    if (!overwritten) return appended > capacity_ ? NullReason::no_longer_kept : NullReason::nothing_yet;
  }
  return NullReason::no_longer_kept;
}

std::size_t History::between(Time from, Time to, std::span<ItemHeader> headers, void* values) const noexcept {
  const std::uint64_t appended = appended_.load(std::memory_order_acquire);
  const std::uint64_t kept = std::min<std::uint64_t>(appended, capacity_);
  auto* next = static_cast<std::byte*>(values);
  std::size_t found = 0;
  for (std::uint64_t back = kept; back > 0 && found < headers.size(); --back) {
    const std::uint64_t position = appended - back;
    Time sampled_at{};
    if (!RingEntry::read_time(entry(position), position, sampled_at)) continue;
    if (sampled_at < from || sampled_at > to) continue;
    if (!RingEntry::read(entry(position), position, headers[found], next, type_->size)) continue;
    next += type_->size;
    ++found;
  }
  return found;
}

}  // namespace flexrf
