#include "runtime/blackboard/slot.hpp"

#include "runtime/blackboard/history.hpp"

namespace flexrf {

void SlotControl::lay_out_items() noexcept {
  for (std::uint8_t buffer = 0; buffer < memory_.buffers; ++buffer) lay_out(buffer);
}

void SlotControl::lay_out(std::uint8_t buffer) noexcept {
  if (type_->elements_offset == 0) return;
  const std::uint32_t elements = type_->fields.back().count;
  std::memcpy(payload(buffer) + type_->elements_offset, &elements, sizeof(elements));
}

void SlotControl::make_visible(std::uint8_t buffer) noexcept {
  if (history_ != nullptr) history_->append(header(buffer), payload(buffer));
  if (memory_.triple) {
    const std::uint64_t old = word_.exchange(word_of(buffer) | fresh_bit, std::memory_order_acq_rel);
    back_ = index_of(old);
  } else {
    const std::uint64_t old = word_.exchange(word_of(buffer), std::memory_order_acq_rel);
    // Only now is it final how often the former buffer was taken.
    memory_.taken[current_] += static_cast<std::uint32_t>(old >> taken_shift);
    back_ = current_;
  }
  current_ = buffer;
  last_ = buffer;
  published_at_.store(nanoseconds(header(buffer).sampled_at), std::memory_order_relaxed);
  published_.store(header(buffer).sequence, std::memory_order_release);
  for (Doorbell* bell : bells_) bell->ring();
}

}  // namespace flexrf
