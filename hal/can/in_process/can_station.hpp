// CanStation: a node's controller on a simulated wire.
#pragma once

#include <algorithm>

#include "hal/can/interface/can_bus.hpp"
#include "hal/can/interface/can_node.hpp"
#include "hal/can/interface/can_send_queue.hpp"

namespace flexrf {

/// Fault confinement as in ISO 11898-1: a transmit error counts 8, a receive error 1, a frame that went well
/// takes 1 back; above 127 the controller is passive, above 255 transmit errors it is off the bus. The wire's
/// thread.
class CanStation final : public CanPort {
 public:
  bool send(const CanFrame& frame) noexcept override {
    if (off_ || !frame.is_valid() || !waiting_.put(frame, false)) return false;
    *senders_ |= bit_;
    // Alone on its piece of cable it repeats itself, is never acknowledged, and becomes passive within
    // milliseconds; that spares the wire the repetitions.
    if (!connected_) transmit_errors_ = std::max(transmit_errors_, passive_above + 1);
    return true;
  }

  /// bus_off, error_passive or error_active.
  CanBusState state() const noexcept {
    if (off_) return CanBusState::bus_off;
    const bool passive = transmit_errors_ > passive_above || receive_errors_ > passive_above;
    return passive ? CanBusState::error_passive : CanBusState::error_active;
  }
  /// Frames not yet on the wire, the one that is being sent included.
  std::size_t waiting() const noexcept { return waiting_.size(); }
  unsigned transmit_errors() const noexcept { return transmit_errors_; }
  unsigned receive_errors() const noexcept { return receive_errors_; }
  /// Transmissions that failed.
  std::uint64_t failed() const noexcept { return failed_; }
  std::uint64_t sent() const noexcept { return sent_; }
  std::uint64_t arbitrations_lost() const noexcept { return arbitrations_lost_; }

  // ---- faults

  /// This node's plug: out, nobody hears it and it hears nobody; what it sends is never acknowledged.
  void set_connected(bool on) noexcept { connected_ = on; }
  /// What waits to be sent never will be.
  void give_up() noexcept { waiting_.clear(); }
  /// The next `transmissions` of this node are hit on the wire and fail, repetitions included.
  void corrupt_next(unsigned transmissions) noexcept { corrupted_ = transmissions; }

 private:
  friend class CanWire;

  static constexpr unsigned passive_above = 127;

  void reset() noexcept;
  /// As the wire knows it; `senders` has this bit while frames may wait here.
  void set_place(std::uint32_t bit, std::uint32_t& senders) noexcept {
    bit_ = bit;
    senders_ = &senders;
  }
  bool takes_part() const noexcept { return connected_ && !off_; }
  void count_transmit_error(bool unacknowledged) noexcept;
  void count_receive_error() noexcept;
  // What happens with every frame is seen by the compiler where it is called.
  void count_success_as_sender() noexcept {
    ++sent_;
    if (transmit_errors_ > 0) --transmit_errors_;
  }
  void count_success_as_receiver() noexcept {
    if (receive_errors_ > 0) receive_errors_ = std::min(receive_errors_ - 1, passive_above);
  }

  CanNode* node_ = nullptr;
  std::uint32_t* senders_ = nullptr;
  std::uint32_t bit_ = 0;
  Time node_event_{};  // as the node said last
  unsigned transmit_errors_ = 0;
  unsigned receive_errors_ = 0;
  std::uint64_t failed_ = 0;
  std::uint64_t sent_ = 0;
  std::uint64_t arbitrations_lost_ = 0;
  unsigned corrupted_ = 0;
  bool connected_ = true;
  bool off_ = false;
  Time restart_at_ = Time::max();  // when off
  Time silent_until_{};            // after a transmission, when passive
  CanSendQueue waiting_;           // last: it is large, and the rest is looked at for each frame
};

}  // namespace flexrf
