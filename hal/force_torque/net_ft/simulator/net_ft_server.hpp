// NetFtServer: a simulated ATI sensor at a UDP port of the loopback address.
#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <mutex>

#include "base/status.hpp"
#include "hal/driver/helper_thread.hpp"
#include "hal/force_torque/net_ft/simulator/net_ft_model.hpp"

namespace flexrf {

/// Has a thread of its own. Any thread, but for plug() and unplug(): one.
class NetFtServer {
 public:
  explicit NetFtServer(double rate = 500) : model_(rate) {}
  NetFtServer(const NetFtServer&) = delete;
  NetFtServer& operator=(const NetFtServer&) = delete;
  ~NetFtServer() { unplug(); }

  /// `port` 0: a free one at first, afterwards the same again.
  Status plug(std::uint16_t port = 0);
  /// Nobody is at its port.
  void unplug();
  std::uint16_t port() const noexcept { return port_; }

  template <class Act>
  void with_model(const Act& act) {
    const std::lock_guard lock(mutex_);
    act(model_);
  }

 private:
  void run();
  void receive();
  /// How long until there is something to send, at most longest_pause.
  Duration send();

  std::mutex mutex_;
  NetFtModel model_;
  std::uint16_t port_ = 0;
  int socket_ = -1;
  int other_ = -1;  // a socket with another port
  sockaddr_in client_{};
  HelperThread thread_;
};

}  // namespace flexrf
