// What the panel's server says under /api/v1, REST and live, without sockets.
#pragma once

#include <cstdint>
#include <memory>

#include "base/status.hpp"
#include "base/time.hpp"
#include "web-ui/server/access.hpp"
#include "web-ui/server/exchange.hpp"
#include "web-ui/server/live_link.hpp"
#include "web-ui/server/server_figures.hpp"

namespace flexrf {
class Doorbell;
class Executive;
}  // namespace flexrf

namespace flexrf::panel {

/// How long others may take: before who asked is told that they do not answer, before an edit is discarded.
struct ApiTimeouts {
  Duration answer = std::chrono::seconds{1};   ///< of a component's thread
  Duration picture = std::chrono::seconds{2};  ///< of the worker that encodes pictures
  Duration edit = std::chrono::minutes{5};     ///< of who began it, and neither applies nor discards it
};

/// All functions but those that say otherwise: the server's thread. None takes longer than 5 ms, none
/// allocates in the steady state (subscribed values, refreshed holds, reading of values).
class Api {
 public:
  /// `places`: connections that the server has, each LiveLink's place is below. `bell`: rung when another
  /// thread has answered, and on_tick() is to come; null: it comes often enough by itself. The main thread,
  /// before the executive runs; all outlive the Api.
  Api(Executive& executive, AccessControl& access, LaterReplies& replies, std::uint32_t places,
      const ApiTimeouts& timeouts = {}, Doorbell* bell = nullptr);
  Api(const Api&) = delete;
  Api& operator=(const Api&) = delete;
  ~Api();

  /// After Executive::prepare(), before anything runs: registers as a requester. The main thread.
  Status prepare();
  /// Starts the worker that encodes pictures; it inherits CPUs and signal mask. The main thread.
  Status start();
  /// Ends the worker. After the server's thread ended. The main thread.
  void stop() noexcept;

  /// All paths under /api/v1 but `session`, `login`, `logout` and `live`.
  Handled handle(const Request& request, Reply& reply, Ticket ticket);
  // Of live connections, as Service has them.
  void on_open(LiveLink& link);
  void on_text(LiveLink& link, std::string_view text);
  void on_writable(LiveLink& link);
  void on_close(LiveLink& link);
  /// Answers, time-outs, events, frames.
  void on_tick(Time now);
  Duration until_next(Time now) const;

  ControlWatcher& control_watcher() noexcept;
  SessionWatcher& session_watcher() noexcept;
  /// For the `state` event; as often as they are known anew.
  void set_figures(const ServerFigures& figures) noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace flexrf::panel
