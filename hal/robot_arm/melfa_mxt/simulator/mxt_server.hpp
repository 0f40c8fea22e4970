// A simulated MELFA controller at a UDP port of this machine.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "base/status.hpp"
#include "hal/driver/helper_thread.hpp"
#include "hal/robot_arm/melfa_mxt/simulator/mxt_wire.hpp"

namespace flexrf::melfa {

/// Has a thread of its own. Any thread.
class MxtServer {
 public:
  /// `address`: numeric, of this machine; `port` 0: a free one, which port() tells. `paced`: as of MxtWire.
  static Result<std::unique_ptr<MxtServer>> open(const ControllerPlan& plan, bool paced, const char* address,
                                                 std::uint16_t port);
  ~MxtServer();

  std::uint16_t port() const { return port_; }
  /// Datagrams so far that it received, and answered if it answers them.
  std::uint64_t received() const { return received_.load(); }
  /// Datagrams so far that it sent.
  std::uint64_t sent() const { return sent_.load(); }
  /// Does something with the far end while nothing arrives there.
  template <class Act>
  auto with(Act act) {
    const std::lock_guard lock(mutex_);
    return act(wire_);
  }

 private:
  MxtServer(const ControllerPlan& plan, bool paced) : wire_(plan, paced) {}
  void run();
  void receive();
  void send_due();
  Duration until_due();

  std::mutex mutex_;  // of the wire
  MxtWire wire_;
  int socket_ = -1;
  int stranger_ = -1;  // another socket, for what is not the controller's
  std::uint16_t port_ = 0;
  std::uint32_t peer_address_ = 0;  // of who asked last, network byte order
  std::uint16_t peer_port_ = 0;     // likewise
  std::atomic<std::uint64_t> received_{0};
  std::atomic<std::uint64_t> sent_{0};
  HelperThread thread_;
};

}  // namespace flexrf::melfa
