// CanSendQueue: the frames that wait for the end of the cycle, in the order of their priority.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/interfaces/can_bus/can_frame.hpp"

namespace flexrf {

/// The lowest arbitration key first, and those of one key in the order in which they came. Never allocates.
class CanSendQueue {
 public:
  static constexpr std::size_t capacity = 128;

  /// False: full. Frames are nearly always put in their order, so that this is short.
  bool put(const CanFrame& frame, bool replaces) noexcept {
    const std::uint32_t key = arbitration_key(frame);
    std::size_t place = size_;
    for (; place > 0 && waiting_[place - 1].key >= key; --place) {
      Waiting& other = waiting_[place - 1];
      if (other.key != key) continue;
      if (!replaces) break;
      if (!other.may_be_replaced) continue;
      other.frame = frame;
      return true;
    }
    // What only looked for a frame to replace went past those of its own key.
    while (place < size_ && waiting_[place].key <= key) ++place;
    if (size_ == capacity) return false;
    for (std::size_t i = size_; i > place; --i) waiting_[i] = waiting_[i - 1];
    waiting_[place] = {frame, key, replaces};
    ++size_;
    return true;
  }

  bool is_empty() const noexcept { return size_ == 0; }
  std::size_t size() const noexcept { return size_; }
  const CanFrame& operator[](std::size_t index) const noexcept { return waiting_[index].frame; }

  /// The first `count` are gone.
  void drop_first(std::size_t count) noexcept {
    for (std::size_t i = count; i < size_; ++i) waiting_[i - count] = waiting_[i];
    size_ -= count;
  }
  /// The first with this key.
  void drop_one_of(std::uint32_t key) noexcept {
    std::size_t place = 0;
    while (place < size_ && waiting_[place].key != key) ++place;
    if (place == size_) return;
    for (std::size_t i = place + 1; i < size_; ++i) waiting_[i - 1] = waiting_[i];
    --size_;
  }
  void clear() noexcept { size_ = 0; }

 private:
  struct Waiting {
    CanFrame frame;
    std::uint32_t key = 0;
    bool may_be_replaced = false;
  };
  std::array<Waiting, capacity> waiting_{};
  std::size_t size_ = 0;
};

}  // namespace flexrf
