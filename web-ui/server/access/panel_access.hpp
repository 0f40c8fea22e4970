// Access control of the panel, put together: who is who, and who holds the control token.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "web-ui/server/access.hpp"
#include "web-ui/server/access/control_token.hpp"
#include "web-ui/server/access/one_time_token.hpp"
#include "web-ui/server/access/session_table.hpp"

namespace flexrf::panel {

struct AccessSettings {
  bool needs_login = false;    ///< there is a file of users: nobody is anybody before logging in
  bool secure = false;         ///< by TLS: the cookie is Secure
  std::uint16_t port = 8080;   ///< part of the cookie's name, for cookies do not tell ports apart
  std::vector<Address> local;  ///< what the application's table calls local, beside loopback
  bool loopback_is_local = true;
  SessionLimits sessions;
  AuditIntake* audit = nullptr;  ///< who comes and goes is told there; null: nowhere
  /// Told of each token but the first. The server's thread.
  std::function<void(const OneTimeToken&)> token_renewed;
};

/// One session and no other that gets its place later.
struct SessionHandle {
  SessionIndex index = no_session;
  std::uint32_t serial = 0;
};

/// Whoever is at the other end of a connection.
struct Visitor {
  std::string_view cookies;  ///< the Cookie header; empty: none
  std::string_view address;  ///< numeric
  bool loopback = false;     ///< the other end is this machine
};

/// The server's clock; tests have their own.
using Clock = Time (*)();

/// Takes its memory in the constructor; needs prepare_cryptography() before. The server's thread.
class PanelAccess final : public AccessControl {
 public:
  /// A session without an open live connection is gone when it was not heard of for so long.
  static constexpr Duration absence = std::chrono::seconds{15};

  explicit PanelAccess(const AccessSettings& settings);

  /// The visitor's session. By cookie; else the connection's `own`, for clients that keep no cookies; else,
  /// on loopback without logins, a new one, whose cookie is put into `set_cookie`. no_session: has to log in
  /// first (or, without logins, is not on this machine, or all places are in use).
  SessionIndex identify(const Visitor& visitor, SessionHandle& own, Time now, std::string& set_cookie);

  /// Ends `former`, if there is such a session, so that nobody who knew its cookie profits, and begins a
  /// session. no_session: all places are in use by holders and open connections.
  SessionIndex log_in(const SessionHandle& former, std::string_view user, Role role, std::string_view address,
                      Time now, std::string& set_cookie);
  void log_out(SessionIndex session, std::string& set_cookie);
  /// Of whoever logged in by this name.
  void end_sessions_of(std::string_view user);

  /// Ends what is over, gives the token to who waited, takes it from who is gone. At least every 250 ms.
  void update(Time now);

  /// Of the address to be printed; null when people log in. Never for a log that visitors can read.
  const OneTimeToken* one_time_token() const noexcept { return token_ ? &*token_ : nullptr; }
  /// True once for its text; there is a new one then.
  bool use_token(std::string_view text);
  /// What somebody did who is no session (yet), for the audit.
  void note(std::string_view who, const char* did, std::string_view what = {}) noexcept {
    if (settings_.audit != nullptr) settings_.audit->note(who, did, what);
  }
  SessionHandle handle(SessionIndex session) const noexcept { return {session, sessions_.serial(session)}; }
  /// At the machine: loopback, or an address that the application's table calls local.
  bool is_local(std::string_view address) const noexcept { return sessions_.is_local(address); }
  bool needs_login() const noexcept { return settings_.needs_login; }
  std::size_t session_count() const noexcept { return sessions_.count(); }

  /// Before the server runs; outlives it.
  void watch(AccessWatcher& watcher) noexcept {
    watcher_ = &watcher;
    control_.watch(watcher);
  }

  const SessionInfo* session(SessionIndex session) const override { return sessions_.info(session); }
  bool has_role(SessionIndex session, Role role) const override;
  SessionIndex holder() const override { return control_.holder(); }
  SessionIndex wanted_by() const override { return control_.wanted_by(); }
  Duration answer_within(Time now) const override { return control_.answer_within(now); }
  Taking take(SessionIndex session, Time now) override;
  void release(SessionIndex session) override { control_.release(session); }
  bool answer(SessionIndex session, bool grant, Time now) override;
  void link_opened(SessionIndex session) override { sessions_.link_opened(session); }
  void link_closed(SessionIndex session, Time now) override { sessions_.link_closed(session, now); }
  void acted(SessionIndex session, Time now) override { sessions_.acted(session, now); }
  std::uint64_t revision() const override { return revision_ + control_.revision(); }

 private:
  SessionIndex by_cookie(std::string_view cookies, std::string_view name) const noexcept;
  SessionIndex begin(std::string_view user, Role role, std::string_view address, Time now,
                     std::string& set_cookie);
  void end(SessionIndex session);
  void note(SessionIndex session, const char* did) noexcept;

  AccessSettings settings_;
  // Two names: a browser asks for several things at once, and the answer to one that was asked before a login
  // may come after it. A visitor's cookie in it must not take the place of the login's.
  std::string login_cookie_;
  std::string visitor_cookie_;
  SessionTable sessions_;
  ControlToken control_;
  std::optional<OneTimeToken> token_;
  AccessWatcher* watcher_ = nullptr;
  std::uint64_t revision_ = 0;
};

/// Once per process, before anything here: false when the system has no source of randomness.
bool prepare_cryptography() noexcept;

}  // namespace flexrf::panel
