// What the kernel takes for the same bytes to as many clients: a loop of send(2), and nothing around it.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "base/time.hpp"

namespace flexrf::bench {

/// Connections over loopback, a thread that writes to all of them at each instant, and one that reads.
class BareSends {
 public:
  struct Settings {
    int clients = 1;
    std::size_t size = 1;  ///< bytes to each of them at each instant
    Duration interval{};
    int sending_cpu = -1;
    int reading_cpu = -1;
  };

  /// False: this machine gives no connections.
  bool begin(const Settings& settings);
  ~BareSends() { end(); }
  /// CPU time of the thread that writes, so far.
  Duration cpu_time() const;
  void end();

 private:
  bool connect(int listener);
  void send();
  void read();

  Settings settings_;
  std::vector<int> servers_;
  std::vector<int> clients_;
  std::atomic<bool> ends_{false};
  std::thread sender_;
  std::thread reader_;
};

}  // namespace flexrf::bench
