#include "hal/can/socket_can/can_node_runner.hpp"

#include <net/if.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>

#include "hal/can/socket_can/can_socket.hpp"

namespace flexrf {
namespace {

constexpr Duration longest_pause = std::chrono::milliseconds(50);
/// While the kernel's queue is full.
constexpr Duration retry_pause = std::chrono::milliseconds(1);

class SocketPort final : public CanPort {
 public:
  explicit SocketPort(CanSocket& socket) : socket_(&socket) {}
  bool send(const CanFrame& frame) noexcept override {
    return frame.is_valid() && waiting_.put(frame, false);
  }
  bool is_empty() const { return waiting_.is_empty(); }
  bool flush() {
    const CanSocket::Sent sent = socket_->send(waiting_);
    waiting_.drop_first(sent.frames);
    return !sent.is_gone;
  }

 private:
  CanSocket* socket_;
  CanSendQueue waiting_;
};

void wait(int descriptor, Duration pause) {
  const timespec time{0, std::clamp(pause, Duration{}, longest_pause).count()};
  pollfd source{descriptor, POLLIN, 0};
  ppoll(&source, 1, &time, nullptr);
}

}  // namespace

Status run_can_node(const char* interface, CanNode& node, const std::atomic<bool>& ends) {
  const auto socket = std::make_unique<CanSocket>();
  if (Status status = socket->open(); !status) return status;
  if (Status status = socket->listen_to_all(); !status) return status;
  const unsigned index = if_nametoindex(interface);
  if (index == 0)
    return Status::error(StatusCode::not_found, "there is no network interface %s; `ip link` lists them",
                         interface);
  if (Status status = socket->bind(static_cast<int>(index)); !status) return status;
  SocketPort port(*socket);
  node.on_time(MonotonicClock::now(), port);
  while (!ends.load(std::memory_order_acquire)) {
    if (!port.flush())
      return Status::error(StatusCode::unavailable, "the network interface %s is down or gone", interface);
    // Far in the future is Time::max(), from which nothing may be subtracted.
    const Time now = MonotonicClock::now();
    const Time due = std::min(node.next_event(), now + (port.is_empty() ? longest_pause : retry_pause));
    wait(socket->descriptor(), due - now);
    const std::size_t count = socket->receive();
    for (std::size_t i = 0; i < count; ++i) node.on_frame(socket->frame(i), port);
    // Its answers leave before it does anything else: who is told there that its cable is out must not hear
    // one of them afterwards.
    if (!port.flush()) continue;  // the interface is gone, as the loop's beginning says
    const Time after = MonotonicClock::now();
    if (node.next_event() <= after) node.on_time(after, port);
  }
  return {};
}

}  // namespace flexrf
