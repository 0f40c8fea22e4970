#pragma once

#include <array>
#include <string>
#include <vector>

#include "hal/socket/stream/interface/stream_links.hpp"

namespace flexrf {

/// The other ends are the test: they connect, listen, send, read and go as they are called, between cycles,
/// from the thread that the socket lives in. Each connection has a number, counted from 0.
class MockStreamTransport final : public StreamTransport {
 public:
  /// Bytes that wait on their way, in each direction.
  static constexpr std::size_t pipe_capacity = 65536;

  MockStreamTransport() { ends_.reserve(64); }

  // The far ends.
  void set_listening(bool on) noexcept { listening_ = on; }
  std::size_t connections() const noexcept { return ends_.size(); }
  /// To what listens; the connection's number.
  std::size_t connect_to_it();
  /// False: the connection is gone, or too much is on its way.
  bool give(std::size_t number, std::string_view bytes);
  /// What has come to it, all of it.
  std::string_view got(std::size_t number) const { return ends_[number].got; }
  void set_reads(std::size_t number, bool on) { ends_[number].reads = on; }
  bool is_open(std::size_t number) const { return ends_[number].state != State::closed; }
  /// It ends; what it gave before still comes.
  void end(std::size_t number) { ends_[number].ended = true; }
  /// It breaks: what is on its way is lost.
  void break_off(std::size_t number, const Status& cause);
  /// Before open(): somebody else listens there.
  void refuse(const Status& cause) { refusal_ = cause; }

  Status open(std::string_view address, bool listen, Duration peer_timeout);
  void shut() noexcept {}
  std::uint16_t port() const noexcept { return 0; }

  Attempt connect() noexcept override { return attempt(); }
  Attempt attempt() noexcept override;
  bool accept(std::size_t place) noexcept override;
  bool turn_away() noexcept override;
  long receive(std::size_t place, std::span<char> bytes) noexcept override;
  long send(std::size_t place, std::string_view bytes) noexcept override;
  void close(std::size_t place) noexcept override;
  const Status& error() const noexcept override { return error_; }

 private:
  enum class State : std::uint8_t { waiting, open, closed };
  struct End {
    State state = State::waiting;
    bool ended = false;
    bool reads = true;
    Status broken;
    std::string given;
    std::size_t taken = 0;  // of it
    std::string got;
  };
  static constexpr std::size_t nobody = ~std::size_t{0};

  std::size_t add(State state);
  std::size_t waiting() const noexcept;

  std::vector<End> ends_;
  std::array<std::size_t, StreamLinks::most_sessions> places_{};  // which end has each
  bool listening_ = false;
  Status refusal_;
  Status error_;
};

}  // namespace flexrf
