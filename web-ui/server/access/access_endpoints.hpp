// GET /api/v1/session, POST /api/v1/login, POST /api/v1/logout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "web-ui/server/access/login_limits.hpp"
#include "web-ui/server/access/login_log.hpp"
#include "web-ui/server/access/panel_access.hpp"
#include "web-ui/server/access/password.hpp"
#include "web-ui/server/access/password_check.hpp"
#include "web-ui/server/access/user_file.hpp"
#include "web-ui/server/access/user_watch.hpp"
#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

/// Logins wait here for the one process that checks passwords; those at the machine come first. Also what
/// drives access control in time: ticks go to PanelAccess. The server's thread.
class AccessEndpoints {
 public:
  /// Attempts that wait or are under way; those over the network get no more than half.
  static constexpr std::size_t places = 4;

  /// All outlive it; `users` change with their file.
  AccessEndpoints(PanelAccess& access, LoginLimits& limits, Users& users, UserFileWatch& watch,
                  PasswordCheck& check, LaterReplies& replies, Clock clock = &MonotonicClock::now);
  ~AccessEndpoints();
  AccessEndpoints(const AccessEndpoints&) = delete;
  AccessEndpoints& operator=(const AccessEndpoints&) = delete;

  static bool is_for(std::string_view path) noexcept;
  Handled handle(const Request& request, Reply& reply, Ticket ticket);

  void on_tick(Time now);
  Duration until_next(Time now) const;

 private:
  struct Attempt {
    std::uint64_t order = 0;  // 0: free
    Ticket ticket{};
    SessionHandle former;
    bool at_machine = false;
    Address address;
    std::array<char, 48> address_text{};
    std::array<char, Users::longest_name + 1> user{};
    ShownName shown_user{};
    std::array<char, longest_password> password{};
    std::size_t password_size = 0;
  };

  Handled log_in(const Request& request, Reply& reply, Ticket ticket);
  Attempt* free_place(bool at_machine) noexcept;
  void start_next(Time now);
  void finish(PasswordCheck::Outcome outcome, Time now);
  void answer(Attempt& attempt, PasswordCheck::Outcome outcome, Time now, Reply& reply);
  void forget(Attempt& attempt) noexcept;
  bool is_right(const Attempt& attempt, PasswordCheck::Outcome outcome) const noexcept;
  void use(Users users);

  PanelAccess& access_;
  LoginLimits& limits_;
  Users& users_;
  UserFileWatch& watch_;
  PasswordCheck& check_;
  LaterReplies& replies_;
  Clock clock_;
  std::array<Attempt, places> attempts_{};
  Attempt* checked_ = nullptr;  // whose password the process has
  std::uint64_t last_order_ = 0;
};

}  // namespace flexrf::panel
