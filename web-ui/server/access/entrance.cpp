#include "web-ui/server/access/entrance.hpp"

#include <string>

#include "web-ui/server/access/login_log.hpp"
#include "web-ui/server/http_problem.hpp"

namespace flexrf::panel {
namespace {

bool is_change(const Request& request) noexcept {
  return request.upgrade || (request.method != Method::get && request.method != Method::head);
}

/// The page itself holds nothing of the application: whoever is to log in needs it. Who supervises this
/// machine asks for its health without a login.
bool is_open(const Request& request) noexcept {
  const std::string_view path = request.path;
  return path == "/api/v1/login" || (path == "/api/v1/health" && request.loopback) ||
         !(path.starts_with("/api/") || path.starts_with("/application/"));
}

/// Null data: there is no such parameter.
std::string_view parameter(std::string_view query, std::string_view name) noexcept {
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view part = query.substr(0, end);
    query = end == std::string_view::npos ? std::string_view{} : query.substr(end + 1);
    if (part.size() > name.size() && part.starts_with(name) && part[name.size()] == '=')
      return part.substr(name.size() + 1);
  }
  return {};
}

std::string cut(std::string_view text) {
  return std::string{text.substr(0, 100)};
}

}  // namespace

Entrance::Entrance(PanelAccess& access, LoginLimits& limits, const HostRules& rules, std::uint32_t places,
                   Clock clock)
    : access_(access), limits_(limits), rules_(rules), clock_(clock), own_(places) {}

bool Entrance::is_ours(const Request& request, Reply& reply) const {
  if (!rules_.allows_host(request.host, request.local_end)) {
    answer_problem(reply, 421,
                   "This server is not called " + cut(request.host) +
                       ". Ask for it by its address or its machine's name. On a FlexRF PC an admin declares "
                       "other addresses at the panel, Machine; elsewhere start the application with "
                       "--panel-host NAME.");
    return false;
  }
  if (!is_change(request)) return true;
  // A browser that says where it comes from, but not who asks, has something to hide; a script says neither.
  const bool is_anonymous_page = request.origin.empty() && request.has_fetch_site;
  if (!is_anonymous_page && rules_.allows_origin(request.origin, request.host)) return true;
  answer_problem(
      reply, 403,
      "Pages of another origin (" + cut(request.origin) + ") may not change anything here, nor connect.");
  return false;
}

bool Entrance::admit(const Request& request, SessionIndex& session, Reply& reply) {
  session = no_session;
  if (!is_ours(request, reply)) return false;
  const Time now = clock_();
  session = access_.identify({request.cookie, request.remote_address, request.loopback}, own_[request.place],
                             now, reply.set_cookie);
  if (is_change(request) && !request.upgrade) access_.acted(session, now);
  if (request.method == Method::get && request.path == "/" && !request.upgrade) {
    const std::string_view token = parameter(request.query, "token");
    if (token.data() != nullptr) {
      use_token(request, token, session, now, reply);
      return false;
    }
  }
  if (session != no_session || is_open(request)) return true;
  if (access_.needs_login()) {
    answer_problem(reply, 401, "Log in first: open the page, or POST user and password to /api/v1/login.");
  } else if (request.loopback) {
    reply.retry_after = 10;
    answer_problem(reply, 503, "All sessions are in use. Close a page that is not needed.");
  } else {
    answer_problem(reply, 403,
                   "Only this machine may see the panel as long as there are no passwords; "
                   "`./flexrf password` makes one.");
  }
  return false;
}

void Entrance::use_token(const Request& request, std::string_view token, SessionIndex session, Time now,
                         Reply& reply) {
  // The printed address may be opened again by the browser that has its session.
  bool is_admin = access_.has_role(session, Role::admin);
  if (!is_admin && request.loopback && access_.use_token(token))
    is_admin = access_.log_in(access_.handle(session), "", Role::admin, request.remote_address, now,
                              reply.set_cookie) != no_session;
  if (is_admin) {
    reply.status = 303;
    reply.location = "/";
    return;
  }
  const std::optional<Address> address = Address::parse(request.remote_address);
  const Duration wait =
      limits_.admit(address.value_or(Address{}), access_.is_local(request.remote_address), now);
  if (wait > Duration::zero()) {
    reply.retry_after = seconds_to_wait(wait);
    answer_problem(reply, 429, "Too many wrong attempts. Wait before the next.");
    return;
  }
  log_failed_token(request.remote_address);
  access_.note(Who("somebody", request.remote_address),
               "did not get in: the address's token is wrong or was used");
  answer_problem(
      reply, 403,
      "This address was used already, or the application was started anew since it was printed. Without it "
      "the page can be seen, at / ; a new address is in the file that the application named when it started, "
      "or make passwords (`./flexrf password`).");
}

void Entrance::on_connection_closed(std::uint32_t place) {
  own_[place] = {};
}

}  // namespace flexrf::panel
