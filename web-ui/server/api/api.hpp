// What the panel's server says under /api/v1, REST and live, without sockets.
#pragma once

#include <cstdint>
#include <string>

#include "web-ui/server/access.hpp"
#include "web-ui/server/api/image_requests.hpp"
#include "web-ui/server/api/live_session.hpp"
#include "web-ui/server/api/rest_handler.hpp"
#include "web-ui/server/server_figures.hpp"

namespace flexrf::panel {

/// How long others may take: before who asked is told that they do not answer, before an edit is discarded.
struct ApiTimeouts {
  Duration answer = std::chrono::seconds{1};   ///< of a component's thread
  Duration picture = std::chrono::seconds{2};  ///< of the worker that encodes pictures
  Duration edit = std::chrono::minutes{5};     ///< of who began it, and neither applies nor discards it
};

/// All functions but those that say otherwise: the server's thread. None takes longer than 5 ms, none
/// allocates in the steady state (subscribed values, refreshed holds, reading of values).
class Api final : public AccessWatcher {
 public:
  /// `places`: connections that the server has, each LiveLink's place is below. `bell`: rung when another
  /// thread has answered, and on_tick() is to come; null: it comes often enough by itself. `helper`: the
  /// socket of the PC's; empty: there is none. The main thread, after Executive::prepare(), before anything
  /// runs; all outlive the Api.
  Api(Executive& executive, AccessControl& access, LaterReplies& replies, std::uint32_t places,
      const ApiTimeouts& timeouts = {}, Doorbell* bell = nullptr, std::string helper = {});
  Api(const Api&) = delete;
  Api& operator=(const Api&) = delete;

  /// Before anything runs: registers as a requester. The main thread.
  Status prepare();
  /// Starts the workers, one that encodes pictures, one that asks the PC's helper; they inherit CPUs and
  /// signal mask. The main thread.
  Status start();
  /// Ends them. After the server's thread ended. The main thread.
  void stop() noexcept;

  /// All paths under /api/v1 but `session`, `login`, `logout` and `live`.
  Handled handle(const Request& request, Reply& reply, Ticket ticket) {
    return rest_.handle(request, reply, ticket);
  }
  LiveService& live() noexcept { return live_; }
  /// Answers, time-outs, events, frames.
  void on_tick(Time now);
  Duration until_next(Time now) const;

  void on_control_changed(SessionIndex from, SessionIndex to) override;
  void on_session_ended(SessionIndex session) override;
  /// For the `state` event; as often as they are known anew.
  void set_figures(const ServerFigures& figures) noexcept { state_.set_figures(figures); }

 private:
  // In the order in which one builds on the other.
  Executive& executive_;
  AccessControl& access_;
  Doorbell* bell_;
  std::string boot_;
  JsonReader reader_;
  Clients clients_;
  Answers answers_;
  Permission permission_;
  Directory directory_;
  ObservedSlots slots_;
  ComponentValues values_;
  ImageWorker images_;
  ImageRequests pictures_;
  ParameterOperations parameters_;
  EditOperations edits_;
  MotionOperations motion_;
  LifecycleOperations lifecycle_;
  SaveOperations saving_;
  MachineOperations machine_;
  Subscriptions subscriptions_;
  Operations operations_;
  StateEvent state_;
  TopicBodies topics_;
  FrameWriter frames_;
  LiveSession live_;
  RestHandler rest_;
};

}  // namespace flexrf::panel
