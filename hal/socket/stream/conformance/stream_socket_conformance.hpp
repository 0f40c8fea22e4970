// What every driver of StreamSocket must do. A driver's test makes a world, which is the driver and the other
// ends of its connections, and runs the cases in it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hal/driver/device_bench.hpp"
#include "hal/socket/stream/interface/stream_socket.hpp"
#include "types/socket_line.hpp"

namespace flexrf {

struct StreamWishes {
  bool listen = false;
  std::uint8_t sessions = 1;
  std::uint32_t buffer = 4096;
  /// Who does not read for so long is gone, too, and one of the cases does not.
  Duration peer_timeout = std::chrono::seconds(60);
};

class StreamSocketWorld {
 public:
  virtual ~StreamSocketWorld() = default;

  /// Configures and initialises the driver. `sinks`: where its lines go; empty: not connected.
  virtual Status start(const StreamWishes& wishes, std::span<QueueSink* const> sinks = {}) = 0;
  virtual StreamSocket& socket() = 0;
  virtual const StreamSocketFeedback& feedback() = 0;
  /// The thread's cycle, some milliseconds after the last one: receive, then what the unit does, then send.
  virtual void receive() = 0;
  virtual void send() = 0;
  /// By a clock that does not see a machine that stands still: how soon something happens may be judged by
  /// it.
  virtual std::optional<Time> now() const { return std::nullopt; }

  /// Before start(): somebody else listens where it is to. False: cannot be made to happen here.
  virtual bool occupy() = 0;
  /// Where it connects to, also before start(); nobody listens at first.
  virtual void listen(bool on) = 0;
  /// To where it listens. Each connection of either kind is a number, counted from 0.
  virtual void connect() = 0;
  /// Connections that have come about at the far end so far.
  virtual std::size_t connections() = 0;
  virtual bool give(std::size_t number, std::string_view bytes) = 0;
  /// All that has come to the far end of it; not asked for, it is not read there.
  virtual std::string got(std::size_t number) = 0;
  /// The driver has ended it, as the far end sees once it has read all.
  virtual bool is_ended(std::size_t number) = 0;
  virtual void end(std::size_t number) = 0;
  /// It breaks: it is reset, and what is on its way is lost.
  virtual void break_off(std::size_t number) = 0;
  /// The cable between the two, out and in again: nothing arrives, nobody is told. False: cannot be made to
  /// happen here.
  virtual bool unplug() { return false; }
  virtual void plug_in() {}
};

using MakeStreamSocketWorld = std::unique_ptr<StreamSocketWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_stream_socket_conformance(const char* driver, MakeStreamSocketWorld make);

}  // namespace flexrf
