// The hot half of SlotControl: small enough to be worth inlining into every port.
#pragma once

#include "runtime/blackboard/slot.hpp"

namespace flexrf {

inline bool SlotControl::is_free(std::uint8_t buffer) const noexcept {
  // Acquire: what its readers did with the buffer is over before the writer's first byte.
  return buffer != current_ && (loaned_ >> buffer & 1U) == 0 &&
         memory_.taken[buffer] == memory_.given[buffer].load(std::memory_order_acquire);
}

inline std::uint8_t SlotControl::loan() noexcept {
  if (pending_ != none) [[unlikely]] {
    commit();
  }
  if (loans_out_ == memory_.loans) return none;
  std::uint8_t buffer = back_;
  if (!memory_.triple) {
    for (std::uint8_t tried = 1; !is_free(buffer); ++tried) {
      if (tried == memory_.buffers) return none;
      buffer = buffer + 1 == memory_.buffers ? std::uint8_t{0} : static_cast<std::uint8_t>(buffer + 1);
    }
    loaned_ |= std::uint64_t{1} << buffer;
  }
  ++loans_out_;
  if (poisons_loans) [[unlikely]] {
    poison(buffer);
  }
  return buffer;
}

inline std::uint8_t SlotControl::loan_last() noexcept {
  const std::uint8_t buffer = loan();
  if (buffer == none) return none;
  if (last_ == none) {
    std::memset(payload(buffer), 0, type_->size);
    lay_out(buffer);
  } else {
    std::memcpy(payload(buffer), payload(last_), type_->size);
  }
  return buffer;
}

inline void SlotControl::abandon(std::uint8_t buffer) noexcept {
  loaned_ &= ~(std::uint64_t{1} << buffer);
  --loans_out_;
}

inline void SlotControl::publish(std::uint8_t buffer, Time sampled_at) noexcept {
  ItemHeader& item = header_for_writing(buffer);
  sequence_ = next_sequence(sequence_);
  item.sequence = sequence_;
  item.sampled_at = sampled_at;
  loaned_ &= ~(std::uint64_t{1} << buffer);
  --loans_out_;
  if (digested_) [[unlikely]] {
    digest_ = digest_of_item(digest_, *type_, item, payload(buffer));
  }
  if (deferred_) [[unlikely]] {
    commit();
    pending_ = buffer;
    loaned_ |= std::uint64_t{1} << buffer;
    return;
  }
  make_visible(buffer);
}

inline void SlotControl::commit() noexcept {
  if (pending_ == none) return;
  const std::uint8_t buffer = pending_;
  pending_ = none;
  loaned_ &= ~(std::uint64_t{1} << buffer);
  make_visible(buffer);
}

inline bool SlotControl::has_newer(std::uint8_t held) const noexcept {
  const std::uint64_t word = word_.load(std::memory_order_relaxed);
  if (memory_.triple) return (word & fresh_bit) != 0;
  return (word & published_bit) != 0 && index_of(word) != held;
}

inline bool SlotControl::take(std::uint8_t& held, std::uint16_t& seen) noexcept {
  std::uint64_t word = word_.load(std::memory_order_relaxed);
  if (memory_.triple) {
    if ((word & fresh_bit) == 0) return false;
    // Before the first take the reader owns buffer 2: the word began with 0 and the writer with 1.
    const std::uint64_t left = word_of(held == none ? std::uint8_t{2} : held);
    word = word_.exchange(left, std::memory_order_acq_rel);
    held = index_of(word);
    seen = static_cast<std::uint16_t>(left);
    return true;
  }
  // A held buffer is never published again before it is given back, so the same index is the same item.
  if ((word & published_bit) == 0 || index_of(word) == held) return false;
  if (held != none) give(held);
  word = word_.fetch_add(one_taken, std::memory_order_acquire);
  held = index_of(word);
  seen = static_cast<std::uint16_t>(word & (one_taken - 1));
  return true;
}

inline void SlotControl::give(std::uint8_t& held) noexcept {
  if (memory_.triple) return;
  memory_.given[held].fetch_add(1, std::memory_order_release);
  held = none;
}

}  // namespace flexrf
