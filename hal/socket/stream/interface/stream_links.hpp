#pragma once

#include <array>
#include <vector>

#include "hal/driver/byte_ring.hpp"
#include "hal/socket/stream/interface/stream_socket.hpp"
#include "hal/socket/stream/interface/stream_transport.hpp"

namespace flexrf {

struct StreamSettings {
  bool listen = false;
  std::size_t sessions = 1;
  std::size_t buffer = 0;  ///< bytes, of each direction
  Duration connect_timeout{};
  Duration reconnect_shortest{};
  Duration reconnect_longest{};
};

/// The connections of a StreamSocket: who is connected, what waits in either direction, when it is tried
/// again. begin, stop: lifecycle thread; begin allocates. All else: the device's thread.
class StreamLinks {
 public:
  static constexpr std::size_t most_sessions = 8;

  /// `told`: of the device, where all is counted; outlives this.
  explicit StreamLinks(StreamSocketFeedback& told) noexcept : told_(told) {}

  /// `name`: the device's; it and the transport outlive this.
  void begin(const char* name, StreamTransport& transport, const StreamSettings& settings);
  void stop() noexcept;

  void receive(Time now) noexcept;
  void send(Time now) noexcept;

  std::span<const SocketSession> sessions() const noexcept { return {sessions_.data(), session_count_}; }
  bool write(SocketSession session, std::string_view bytes, bool as_line) noexcept;
  std::optional<std::string_view> read_line(SocketSession session) noexcept;
  std::string_view peek(SocketSession session) const noexcept;
  void take(SocketSession session, std::size_t count) noexcept;
  void close(SocketSession session) noexcept;

 private:
  enum class State : std::uint8_t { free, connecting, open, ended };
  struct Place {
    State state = State::free;
    SocketSession session = 0;
    bool closing = false;   // by us, once all is sent
    Time until{};           // closing: no longer is waited; ended: no longer is what came kept
    bool skipping = false;  // the rest of a line that was too long
    std::vector<char> inbox;
    std::size_t begin = 0;  // of what waits in it
    std::size_t end = 0;
    std::vector<char> outbox_memory;
    ByteRing outbox;
  };

  std::size_t index_of(const Place& place) const noexcept {
    return static_cast<std::size_t>(&place - places_.data());
  }
  Place* find(SocketSession session) noexcept;
  const Place* find(SocketSession session) const noexcept;
  void connect(Time now) noexcept;
  void judge(StreamTransport::Attempt attempt, Time now) noexcept;
  void accept(Time now) noexcept;
  void open(Place& place, Time now) noexcept;
  void fetch(Place& place, Time now) noexcept;
  void lose(Place& place, Time now) noexcept;
  void free(Place& place) noexcept;
  void pause(Time now) noexcept;
  void list_sessions() noexcept;
  void note_trouble(const Status& cause) noexcept;

  StreamSocketFeedback& told_;
  const char* name_ = "";
  StreamTransport* transport_ = nullptr;
  StreamSettings settings_;
  std::vector<Place> places_;
  std::array<SocketSession, most_sessions> sessions_{};
  std::size_t session_count_ = 0;
  SocketSession last_session_ = 0;
  Time retry_at_{};
  Time give_up_at_{};
  Time opened_at_{};
  Duration pause_{};
};

}  // namespace flexrf
