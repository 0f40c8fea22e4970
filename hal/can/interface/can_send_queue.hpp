// CanSendQueue: the frames that wait for the end of the cycle, in the order of their priority.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/can/interface/can_frame.hpp"

namespace flexrf {

/// The lowest arbitration key first, and those of one key in the order in which they came [can-send-queue-1].
/// Never allocates.
class CanSendQueue {
 public:
  static constexpr std::size_t capacity = 128;

  /// False: full. Frames are nearly always put in their order.
  bool put(const CanFrame& frame, bool replaces) noexcept {
    const std::uint32_t key = arbitration_key(frame);
    if (end_ < capacity && (is_empty() || waiting_[end_ - 1].key < key)) {
      write(end_++, frame, key, replaces);
      return true;
    }
    // What several say is mostly what comes first of all: SYNC.
    if (replaces && !is_empty() && waiting_[first_].key == key && waiting_[first_].may_be_replaced) {
      waiting_[first_].frame = frame;
      return true;
    }
    return put_between(frame, key, replaces);
  }

  bool is_empty() const noexcept { return first_ == end_; }
  std::size_t size() const noexcept { return end_ - first_; }
  const CanFrame& operator[](std::size_t index) const noexcept { return waiting_[first_ + index].frame; }
  /// The arbitration key of the first; not when empty.
  std::uint32_t first_key() const noexcept { return waiting_[first_].key; }

  /// The first `count` are gone.
  void drop_first(std::size_t count) noexcept {
    first_ += count;
    if (first_ == end_) clear();
  }
  /// The first with this key.
  void drop_one_of(std::uint32_t key) noexcept {
    std::size_t place = first_;
    while (place < end_ && waiting_[place].key != key) ++place;
    if (place == end_) return;
    // What is dropped is nearly always what comes first.
    for (; place > first_; --place) waiting_[place] = waiting_[place - 1];
    drop_first(1);
  }
  void clear() noexcept { first_ = end_ = 0; }

 private:
  struct Waiting {
    CanFrame frame;
    std::uint32_t key = 0;
    bool may_be_replaced = false;
  };

  bool put_between(const CanFrame& frame, std::uint32_t key, bool replaces) noexcept {
    std::size_t place = end_;
    for (; place > first_ && waiting_[place - 1].key >= key; --place) {
      Waiting& other = waiting_[place - 1];
      if (other.key != key) continue;
      if (!replaces) break;
      if (!other.may_be_replaced) continue;
      other.frame = frame;
      return true;
    }
    // What only looked for a frame to replace went past those of its own key.
    while (place < end_ && waiting_[place].key <= key) ++place;
    if (size() == capacity) return false;
    if (end_ == capacity) place -= make_room();
    for (std::size_t i = end_; i > place; --i) waiting_[i] = waiting_[i - 1];
    write(place, frame, key, replaces);
    ++end_;
    return true;
  }
  // Member by member: a copy of the whole would wait for what was just written in pieces.
  void write(std::size_t place, const CanFrame& frame, std::uint32_t key, bool replaces) noexcept {
    Waiting& waiting = waiting_[place];
    waiting.frame = frame;
    waiting.key = key;
    waiting.may_be_replaced = replaces;
  }

  /// Those that wait move to the beginning; by how much.
  std::size_t make_room() noexcept {
    const std::size_t moved = first_;
    for (std::size_t i = first_; i < end_; ++i) waiting_[i - moved] = waiting_[i];
    first_ = 0;
    end_ -= moved;
    return moved;
  }

  std::size_t first_ = 0;
  std::size_t end_ = 0;
  std::array<Waiting, capacity> waiting_{};
};

}  // namespace flexrf
