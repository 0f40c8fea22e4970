// CanLinkWatch: knows whether a network interface is there and up, and binds a CAN socket to it when it
// comes.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "base/status.hpp"
#include "hal/can/socket_can/can_socket.hpp"
#include "hal/driver/helper_thread.hpp"

namespace flexrf {

/// Asking and binding may wait for the kernel's lock on all interfaces, so a thread of its own does it, not
/// real-time, whenever the kernel tells of a change (rtnetlink), and now and then in case that was lost.
class CanLinkWatch {
 public:
  enum class Link : std::uint8_t {
    gone,
    not_can,  ///< an interface of another kind
    down,
    no_carrier,  ///< up, but its controller is off the bus
    up,
  };
  struct View {
    Link link = Link::gone;
    std::uint64_t look = 0;  ///< number of the look that saw this
  };

  ~CanLinkWatch() { stop(); }

  /// Looks once, then begins to watch. `socket` is open and stays so until stop(). Lifecycle thread.
  Status start(const char* interface, CanSocket& socket);
  void stop() noexcept;

  /// What the interface of this name is now, and its index if it is there. `socket`: any; this may wait for
  /// the kernel's lock.
  static Link ask(int socket, const char* interface, int& index) noexcept;
  /// For an operator, what is to be done about it; ok where nothing is.
  static Status advice(Link link, const char* interface) noexcept;

  /// Any thread; no system call.
  View view() const noexcept {
    const std::uint64_t packed = view_.load(std::memory_order_acquire);
    return {static_cast<Link>(packed & 0xFFU), packed >> 8U};
  }

 private:
  void run();
  void look() noexcept;

  std::string interface_;
  CanSocket* socket_ = nullptr;
  HelperThread thread_;
  int events_ = -1;  // rtnetlink
  int bound_ = 0;    // the interface's index; 0: to none
  std::uint64_t looks_ = 0;
  std::atomic<std::uint64_t> view_{0};
};

}  // namespace flexrf
