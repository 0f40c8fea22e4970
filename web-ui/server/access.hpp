// Who may do what: sessions with roles, the one-time token, logins, and the one control token.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "base/time.hpp"
#include "runtime/core/parameter_descriptor.hpp"
#include "runtime/parameters/audit_intake.hpp"
#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

/// What others may know of a session. Views live until the session ends.
struct SessionInfo {
  std::string_view name;     ///< short, for people: "panel-3"
  std::string_view user;     ///< who logged in; empty without a password
  std::string_view address;  ///< numeric, of its newest connection
  Role role = Role::viewer;
  bool local = false;  ///< from an address that the application's table calls local
  /// Its time is over while its page is open, or gone for a moment: it sees, may stop motion, and has to log
  /// in for more.
  bool lapsed = false;
};

/// A person as the audit names him: "ann (192.168.0.7)"; without a log-in his session, "panel-3 (127.0.0.1)".
class Who {
 public:
  Who(std::string_view name, std::string_view address) noexcept {
    std::snprintf(text_, sizeof(text_), "%.*s (%.*s)", static_cast<int>(name.size()), name.data(),
                  static_cast<int>(address.size()), address.data());
  }
  operator std::string_view() const noexcept { return text_; }

 private:
  char text_[longest_who];
};
/// `session` null: it has ended.
inline Who who_of(const SessionInfo* session) noexcept {
  if (session == nullptr) return {"somebody", "gone"};
  return {session->user.empty() ? session->name : session->user, session->address};
}

/// What handlers ask of access control. All functions: the server's thread; none blocks.
class AccessControl {
 public:
  virtual const SessionInfo* session(SessionIndex session) const = 0;  ///< null: it ended
  virtual bool has_role(SessionIndex session, Role role) const = 0;

  // ---- the control token
  virtual SessionIndex holder() const = 0;     ///< no_session: nobody
  virtual SessionIndex wanted_by() const = 0;  ///< who asked for it and waits
  virtual Duration answer_within(Time now) const = 0;
  enum class Taking : std::uint8_t {
    taken,
    asked,          ///< the holder has 10 s to refuse
    refused_role,   ///< it takes an operator
    refused_local,  ///< its holder is local, and who asks is not
    refused_asked,  ///< somebody else has asked and waits
  };
  virtual Taking take(SessionIndex session, Time now) = 0;
  virtual void release(SessionIndex session) = 0;
  virtual bool answer(SessionIndex session, bool grant,
                      Time now) = 0;  ///< false: it is not the holder's to answer
  /// Live connections of a session, as they open and close.
  virtual void link_opened(SessionIndex session) = 0;
  virtual void link_closed(SessionIndex session, Time now) = 0;
  /// A person did something in this session: its time without use begins anew.
  virtual void acted(SessionIndex session, Time now) = 0;
  /// Rises with everything above that changed: sessions, holder, who asks.
  virtual std::uint64_t revision() const = 0;

 protected:
  ~AccessControl() = default;
};

/// Told of what somebody else has to act on at once.
class AccessWatcher {
 public:
  /// The control token has another holder, however it came about: ends holds, stops manual motion.
  virtual void on_control_changed(SessionIndex from, SessionIndex to) = 0;
  /// By log-out, time or a new login. What is connected under its index must be closed now: the index may be
  /// another session's soon.
  virtual void on_session_ended(SessionIndex session) = 0;

 protected:
  ~AccessWatcher() = default;
};

}  // namespace flexrf::panel
