// CanSocket: a raw SocketCAN socket that takes and gives frames by the batch.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "base/status.hpp"
#include "hal/can/interface/can_frame.hpp"
#include "hal/can/interface/can_send_queue.hpp"

namespace flexrf {

class CanSocket {
 public:
  /// What one system call takes at most.
  static constexpr std::size_t most_received = 128;

  /// What became of a batch.
  struct Sent {
    std::size_t frames = 0;  ///< so many of the first were handed over
    bool is_full = false;    ///< the kernel's queue had no room for the rest
    bool is_gone = false;    ///< the interface is down or gone: nothing can be sent
  };

  CanSocket() = default;
  CanSocket(const CanSocket&) = delete;
  CanSocket& operator=(const CanSocket&) = delete;
  ~CanSocket() { close(); }

  /// Not yet on an interface. Error: this kernel has no CAN. Lifecycle thread.
  Status open();
  void close() noexcept;
  int descriptor() const noexcept { return socket_; }

  /// From now on on this interface (its index), with frames of these identifiers and all error frames. Any
  /// thread that is not real-time, beside receive() and send().
  Status bind(int interface) noexcept;
  Status listen_to(std::span<const CanIdentifier> identifiers);
  /// Hears everything, and no error frames.
  Status listen_to_all();

  /// Everything that has come, at most most_received: one system call. The number of frames; 0: none.
  std::size_t receive() noexcept;
  bool is_error(std::size_t index) const noexcept { return (frames_[index].can_id & CAN_ERR_FLAG) != 0; }
  /// Of the frames received last: an error frame as it is, another one with its time on CLOCK_MONOTONIC.
  const can_frame& error_frame(std::size_t index) const noexcept { return frames_[index]; }
  CanFrame frame(std::size_t index) noexcept;
  /// Frames that the kernel dropped because nobody fetched them, since open().
  std::uint32_t dropped() const noexcept { return dropped_; }

  static can_frame as_kernel_takes(const CanFrame& frame) noexcept;

  /// In their order, as many as there is room for: one system call.
  Sent send(const CanSendQueue& frames) noexcept;
  Sent send(const CanFrame& frame) noexcept;

 private:
  static constexpr std::size_t control_bytes =
      CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));

  Status set_filters() const noexcept;
  Sent hand_over(std::size_t count) noexcept;

  int socket_ = -1;
  std::mutex wanted_guard_;  // between who listens to more and who binds anew
  std::vector<can_filter> wanted_;
  can_err_mask_t wanted_errors_ = 0;
  std::uint32_t dropped_ = 0;
  std::int64_t to_monotonic_ = 0;  // ns, from the clock on the wall, as of the last receive()
  Time received_at_{};

  std::array<can_frame, most_received> frames_{};
  std::array<iovec, most_received> vectors_{};
  std::array<mmsghdr, most_received> messages_{};
  struct alignas(cmsghdr) Control {
    std::array<std::uint8_t, control_bytes> bytes;
  };
  std::array<Control, most_received> control_{};

  std::array<can_frame, CanSendQueue::capacity> out_frames_{};
  std::array<iovec, CanSendQueue::capacity> out_vectors_{};
  std::array<mmsghdr, CanSendQueue::capacity> out_messages_{};
};

}  // namespace flexrf
