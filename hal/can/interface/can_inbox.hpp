// CanInbox: what a CAN bus has received for one device.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "hal/can/interface/can_frame.hpp"

namespace flexrf {

/// A member of a device on the bus, which gives it to CanBus::open() and empties it in receive(). Everything:
/// the thread that the device and its bus live in, while the device does; else the lifecycle thread.
class CanInbox {
 public:
  /// The oldest frame not yet taken, in the order in which they were on the bus [can-inbox-1].
  std::optional<CanFrame> pop() noexcept {
    const CanFrame* frame = take();
    return frame == nullptr ? std::nullopt : std::optional{*frame};
  }
  /// The same without a copy, to be used before the bus receives again; null: there is none.
  const CanFrame* take() noexcept { return taken_ == put_ ? nullptr : &frames_[taken_++ & (capacity_ - 1)]; }
  bool is_empty() const noexcept { return taken_ == put_; }
  /// How many were overwritten by newer ones before they were taken, since open() [can-inbox-2].
  std::uint32_t missed() const noexcept { return missed_; }

 private:
  friend class CanBus;
  /// `capacity` is a power of two.
  void reset(std::uint32_t capacity) {
    if (capacity != capacity_) frames_ = std::make_unique<CanFrame[]>(capacity);
    capacity_ = capacity;
    put_ = taken_ = missed_ = 0;
  }
  /// False: the oldest had to make room, because what is newest is true.
  bool push(const CanFrame& frame) noexcept {
    const bool had_room = put_ - taken_ < capacity_;
    if (!had_room) {
      ++taken_;
      ++missed_;
    }
    frames_[put_++ & (capacity_ - 1)] = frame;
    return had_room;
  }

  std::unique_ptr<CanFrame[]> frames_;
  std::uint32_t capacity_ = 0;
  std::uint32_t put_ = 0;    // counts on and wraps around
  std::uint32_t taken_ = 0;  // likewise
  std::uint32_t missed_ = 0;
};

}  // namespace flexrf
