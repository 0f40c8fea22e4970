// In the guest: the loopback network, as a cable that can be pulled out and plugged in again.
#pragma once

#include <cstdlib>

namespace flexrf {

/// Whoever sends meanwhile is told that the network is unreachable. One thread.
class LoopbackCable {
 public:
  LoopbackCable() = default;
  /// Plugs it in.
  ~LoopbackCable() { plug_in(); }
  LoopbackCable(const LoopbackCable&) = delete;
  LoopbackCable& operator=(const LoopbackCable&) = delete;

  bool unplug() {
    if (plugged_) plugged_ = std::system("ip link set dev lo down") != 0;
    return !plugged_;
  }
  bool plug_in() {
    if (!plugged_) plugged_ = std::system("ip link set dev lo up") == 0;
    return plugged_;
  }

 private:
  bool plugged_ = true;
};

}  // namespace flexrf
