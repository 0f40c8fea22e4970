// A server with handlers that do what its tests need.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "web-ui/server/service.hpp"
#include "web-ui/server/settings.hpp"
#include "web-ui/server/tests/client.hpp"

namespace flexrf::panel {

class Server;

/// Knows the host "panel.test" and its origin. Paths: /hello, /echo (the body), /large (8 MiB), /later
/// (answered at a later tick), /never. Live: a text comes back; "flood" is answered with message after
/// message, for ever; "much" with `much_messages`, each of `much_size` bytes, which tell its number, by turns
/// from the link's buffer and from shared memory; "close" with a close.
class TestHandlers final : public Service, public LiveService {
 public:
  static constexpr std::size_t much_messages = 4;
  static constexpr std::size_t much_size = 8U << 20U;  // several times what a socket takes at once
  static char byte_of(std::size_t message) noexcept { return static_cast<char>('A' + message % 26); }

  LaterReplies* replies = nullptr;
  std::atomic<int> opened{0};
  std::atomic<int> closed{0};
  std::atomic<int> texts{0};
  std::atomic<int> connections_closed{0};
  /// Set before the server runs.
  std::function<void()> ticked;

  bool admit(const Request& request, SessionIndex& session, Reply& reply) override;
  void on_connection_closed(std::uint32_t) override { ++connections_closed; }
  Handled handle(const Request& request, Reply& reply, Ticket ticket) override;
  LiveService& live() noexcept override { return *this; }
  void on_open(LiveLink&) override { ++opened; }
  void on_text(LiveLink& link, std::string_view text) override;
  void on_writable(LiveLink& link) override;
  void on_close(LiveLink& link) override;
  void on_tick(Time now) override;
  Duration until_next(Time) const override { return std::chrono::milliseconds{ticked ? 5 : 50}; }

 private:
  std::vector<Ticket> waiting_ = [] {
    std::vector<Ticket> tickets;
    tickets.reserve(64);
    return tickets;
  }();
  void send_next(LiveLink& link);

  static constexpr std::size_t no_end = SIZE_MAX;
  std::array<std::size_t, 256> left_{};  // messages, per place
  std::string shared_;
};

/// The state of a test: where an assertion jumps to, this is taken down. Shows nothing of Asio, whose names
/// and CMocka's macros do not go together.
struct Served {
  /// `ticked`: called at each tick, which come each 5 ms then; empty: they come each 50 ms. Files of TLS
  /// empty: plain.
  explicit Served(const ServerSettings& settings, std::function<void()> ticked = {},
                  const std::string& certificate_file = {}, const std::string& key_file = {});
  ~Served();

  std::uint16_t port() const;
  /// Begins to end; the destructor waits for it.
  void stop();

  TestHandlers handlers;
  std::unique_ptr<Server> server;
  std::thread thread;
  std::array<Client, 40> clients;
  std::string text;
};

/// What make_encryption() finds wrong; empty: nothing.
std::string fault_of_encryption(const std::string& certificate_file, const std::string& key_file);

}  // namespace flexrf::panel
