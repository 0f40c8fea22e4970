#include "web-ui/server/panel_routes.hpp"

#include <algorithm>

namespace flexrf::panel {

void PanelRoutes::connect(const Parts& parts, std::uint32_t places) {
  parts_.emplace(parts);
  links_.assign(places, nullptr);
  parts.access.watch(parts.api.control_watcher());
  parts.access.watch(parts.api.session_watcher());
  parts.access.watch(static_cast<SessionWatcher&>(*this));
}

bool PanelRoutes::admit(const Approach& approach, SessionIndex& session, Reply& reply) {
  return parts_->entrance.admit(approach, session, reply);
}

void PanelRoutes::on_connection_closed(std::uint32_t place) {
  parts_->entrance.on_connection_closed(place);
}

Handled PanelRoutes::handle(const Request& request, Reply& reply, Ticket ticket) {
  if (AccessEndpoints::is_for(request.path)) return parts_->endpoints.handle(request, reply, ticket);
  if (request.path.starts_with("/api/")) return parts_->api.handle(request, reply, ticket);
  return parts_->files.handle(request, reply, ticket);
}

void PanelRoutes::on_open(LiveLink& link) {
  links_[link.place()] = &link;
  parts_->access.link_opened(link.session());
  parts_->api.on_open(link);
}

void PanelRoutes::on_text(LiveLink& link, std::string_view text) {
  parts_->api.on_text(link, text);
}

void PanelRoutes::on_writable(LiveLink& link) {
  parts_->api.on_writable(link);
}

void PanelRoutes::on_close(LiveLink& link) {
  parts_->api.on_close(link);
  // Of a session that ended the index may be another's already.
  if (links_[link.place()] != nullptr) parts_->access.link_closed(link.session(), MonotonicClock::now());
  links_[link.place()] = nullptr;
}

void PanelRoutes::on_session_ended(SessionIndex session) {
  for (LiveLink*& link : links_) {
    if (link == nullptr || link->session() != session) continue;
    link->close(1008, "the session has ended");
    link = nullptr;
  }
}

void PanelRoutes::on_tick(Time now) {
  parts_->endpoints.on_tick(now);
  parts_->api.set_figures(parts_->server.figures());
  parts_->api.on_tick(now);
}

Duration PanelRoutes::until_next(Time now) const {
  return std::min(parts_->endpoints.until_next(now), parts_->api.until_next(now));
}

}  // namespace flexrf::panel
