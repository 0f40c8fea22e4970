#include "web-ui/server/access/access_endpoints.hpp"

#include <sodium.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/json_writer.hpp"
#include "base/text.hpp"
#include "runtime/log/log.hpp"
#include "web-ui/server/access/login_body.hpp"
#include "web-ui/server/http_problem.hpp"

namespace flexrf::panel {
namespace {

constexpr Duration poll_of_check = std::chrono::milliseconds{20};
constexpr Duration poll_of_access = std::chrono::milliseconds{100};

constexpr std::string_view session_path = "/api/v1/session";
constexpr std::string_view login_path = "/api/v1/login";
constexpr std::string_view logout_path = "/api/v1/logout";

bool is_json(const Request& request) noexcept {
  return request.content_type.substr(0, request.content_type.find(';')) == "application/json";
}

void write_session(Reply& reply, const SessionInfo& session) {
  reply.status = 200;
  reply.text.clear();
  JsonWriter json(std::move(reply.text));
  json.begin_object().member("name", session.name).member("role", name_of(session.role));
  json.member("local", session.local).member("user", session.user).end_object();
  reply.text = json.release();
}

void clear(LoginBody& body) noexcept {
  sodium_memzero(body.user.data(), body.user.size());
  sodium_memzero(body.password.data(), body.password.size());
}

}  // namespace

AccessEndpoints::AccessEndpoints(PanelAccess& access, LoginLimits& limits, Users& users, UserFileWatch& watch,
                                 PasswordCheck& check, LaterReplies& replies, Clock clock)
    : access_(access),
      limits_(limits),
      users_(users),
      watch_(watch),
      check_(check),
      replies_(replies),
      clock_(clock) {}

AccessEndpoints::~AccessEndpoints() {
  for (Attempt& attempt : attempts_) forget(attempt);
}

bool AccessEndpoints::is_for(std::string_view path) noexcept {
  return path == session_path || path == login_path || path == logout_path;
}

Handled AccessEndpoints::handle(const Request& request, Reply& reply, Ticket ticket) {
  const bool is_question = request.method == Method::get || request.method == Method::head;
  const SessionInfo* const session = access_.session(request.session);
  if (request.path == session_path && is_question) {
    if (session == nullptr) {
      answer_problem(reply, 401, "Log in first.");
    } else {
      write_session(reply, *session);
    }
  } else if (request.path == login_path && request.method == Method::post) {
    return log_in(request, reply, ticket);
  } else if (request.path == logout_path && request.method == Method::post) {
    if (!request.body.empty() && !is_json(request)) {
      answer_problem(reply, 415, "Send application/json, or nothing.");
      return Handled::now;
    }
    access_.log_out(request.session, reply.set_cookie);
    reply.status = 204;
  } else if (is_for(request.path)) {
    answer_problem(reply, 405, request.path == session_path ? "Only GET." : "Only POST.");
  } else {
    answer_problem(reply, 404, "There is nothing of this name.");
  }
  return Handled::now;
}

Handled AccessEndpoints::log_in(const Request& request, Reply& reply, Ticket ticket) {
  const auto refuse = [&reply](unsigned status, std::string_view detail) {
    answer_problem(reply, status, detail);
    return Handled::now;
  };
  if (!access_.needs_login())
    return refuse(
        409,
        "Nobody logs in here: there are no passwords. Control takes the address that the application "
        "printed when it started.");
  if (!is_json(request)) return refuse(415, "Send application/json.");
  LoginBody body;
  if (!read_login_body(request.body, body)) {
    clear(body);
    return refuse(400, R"(Send {"user": "...", "password": "..."}.)");
  }
  const bool at_machine = access_.is_local(request.remote_address);
  const Address address = Address::parse(request.remote_address).value_or(Address{});
  Attempt* const place = free_place(at_machine);
  const Time now = clock_();
  const Duration wait =
      place == nullptr ? Duration{std::chrono::seconds{1}} : limits_.admit(address, at_machine, now);
  if (wait > Duration::zero()) {
    clear(body);
    reply.retry_after = seconds_to_wait(wait);
    return refuse(429, place == nullptr ? "Others are logging in just now. Try again in a second."
                                        : "Too many attempts to log in. Wait before the next.");
  }
  place->order = ++last_order_;
  place->ticket = ticket;
  place->former = access_.handle(request.session);
  place->at_machine = at_machine;
  place->address = address;
  set_text(place->address_text, request.remote_address);
  // One too long is nobody's, and takes as long to refuse.
  set_text(place->user,
           body.user.size() <= Users::longest_name ? std::string_view{body.user} : std::string_view{});
  place->shown_user = shown_name(body.user);
  place->password_size = body.password.size() <= longest_password ? body.password.size() : 0;
  std::copy_n(body.password.begin(), place->password_size, place->password.begin());
  clear(body);
  return Handled::later;  // the tick after this call starts it
}

AccessEndpoints::Attempt* AccessEndpoints::free_place(bool at_machine) noexcept {
  Attempt* free = nullptr;
  std::size_t remote = 0;
  for (Attempt& attempt : attempts_) {
    if (attempt.order == 0) free = &attempt;
    if (attempt.order != 0 && !attempt.at_machine) ++remote;
  }
  return at_machine || remote < places / 2 ? free : nullptr;
}

void AccessEndpoints::start_next(Time now) {
  while (checked_ == nullptr) {
    Attempt* next = nullptr;
    const auto rank = [](const Attempt& attempt) { return std::pair{!attempt.at_machine, attempt.order}; };
    for (Attempt& attempt : attempts_) {
      if (attempt.order != 0 && (next == nullptr || rank(attempt) < rank(*next))) next = &attempt;
    }
    if (next == nullptr) return;
    checked_ = next;
    if (users_.list.empty()) {
      finish(PasswordCheck::Outcome::wrong, now);
      continue;
    }
    // A name that nobody has costs as much time as any.
    const User* const user = users_.find(text_view(next->user));
    const std::string& hash = user != nullptr ? user->password_hash : users_.list.front().password_hash;
    if (!check_.start(hash, {next->password.data(), next->password_size}, now))
      finish(PasswordCheck::Outcome::failed, now);
    else
      sodium_memzero(next->password.data(), next->password.size());
  }
}

void AccessEndpoints::finish(PasswordCheck::Outcome outcome, Time now) {
  Attempt& attempt = *checked_;
  checked_ = nullptr;
  if (outcome == PasswordCheck::Outcome::failed) limits_.could_not_be_checked(attempt.address, now);
  // Said even if nobody waits for the answer any more.
  if (outcome != PasswordCheck::Outcome::failed && !is_right(attempt, outcome)) {
    log_failed_login(attempt.shown_user, text_view(attempt.address_text));
    access_.note(Who("somebody", text_view(attempt.address_text)), "did not get in",
                 text_view(attempt.shown_user));
  }
  if (Reply* const reply = replies_.reply_of(attempt.ticket)) {
    answer(attempt, outcome, now, *reply);
    replies_.complete(attempt.ticket);
  }
  forget(attempt);
}

bool AccessEndpoints::is_right(const Attempt& attempt, PasswordCheck::Outcome outcome) const noexcept {
  return outcome == PasswordCheck::Outcome::right && users_.find(text_view(attempt.user)) != nullptr;
}

void AccessEndpoints::answer(Attempt& attempt, PasswordCheck::Outcome outcome, Time now, Reply& reply) {
  if (outcome == PasswordCheck::Outcome::failed) {
    reply.retry_after = 5;
    answer_problem(reply, 503,
                   "The password could not be checked: the machine has too little memory or too many "
                   "processes. Try again.");
    return;
  }
  if (!is_right(attempt, outcome)) {
    answer_problem(reply, 403, "User or password is wrong.");
    return;
  }
  const User* const user = users_.find(text_view(attempt.user));
  limits_.succeeded(attempt.address);
  const SessionIndex session = access_.log_in(attempt.former, user->name, user->role,
                                              text_view(attempt.address_text), now, reply.set_cookie);
  if (session == no_session) {
    reply.retry_after = 10;
    answer_problem(reply, 503, "All sessions are in use. Close a page that is not needed.");
    return;
  }
  write_session(reply, *access_.session(session));
}

void AccessEndpoints::forget(Attempt& attempt) noexcept {
  sodium_memzero(attempt.password.data(), attempt.password.size());
  attempt = {};
}

void AccessEndpoints::use(Users users) {
  constexpr std::string_view who = "./flexrf password";
  for (const User& after : users.list) {
    const User* const before = users_.find(after.name);
    if (before == nullptr) {
      access_.note(who, "set a password for the new user", after.name);
      continue;
    }
    if (before->password_hash != after.password_hash)
      access_.note(who, "set another password for", after.name);
    if (before->role != after.role)
      access_.note(who, "gave another role",
                   after.name + ": " + name_of(before->role) + " -> " + name_of(after.role));
  }
  for (const User& before : users_.list) {
    if (users.find(before.name) == nullptr) access_.note(who, "removed the user", before.name);
    const User* const after = users.find(before.name);
    if (after != nullptr && *after == before) continue;
    access_.end_sessions_of(before.name);
    log_info("panel", "{} {}: sessions of this user end", before.name,
             after == nullptr ? "may log in no longer" : "has another role or password");
  }
  // Whose password is being checked against what is no longer, or was not yet, this user's, is nobody.
  if (checked_ != nullptr) {
    const User* const before = users_.find(text_view(checked_->user));
    const User* const after = users.find(text_view(checked_->user));
    if (before == nullptr || after == nullptr || *before != *after) checked_->user = {};
  }
  users_ = std::move(users);
}

void AccessEndpoints::on_tick(Time now) {
  if (std::optional<Users> users = watch_.update(now)) use(std::move(*users));
  access_.update(now);
  const PasswordCheck::Outcome outcome = check_.update(now);
  if (outcome != PasswordCheck::Outcome::none && checked_ != nullptr) finish(outcome, now);
  start_next(now);
}

Duration AccessEndpoints::until_next(Time) const {
  if (checked_ != nullptr) return poll_of_check;
  const bool is_waiting = std::any_of(attempts_.begin(), attempts_.end(),
                                      [](const Attempt& attempt) { return attempt.order != 0; });
  return is_waiting ? Duration::zero() : poll_of_access;
}

}  // namespace flexrf::panel
