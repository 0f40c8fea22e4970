// Which part of the panel gets what the server receives.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "web-ui/server/access/access_endpoints.hpp"
#include "web-ui/server/access/entrance.hpp"
#include "web-ui/server/access/panel_access.hpp"
#include "web-ui/server/api/api.hpp"
#include "web-ui/server/files.hpp"
#include "web-ui/server/server.hpp"
#include "web-ui/server/service.hpp"

namespace flexrf::panel {

/// The server's thread, but connect().
class PanelRoutes final : public Service, public SessionWatcher {
 public:
  struct Parts {
    Server& server;
    PanelAccess& access;
    Entrance& entrance;
    AccessEndpoints& endpoints;
    Api& api;
    Files& files;
  };

  /// Once, before the server runs; all outlive it. The server is made before its parts are, as they need it.
  void connect(const Parts& parts, std::uint32_t places);

  bool admit(const Approach& approach, SessionIndex& session, Reply& reply) override;
  void on_connection_closed(std::uint32_t place) override;

  Handled handle(const Request& request, Reply& reply, Ticket ticket) override;

  void on_open(LiveLink& link) override;
  void on_text(LiveLink& link, std::string_view text) override;
  void on_writable(LiveLink& link) override;
  void on_close(LiveLink& link) override;

  void on_tick(Time now) override;
  Duration until_next(Time now) const override;

  void on_session_ended(SessionIndex session) override;

 private:
  std::optional<Parts> parts_;
  std::vector<LiveLink*> links_;  // per place; null: none
};

}  // namespace flexrf::panel
