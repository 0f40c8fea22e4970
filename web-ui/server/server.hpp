// The panel's server: one thread, one port, a fixed number of connections.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "base/status.hpp"
#include "runtime/blackboard/doorbell.hpp"
#include "runtime/core/histogram.hpp"
#include "runtime/log/log.hpp"
#include "web-ui/server/asio.hpp"
#include "web-ui/server/connection.hpp"
#include "web-ui/server/exchange.hpp"
#include "web-ui/server/handler_memory.hpp"
#include "web-ui/server/listen_address.hpp"
#include "web-ui/server/server_figures.hpp"
#include "web-ui/server/service.hpp"
#include "web-ui/server/settings.hpp"
#include "web-ui/server/surroundings.hpp"

namespace flexrf::panel {

/// `service` outlives it. Takes all its memory before it runs, but for the few who wait for a place.
/// Functions: the server's thread, but where they say otherwise.
class Server final : public LaterReplies {
 public:
  /// `encryption` null: plain HTTP. Any one thread.
  Server(const ServerSettings& settings, std::unique_ptr<net::ssl::context> encryption, Service& service);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Before run(). busy: somebody else listens there; invalid_argument: this machine has no such address;
  /// not_permitted: not for this user.
  Status listen(const ListenAddress& address);
  /// After listen().
  std::uint16_t port() const noexcept { return port_; }
  /// Whoever does something for the server in another thread rings it when that is done; on_tick() comes
  /// then.
  Doorbell& bell() noexcept { return bell_; }
  /// Serves until stop(): the server's thread is the one that calls it.
  void run();
  /// Live clients are told, what is under way may come to its end within 300 ms. Any thread.
  void stop() noexcept { stops_.store(true, std::memory_order_release); }

  ServerFigures figures() const noexcept;

  Reply* reply_of(Ticket ticket) override;
  void complete(Ticket ticket) override;

 private:
  void accept();
  void on_accepted(error_code error);

  // ---- placing.cpp
  enum class Bound : std::uint8_t { none, of_address, of_remote };
  struct Newcomer {
    Socket socket;
    Address address;
    Time since;
  };
  bool is_local(const Address& address) const noexcept;
  Bound bound_of(const Address& address) const noexcept;
  bool may_have_place_of(const Address& address, Bound bound, const Connection& other) const noexcept;
  Connection* dispensable(const Address& address, Bound bound) noexcept;
  bool place(Newcomer& newcomer);
  void welcome(Socket socket);
  void place_newcomers();
  bool turn_away_in_time(Newcomer& newcomer, Bound bound);
  bool turn_away(Socket& socket, Bound bound);

  void beat();
  void on_beat();
  void check_connections();
  Status make_bell();
  void hear();
  void tick();
  void plan_tick();
  void wind_up();

  ServerSettings settings_;
  std::unique_ptr<net::ssl::context> encryption_;
  // One thread at a time, which nobody else posts to: no locks.
  net::io_context context_{BOOST_ASIO_CONCURRENCY_HINT_UNSAFE};
  Service& service_;
  Surroundings surroundings_;
  std::deque<Connection> connections_;
  Acceptor acceptor_;
  Socket accepted_;
  Timer beat_timer_;
  Timer tick_timer_;
  Doorbell bell_;
  Descriptor rings_;  // of the bell
  bool bell_announced_ = false;
  std::deque<Newcomer> newcomers_;  // wait for a place
  std::deque<Connection> porters_;  // who have none, and tell it to whom there is no room for
  std::uint32_t occupied_ = 0;      // places, after the last turn
  Time next_placing_{};
  Time placed_at_{};  // when the last who waited got a place
  LogLimit full_;
  // Of the listener and the timers.
  HandlerMemory handler_memory_;
  Histogram loop_delay_;
  Duration loop_delay_p99_{};  // as of the last check: a quantile takes a walk through the buckets
  std::uint16_t port_ = 0;
  std::uint64_t refused_ = 0;
  std::uint32_t beats_ = 0;
  bool accepts_ = false;
  Time tick_planned_{};  // zero: no timer is set
  std::atomic<bool> stops_{false};
};

}  // namespace flexrf::panel
