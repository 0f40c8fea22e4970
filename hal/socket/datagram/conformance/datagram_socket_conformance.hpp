// What every driver of DatagramSocket must do. A driver's test makes a world, which is the driver, its peer
// and somebody else, and runs the cases in it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/driver/device_bench.hpp"
#include "hal/socket/datagram/interface/datagram_socket.hpp"

namespace flexrf {

struct DatagramWishes {
  bool has_remote = true;
  bool only_remote = true;
  std::uint32_t size = 64;
  std::uint32_t waiting = 4;
};

/// Who is at the far end.
enum class FarEnd : std::uint8_t { peer, stranger };

class DatagramSocketWorld {
 public:
  virtual ~DatagramSocketWorld() = default;

  /// Configures and initialises the driver.
  virtual Status start(const DatagramWishes& wishes) = 0;
  virtual DatagramSocket& socket() = 0;
  virtual const DatagramSocketFeedback& feedback() = 0;
  /// The thread's cycle, some milliseconds after the last one: receive, then what the unit does, then send.
  virtual void receive() = 0;
  virtual void send() = 0;
  /// By a clock that does not see a machine that stands still: how soon something happens may be judged by
  /// it.
  virtual std::optional<Time> now() const { return std::nullopt; }

  virtual void give(FarEnd end, std::string_view bytes) = 0;
  /// All datagrams that have come to it so far.
  virtual std::vector<std::string> got(FarEnd end) = 0;
  /// Before start(): somebody else has the driver's address. False: cannot be made to happen here.
  virtual bool occupy() = 0;
  /// The peer goes away, or its cable, and comes back where it was.
  virtual void leave() = 0;
  virtual void come_back() = 0;
};

using MakeDatagramSocketWorld = std::unique_ptr<DatagramSocketWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_datagram_socket_conformance(const char* driver, MakeDatagramSocketWorld make);

}  // namespace flexrf
