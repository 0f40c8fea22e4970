#include "web-ui/server/access/panel_access.hpp"

#include <sodium.h>

#include "web-ui/server/access/cookie.hpp"

namespace flexrf::panel {

bool prepare_cryptography() noexcept {
  return sodium_init() >= 0;
}

namespace {

std::string cookie_name(const char* name, const AccessSettings& settings) {
  // A browser takes a cookie of such a name only by TLS, for this host and all of it (RFC 6265bis, 4.1.3).
  return (settings.secure ? "__Host-" : "") + std::string{name} + std::to_string(settings.port);
}

}  // namespace

PanelAccess::PanelAccess(const AccessSettings& settings)
    : settings_(settings),
      login_cookie_(cookie_name("flexrf_session_", settings)),
      visitor_cookie_(cookie_name("flexrf_visitor_", settings)),
      sessions_(settings.sessions, settings.local, settings.loopback_is_local) {
  if (!settings_.needs_login) token_.emplace();
}

SessionIndex PanelAccess::identify(const Visitor& visitor, SessionHandle& own, Time now,
                                   std::string& set_cookie) {
  SessionIndex session = by_cookie(visitor.cookies, login_cookie_);
  if (session == no_session) session = by_cookie(visitor.cookies, visitor_cookie_);
  if (session == no_session && own.serial != 0 && sessions_.serial(own.index) == own.serial)
    session = own.index;
  if (session != no_session) {
    sessions_.touch(session, visitor.address, now);
    return session;
  }
  if (settings_.needs_login || !visitor.loopback) return no_session;
  session = begin("", Role::viewer, visitor.address, now, set_cookie);
  own = handle(session);
  return session;
}

SessionIndex PanelAccess::by_cookie(std::string_view cookies, std::string_view name) const noexcept {
  CookieValues values(cookies, name);
  SessionIndex session = no_session;
  for (std::string_view value = values.next(); value.data() != nullptr && session == no_session;
       value = values.next())
    session = sessions_.find(value);
  return session;
}

SessionIndex PanelAccess::begin(std::string_view user, Role role, std::string_view address, Time now,
                                std::string& set_cookie) {
  if (sessions_.is_full()) end(sessions_.dispensable(control_.holder()));
  const SessionIndex session = sessions_.begin(user, role, address, now);
  if (session == no_session) return no_session;
  ++revision_;
  // One that nobody logged in to lives as long as its page: its cookie has to.
  constexpr Duration for_ever = std::chrono::hours{365 * 24};
  write_set_cookie(set_cookie, role == Role::viewer && user.empty() ? visitor_cookie_ : login_cookie_,
                   sessions_.cookie(session), user.empty() ? for_ever : settings_.sessions.absolute,
                   settings_.secure);
  return session;
}

SessionIndex PanelAccess::log_in(const SessionHandle& former, std::string_view user, Role role,
                                 std::string_view address, Time now, std::string& set_cookie) {
  // The former one first: its place may be the only one that can be had.
  if (former.serial != 0 && sessions_.serial(former.index) == former.serial) end(former.index);
  const SessionIndex session = begin(user, role, address, now, set_cookie);
  note(session, user.empty() ? "came in by the address that was printed" : "logged in");
  return session;
}

/// Whoever only looks has neither come nor gone.
void PanelAccess::note(SessionIndex session, const char* did) noexcept {
  const SessionInfo* const known = sessions_.info(session);
  if (known != nullptr && (!known->user.empty() || known->role > Role::viewer)) note(who_of(known), did);
}

void PanelAccess::log_out(SessionIndex session, std::string& set_cookie) {
  note(session, "logged out");
  end(session);
  write_forget_cookie(set_cookie, login_cookie_, settings_.secure);
}

void PanelAccess::end_sessions_of(std::string_view user) {
  for (SessionIndex one = sessions_.of_user(user); one != no_session; one = sessions_.of_user(user)) {
    note(one, "was logged out: the file of passwords has changed");
    end(one);
  }
}

void PanelAccess::end(SessionIndex session) {
  if (sessions_.info(session) == nullptr) return;
  control_.release(session);
  if (watcher_ != nullptr) watcher_->on_session_ended(session);
  sessions_.end(session);
  ++revision_;
}

void PanelAccess::update(Time now) {
  for (SessionIndex over = sessions_.expired(now); over != no_session; over = sessions_.expired(now)) {
    note(over, "was logged out: the time of the session was over");
    end(over);
  }
  for (SessionIndex over = sessions_.lapsing(now); over != no_session; over = sessions_.lapsing(now)) {
    note(over, "has to log in again: the time of the session is over");
    control_.release(over);
    sessions_.lapse(over);
    ++revision_;
  }
  // Who asked and left must not get it: nobody would hold it then.
  for (const SessionIndex concerned : {control_.wanted_by(), control_.holder()}) {
    if (concerned != no_session && !sessions_.is_present(concerned, absence, now))
      control_.release(concerned);
  }
  control_.update(now, sessions_.is_there(control_.holder()));
}

bool PanelAccess::use_token(std::string_view text) {
  if (!token_ || !token_->use(text)) return false;
  token_.emplace();
  if (settings_.token_renewed) settings_.token_renewed(*token_);
  return true;
}

bool PanelAccess::has_role(SessionIndex session, Role role) const {
  const SessionInfo* const known = sessions_.info(session);
  return known != nullptr && known->role >= role;
}

AccessControl::Taking PanelAccess::take(SessionIndex session, Time now) {
  const SessionInfo* const known = sessions_.info(session);
  if (known == nullptr) return Taking::refused_role;
  return control_.take({session, known->role >= Role::operator_, known->local}, now);
}

bool PanelAccess::answer(SessionIndex session, bool grant, Time) {
  return control_.answer(session, grant);
}

}  // namespace flexrf::panel
