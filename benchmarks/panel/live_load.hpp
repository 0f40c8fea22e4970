// Many clients of the panel's WebSocket at once, in one thread, and what reaches them.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/time.hpp"
#include "benchmarks/panel/live_client.hpp"

namespace flexrf::bench {

struct LiveFigures {
  std::uint64_t frames = 0;
  std::uint64_t items = 0;
  std::uint64_t lost = 0;           ///< frames that the server left out, or that never came
  std::uint64_t missed = 0;         ///< items that were published between two that came
  std::uint64_t closed = 0;         ///< connections that the server ended
  std::vector<double> delivery_us;  ///< from the instant at which values were due to having read them
};

class LiveLoad {
 public:
  struct Settings {
    int port = -1;
    std::string session;
    int clients = 1;
    bool one_never_reads = false;  ///< the last of them; not in the figures
    std::string slots;             ///< of the subscription, JSON
    Duration interval{};           ///< of the values whose delivery is timed; 0: none is
    int cpu = -1;
  };

  /// Returns when all are connected and subscribed; false: they are not.
  bool begin(const Settings& settings);
  ~LiveLoad() { end(); }
  /// Since the last time.
  LiveFigures take();
  void end();

 private:
  struct Client {
    LiveClient link;
    std::uint64_t number = 0;    // of the last frame
    std::uint32_t left_out = 0;  // as it said
    bool reads = true;
    bool open = true;
  };

  void run();
  void ping();
  void read(Client& client);
  void note(Client& client, std::string_view frame);

  Settings settings_;
  std::vector<Client> clients_;
  int epoll_ = -1;
  std::mutex mutex_;
  LiveFigures figures_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace flexrf::bench
