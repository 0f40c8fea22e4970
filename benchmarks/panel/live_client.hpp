// A client of the panel's WebSocket: bytes as they come, without a browser.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace flexrf::bench {

/// One thread.
class LiveClient {
 public:
  LiveClient() = default;
  LiveClient(LiveClient&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), input_(std::move(other.input_)), id_(other.id_) {}
  LiveClient(const LiveClient&) = delete;
  LiveClient& operator=(const LiveClient&) = delete;
  ~LiveClient() { close(); }

  /// Upgrades in this session; blocks. `receive_buffer`: bytes that the kernel keeps for it; 0: as usual.
  bool connect(int port, const std::string& session, int receive_buffer = 0);
  int socket() const noexcept { return socket_; }
  void close() noexcept;

  /// {"op":OP,"id":N,FIELDS}; its number. `fields`: JSON members, or empty.
  std::uint64_t send(std::string_view op, std::string_view fields = "");
  /// What came meanwhile: calls use(is_binary, payload) for each message. False: the other side has ended.
  template <class Use>
  bool receive(Use&& use) {
    const bool open = read_some();
    std::size_t taken = 0;
    bool binary = false;
    std::string_view payload;
    while (next_message(taken, binary, payload)) use(binary, payload);
    input_.erase(0, taken);
    return open;
  }
  /// Waits for the answer to a request, 5 s at most; empty: there was none.
  std::string answer_to(std::uint64_t id);

 private:
  bool read_some();
  bool next_message(std::size_t& taken, bool& binary, std::string_view& payload) const;

  int socket_ = -1;
  std::string input_;
  std::uint64_t id_ = 0;
};

}  // namespace flexrf::bench
