// Every request passes here first: is it meant for this server, does it come from our own page, and who asks?
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "web-ui/server/access/host_rules.hpp"
#include "web-ui/server/access/login_limits.hpp"
#include "web-ui/server/access/panel_access.hpp"
#include "web-ui/server/service.hpp"

namespace flexrf::panel {

/// Refuses with 421 a foreign Host, with 403 a change by a foreign page, with 401 who has to log in first
/// (the page itself and `login` are open), and redirects who brings the one-time token. The server's thread.
class Entrance {
 public:
  /// `places`: connections that the server has. All outlive it.
  Entrance(PanelAccess& access, LoginLimits& limits, const HostRules& rules, std::uint32_t places,
           Clock clock = &MonotonicClock::now);

  bool admit(const Request& request, SessionIndex& session, Reply& reply);
  void on_connection_closed(std::uint32_t place);

 private:
  bool is_ours(const Request& request, Reply& reply) const;
  void use_token(const Request& request, std::string_view token, SessionIndex session, Time now,
                 Reply& reply);

  PanelAccess& access_;
  LoginLimits& limits_;
  const HostRules& rules_;
  Clock clock_;
  std::vector<SessionHandle> own_;  // per place: the session that its connection began
};

}  // namespace flexrf::panel
