#include "hal/can/socket_can/can_socket.hpp"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

namespace flexrf {
namespace {

constexpr int receive_buffer = 1 << 20;  // bytes; the kernel gives what its limit allows

std::int64_t nanoseconds_of(const timespec& time) noexcept {
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

Status failure(const char* what) noexcept {
  return Status::error(StatusCode::unavailable, "%s: %s", what, std::strerror(errno));
}

template <class Value>
bool set(int socket, int level, int option, const Value& value) noexcept {
  return setsockopt(socket, level, option, &value, sizeof(value)) == 0;
}

}  // namespace

Status CanSocket::open() {
  close();
  dropped_ = 0;
  socket_ = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (socket_ < 0) {
    if (errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT)
      return Status::error(StatusCode::unavailable,
                           "this kernel has no CAN sockets; load them with `modprobe can_raw`");
    return failure("no CAN socket can be made");
  }
  // Without the larger buffer it works too, only with less time to fetch what came.
  static_cast<void>(set(socket_, SOL_SOCKET, SO_RCVBUF, receive_buffer));
  constexpr int on = 1;
  if (!set(socket_, SOL_SOCKET, SO_TIMESTAMPNS, on) || !set(socket_, SOL_SOCKET, SO_RXQ_OVFL, on))
    return failure("the CAN socket gives no receive times");
  for (std::size_t i = 0; i < most_received; ++i) {
    vectors_[i] = {&frames_[i], sizeof(can_frame)};
    messages_[i].msg_hdr = {};
    messages_[i].msg_hdr.msg_iov = &vectors_[i];
    messages_[i].msg_hdr.msg_iovlen = 1;
  }
  for (std::size_t i = 0; i < CanSendQueue::capacity; ++i) {
    out_vectors_[i] = {&out_frames_[i], sizeof(can_frame)};
    out_messages_[i].msg_hdr = {};
    out_messages_[i].msg_hdr.msg_iov = &out_vectors_[i];
    out_messages_[i].msg_hdr.msg_iovlen = 1;
  }
  return listen_to({});
}

void CanSocket::close() noexcept {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

Status CanSocket::bind(int interface) noexcept {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = interface;
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    return failure("the CAN socket cannot be bound");
  // The kernel forgot the filters with the interface that the socket was on before, if that is gone.
  const std::lock_guard guard(wanted_guard_);
  return set_filters();
}

Status CanSocket::listen_to(std::span<const CanIdentifier> identifiers) {
  const std::lock_guard guard(wanted_guard_);
  wanted_.clear();
  for (const CanIdentifier& identifier : identifiers) {
    wanted_.push_back(identifier.extended
                          ? can_filter{identifier.value | CAN_EFF_FLAG, CAN_EFF_MASK | CAN_EFF_FLAG}
                          : can_filter{identifier.value, CAN_SFF_MASK | CAN_EFF_FLAG});
  }
  wanted_errors_ = CAN_ERR_MASK;
  return set_filters();
}

Status CanSocket::listen_to_all() {
  const std::lock_guard guard(wanted_guard_);
  wanted_.assign(1, can_filter{0, 0});
  wanted_errors_ = 0;
  return set_filters();
}

Status CanSocket::set_filters() const noexcept {
  if (setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, wanted_.data(),
                 static_cast<socklen_t>(wanted_.size() * sizeof(can_filter))) != 0 ||
      !set(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, wanted_errors_))
    return failure("the CAN socket takes no filter for its identifiers");
  return {};
}

std::size_t CanSocket::receive() noexcept {
  for (std::size_t i = 0; i < most_received; ++i) {
    messages_[i].msg_hdr.msg_control = control_[i].bytes.data();
    messages_[i].msg_hdr.msg_controllen = control_bytes;
  }
  const int count = recvmmsg(socket_, messages_.data(), most_received, MSG_DONTWAIT, nullptr);
  if (count <= 0) return 0;
  // Kernel times are on the wall's clock. Both clocks are read without a system call; a clock that is set
  // between a frame's arrival and now makes its time wrong by so much, once, and never later than now.
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  received_at_ = MonotonicClock::now();
  to_monotonic_ = nanoseconds(received_at_) - nanoseconds_of(wall);
  return static_cast<std::size_t>(count);
}

CanFrame CanSocket::frame(std::size_t index) noexcept {
  const can_frame& in = frames_[index];
  CanFrame frame;
  frame.time = received_at_;
  frame.extended = (in.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (in.can_id & CAN_RTR_FLAG) != 0;
  frame.identifier = in.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.length = std::min<std::uint8_t>(in.can_dlc, CanFrame::most_bytes);
  std::copy_n(in.data, CanFrame::most_bytes, frame.data.begin());
  msghdr& header = messages_[index].msg_hdr;
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SCM_TIMESTAMPNS) {
      timespec wall{};
      std::memcpy(&wall, CMSG_DATA(part), sizeof(wall));
      frame.time = std::min(received_at_, Time{Duration{nanoseconds_of(wall) + to_monotonic_}});
    } else if (part->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&dropped_, CMSG_DATA(part), sizeof(dropped_));
    }
  }
  return frame;
}

can_frame CanSocket::as_kernel_takes(const CanFrame& frame) noexcept {
  can_frame out{};
  out.can_id = frame.identifier | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
  out.can_dlc = frame.length;
  std::copy(frame.data.begin(), frame.data.end(), out.data);
  return out;
}

CanSocket::Sent CanSocket::send(const CanSendQueue& frames) noexcept {
  for (std::size_t i = 0; i < frames.size(); ++i) out_frames_[i] = as_kernel_takes(frames[i]);
  return hand_over(frames.size());
}

CanSocket::Sent CanSocket::send(const CanFrame& frame) noexcept {
  out_frames_[0] = as_kernel_takes(frame);
  return hand_over(1);
}

CanSocket::Sent CanSocket::hand_over(std::size_t count) noexcept {
  if (count == 0) return {};
  const int sent = sendmmsg(socket_, out_messages_.data(), static_cast<unsigned>(count), MSG_DONTWAIT);
  // When only some went, the reason is told by the next call, in the next cycle.
  if (sent > 0) return {.frames = static_cast<std::size_t>(sent), .is_full = sent < static_cast<int>(count)};
  const bool full = errno == ENOBUFS || errno == EAGAIN || errno == EINTR;
  return {.is_full = full, .is_gone = !full};
}

}  // namespace flexrf
