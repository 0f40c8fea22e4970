#include "web-ui/server/access/access_endpoints.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "runtime/log/log.hpp"
#include "tests/cmocka.hpp"
#include "web-ui/server/access/password_helper.hpp"
#include "web-ui/server/access/tests/quick_hash.hpp"

namespace flexrf::panel {
namespace {

Time now;
Time test_clock() {
  return now;
}

/// Keeps the reply of each connection.
struct Connections final : LaterReplies {
  Reply* reply_of(Ticket ticket) override {
    return ticket.connection < 8 ? &replies[ticket.connection] : nullptr;
  }
  void complete(Ticket ticket) override { ++completed[ticket.connection]; }
  std::array<Reply, 8> replies;
  std::array<int, 8> completed{};
};

AuditIntake audit;

/// What was told since the last time, a line each.
std::string told() {
  std::string all;
  AuditRecord record;
  while (audit.take(record)) {
    all +=
        std::string{record.who} + " " + record.did + (record.what[0] == '\0' ? "" : " ") + record.what + "\n";
  }
  return all;
}

struct World {
  explicit World(bool needs_login, const Users& known, const std::string& file = "")
      : users(known),
        watch(file),
        access(settings(needs_login)),
        endpoints(access, limits, users, watch, check, connections, &test_clock) {}
  static AccessSettings settings(bool needs_login) {
    AccessSettings made;
    made.needs_login = needs_login;
    made.audit = &audit;
    return made;
  }
  Users users;
  UserFileWatch watch;
  PanelAccess access;
  LoginLimits limits;
  PasswordCheck check;
  Connections connections;
  AccessEndpoints endpoints;
};
std::optional<World> world;
Users users;
std::string body;
std::string folder;
std::string file;

int begin_group(void**) {
  if (!prepare_cryptography()) return -1;
  const std::string hash = quick_hash("the right one");
  users.list = {{"ann", Role::engineer, hash}, {"bob", Role::viewer, hash}};
  return 0;
}
int begin(void**) {
  now = Time{std::chrono::seconds{1000}};
  world.emplace(true, users);
  return 0;
}
int begin_without_logins(void**) {
  now = Time{std::chrono::seconds{1000}};
  world.emplace(false, Users{});
  return 0;
}
int begin_with_file(void**) {
  now = Time{std::chrono::seconds{1000}};
  char name[] = "/tmp/flexrf-logins-XXXXXX";
  if (mkdtemp(name) == nullptr) return -1;
  folder = name;
  file = folder + "/panel-users";
  if (!write_users(file, users)) return -1;
  world.emplace(true, users, file);
  return 0;
}
int end_with_file(void**) {
  world.reset();
  std::filesystem::remove_all(folder);
  return 0;
}
int end(void**) {
  world.reset();
  return 0;
}

Request request(Method method, const char* path, const char* address = "127.0.0.1") {
  Request made;
  made.method = method;
  made.path = path;
  made.content_type = "application/json; charset=utf-8";
  made.remote_address = address;
  return made;
}

Handled ask_to_log_in(std::uint32_t connection, const char* user, const char* password,
                      const char* address = "127.0.0.1", SessionIndex session = no_session) {
  Request login = request(Method::post, "/api/v1/login", address);
  body = std::string{R"({"user":")"} + user + R"(","password":")" + password + "\"}";
  login.body = body;
  login.session = session;
  world->connections.replies[connection] = {};
  return world->endpoints.handle(login, world->connections.replies[connection], {connection, 0});
}

void wait_for(std::uint32_t connection) {
  const int before = world->connections.completed[connection];
  while (world->connections.completed[connection] == before) {
    world->endpoints.on_tick(now);
    poll(nullptr, 0, 2);
  }
}

/// The status of the answer.
unsigned log_in(const char* user, const char* password, const char* address = "127.0.0.1",
                SessionIndex session = no_session) {
  if (ask_to_log_in(0, user, password, address, session) == Handled::later) wait_for(0);
  return world->connections.replies[0].status;
}

const Reply& reply() {
  return world->connections.replies[0];
}

void the_right_password_makes_a_session(void**) {
  assert_int_equal(log_in("ann", "the right one"), 200);
  assert_string_equal(reply().text.c_str(),
                      R"({"name":"panel-1","role":"engineer","local":true,"user":"ann"})");
  assert_non_null(strstr(reply().set_cookie.c_str(), "HttpOnly; SameSite=Strict"));
  assert_true(world->access.has_role(0, Role::engineer));
  static Reply answer;
  static Request question;
  question = request(Method::get, "/api/v1/session");
  question.session = 0;
  assert_int_equal(world->endpoints.handle(question, answer, {}), Handled::now);
  assert_string_equal(answer.text.c_str(), reply().text.c_str());
}

void wrong_ones_do_not(void**) {
  assert_int_equal(log_in("ann", "the wrong one"), 403);
  static std::string wrong_password;
  wrong_password = reply().text;
  assert_int_equal(log_in("eve", "the right one"), 403);
  assert_string_equal(reply().text.c_str(), wrong_password.c_str());
  assert_int_equal(log_in("", "the right one"), 403);
  assert_int_equal(world->access.session_count(), 0);
  assert_string_equal(reply().set_cookie.c_str(), "");
}

void what_is_no_login_is_refused(void**) {
  static Reply answer;
  static Request bad;
  bad = request(Method::post, "/api/v1/login");
  bad.body = R"({"user":"ann"})";
  assert_int_equal(world->endpoints.handle(bad, answer, {}), Handled::now);
  assert_int_equal(answer.status, 400);
  bad.content_type = "application/x-www-form-urlencoded";
  world->endpoints.handle(bad, answer, {});
  assert_int_equal(answer.status, 415);
  bad.method = Method::get;
  world->endpoints.handle(bad, answer, {});
  assert_int_equal(answer.status, 405);
  bad.path = "/api/v1/other";
  world->endpoints.handle(bad, answer, {});
  assert_int_equal(answer.status, 404);
  bad = request(Method::get, "/api/v1/session");
  world->endpoints.handle(bad, answer, {});
  assert_int_equal(answer.status, 401);
}

void a_new_login_takes_the_place_of_the_former(void**) {
  assert_int_equal(log_in("ann", "the right one"), 200);
  const SessionHandle former = world->access.handle(0);
  assert_int_equal(log_in("bob", "the right one", "127.0.0.1", 0), 200);
  assert_int_equal(world->access.session_count(), 1);
  assert_int_not_equal(world->access.handle(0).serial, former.serial);
  assert_false(world->access.has_role(0, Role::operator_));
}

void logging_out_ends_the_session(void**) {
  assert_int_equal(log_in("ann", "the right one"), 200);
  static Reply answer;
  static Request out;
  out = request(Method::post, "/api/v1/logout");
  out.session = 0;
  assert_int_equal(world->endpoints.handle(out, answer, {}), Handled::now);
  assert_int_equal(answer.status, 204);
  assert_non_null(strstr(answer.set_cookie.c_str(), "Max-Age=0"));
  assert_int_equal(world->access.session_count(), 0);
}

/// By name and address; never with a password, nor with what it became.
void who_comes_and_goes_is_in_the_audit(void**) {
  audit.open();
  told();
  assert_int_equal(log_in("ann", "the wrong one", "10.0.0.5"), 403);
  assert_string_equal(told().c_str(), "somebody (10.0.0.5) did not get in 'ann'\n");
  now += std::chrono::minutes{1};
  assert_int_equal(log_in("ann", "the right one"), 200);
  assert_string_equal(told().c_str(), "ann (127.0.0.1) logged in\n");
  static Reply answer;
  static Request out;
  out = request(Method::post, "/api/v1/logout");
  out.session = 0;
  world->endpoints.handle(out, answer, {});
  assert_string_equal(told().c_str(), "ann (127.0.0.1) logged out\n");
}

void who_is_at_the_machine_comes_first(void**) {
  assert_int_equal(ask_to_log_in(1, "ann", "wrong", "10.0.0.1"), Handled::later);
  assert_int_equal(ask_to_log_in(2, "ann", "wrong", "10.0.0.2"), Handled::later);
  // Half of the places are not for the network.
  assert_int_equal(ask_to_log_in(3, "ann", "wrong", "10.0.0.3"), Handled::now);
  assert_int_equal(world->connections.replies[3].status, 429);
  assert_int_equal(world->connections.replies[3].retry_after, 1);
  assert_int_equal(ask_to_log_in(4, "ann", "the right one"), Handled::later);
  wait_for(4);
  assert_int_equal(world->connections.replies[4].status, 200);
  assert_int_equal(world->connections.completed[1] + world->connections.completed[2], 0);
  wait_for(1);
  wait_for(2);
  assert_int_equal(world->connections.replies[2].status, 403);
}

void a_client_that_is_gone_gets_no_session(void**) {
  Request login = request(Method::post, "/api/v1/login");
  login.body = R"({"user":"ann","password":"the right one"})";
  static Reply answer;
  assert_int_equal(world->endpoints.handle(login, answer, {99, 0}), Handled::later);
  world->endpoints.on_tick(now);
  while (world->check.is_busy()) {
    world->endpoints.on_tick(now);
    poll(nullptr, 0, 2);
  }
  assert_int_equal(world->access.session_count(), 0);
}

void a_thousand_wrong_passwords_lock_nobody_out(void**) {
  unsigned checked = 0;
  unsigned refused = 0;
  char address[32];
  // All within a second, from 250 addresses.
  for (int i = 0; i < 1000; ++i) {
    std::snprintf(address, sizeof(address), "10.0.0.%d", i % 250 + 1);
    const unsigned status = log_in("ann", "guess", address);
    if (status == 403) ++checked;
    if (status == 429) ++refused;
    now += std::chrono::milliseconds{1};
  }
  assert_int_equal(checked + refused, 1000);
  assert_in_range(checked, 1, 12);  // each takes a tenth of a second of a processor
  assert_int_equal(log_in("ann", "the right one"), 200);
  // Even from the same machine it takes no more than two seconds.
  for (int i = 0; i < 1000; ++i) {
    if (log_in("ann", "guess") == 429) ++refused;
  }
  now += LoginLimits::longest_at_machine;
  assert_int_equal(log_in("ann", "the right one"), 200);
}

/// The lines of the log that were not yet looked at.
std::string log_lines() {
  static std::uint64_t seen = 0;
  while (drain_log(-1) > 0) {
  }
  std::string lines;
  seen = visit_recent_log(seen, &lines, [](void* context, std::uint64_t, std::string_view line) {
    static_cast<std::string*>(context)->append(line).append("\n");
  });
  return lines;
}

void who_fails_is_told_without_the_password(void**) {
  static std::string lines;
  static Time log_now;
  // A line a second, and later than all that other tests said.
  log_now = MonotonicClock::now() + std::chrono::hours{1};
  set_log_clock(&log_now);
  log_lines();
  assert_int_equal(log_in("ann", "the wrong one", "10.0.0.7"), 403);
  lines = log_lines();
  assert_non_null(strstr(lines.c_str(), "'ann' from 10.0.0.7 did not get in"));
  assert_null(strstr(lines.c_str(), "the wrong one"));
  log_now += std::chrono::seconds{2};
  assert_int_equal(log_in("ann", "the right one"), 200);
  assert_string_equal(log_lines().c_str(), "");
  // What would move a terminal's cursor or begin a line of its own does neither.
  assert_int_equal(log_in("eve\\n\\u001b[2J'", "the wrong one"), 403);
  lines = log_lines();
  assert_non_null(strstr(lines.c_str(), R"('eve\x0a\x1b[2J\x27' from 127.0.0.1)"));
  log_now += std::chrono::seconds{2};
  assert_int_equal(log_in("a-name-that-is-longer-than-any-user-may-be-called", "the wrong one"), 403);
  lines = log_lines();
  assert_non_null(strstr(lines.c_str(), "'a-name-that-is-longer-than-any-u...' from"));
  // Somebody who does not stop is counted.
  log_now += std::chrono::seconds{2};
  for (int i = 0; i < 3; ++i) assert_int_equal(log_in("ann", "the wrong one", "127.0.0.2"), 403);
  log_now += std::chrono::seconds{2};
  assert_int_equal(log_in("ann", "the wrong one", "127.0.0.2"), 403);
  lines = log_lines();
  assert_int_equal(std::count(lines.begin(), lines.end(), '\n'), 2);
  assert_non_null(strstr(lines.c_str(), "(2 more since)"));
  set_log_clock(nullptr);
}

/// As time goes on until a changed file was seen, and was left alone for a while.
void let_the_file_be_read() {
  for (int i = 0; i < 3; ++i) {
    now += UserFileWatch::interval;
    world->endpoints.on_tick(now);
  }
}

void who_is_removed_or_changed_loses_his_sessions(void**) {
  static Users changed;
  assert_int_equal(log_in("ann", "the right one"), 200);
  assert_int_equal(log_in("bob", "the right one"), 200);
  assert_int_equal(log_in("bob", "the right one"), 200);
  assert_int_equal(world->access.session_count(), 3);
  assert_true(world->access.take(0, now) == AccessControl::Taking::taken);
  let_the_file_be_read();
  assert_int_equal(world->access.session_count(), 3);
  // Removed: his session ends, and control with it; those of others go on.
  changed = users;
  changed.list.erase(changed.list.begin());
  assert_true(write_users(file, changed).is_ok());
  let_the_file_be_read();
  assert_int_equal(world->access.session_count(), 2);
  assert_int_equal(world->access.holder(), no_session);
  assert_int_equal(log_in("ann", "the right one"), 403);
  // Of another role: both of his.
  changed.list[0].role = Role::operator_;
  assert_true(write_users(file, changed).is_ok());
  let_the_file_be_read();
  assert_int_equal(world->access.session_count(), 0);
  assert_int_equal(log_in("bob", "the right one"), 200);
  assert_true(world->access.has_role(0, Role::operator_));
  // A file that cannot be read changes nothing,
  std::ofstream{file} << "bob:king:\n";
  let_the_file_be_read();
  assert_int_equal(world->access.session_count(), 1);
  std::filesystem::remove(file);
  let_the_file_be_read();
  assert_int_equal(world->access.session_count(), 1);
  // but one without users shuts everybody out.
  assert_true(write_users(file, Users{}).is_ok());
  let_the_file_be_read();
  assert_int_equal(world->access.session_count(), 0);
  assert_int_equal(log_in("bob", "the right one"), 403);
}

void a_password_that_was_set_is_in_the_audit_but_not_which(void**) {
  audit.open();
  told();
  static Users changed;
  changed = users;
  changed.list[0].password_hash = quick_hash("quite another one");
  changed.list[1].role = Role::admin;
  changed.list.push_back({"eve", Role::viewer, users.list[0].password_hash});
  assert_true(write_users(file, changed).is_ok());
  let_the_file_be_read();
  const std::string text = told();
  assert_non_null(strstr(text.c_str(), "./flexrf password set another password for ann\n"));
  assert_non_null(strstr(text.c_str(), "./flexrf password gave another role bob: viewer -> admin\n"));
  assert_non_null(strstr(text.c_str(), "./flexrf password set a password for the new user eve\n"));
  assert_null(strstr(text.c_str(), "argon2"));
}

void who_is_removed_while_his_password_is_checked_does_not_get_in(void**) {
  static Users changed;
  assert_int_equal(ask_to_log_in(0, "ann", "the right one"), Handled::later);
  changed = users;
  changed.list.erase(changed.list.begin());
  assert_true(write_users(file, changed).is_ok());
  // Its process is started, and asked only when the file was read.
  world->endpoints.on_tick(now);
  let_the_file_be_read();
  if (world->connections.completed[0] == 0) wait_for(0);
  assert_int_equal(world->connections.replies[0].status, 403);
  assert_int_equal(world->access.session_count(), 0);
}

void without_passwords_nobody_logs_in(void**) {
  assert_int_equal(log_in("ann", "the right one"), 409);
}

}  // namespace
}  // namespace flexrf::panel

int main(int argument_count, char** arguments) {
  using namespace flexrf::panel;
  if (const auto code = run_password_helper(argument_count, arguments)) return *code;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(the_right_password_makes_a_session, begin, end),
      cmocka_unit_test_setup_teardown(wrong_ones_do_not, begin, end),
      cmocka_unit_test_setup_teardown(what_is_no_login_is_refused, begin, end),
      cmocka_unit_test_setup_teardown(a_new_login_takes_the_place_of_the_former, begin, end),
      cmocka_unit_test_setup_teardown(logging_out_ends_the_session, begin, end),
      cmocka_unit_test_setup_teardown(who_is_at_the_machine_comes_first, begin, end),
      cmocka_unit_test_setup_teardown(a_client_that_is_gone_gets_no_session, begin, end),
      cmocka_unit_test_setup_teardown(a_thousand_wrong_passwords_lock_nobody_out, begin, end),
      cmocka_unit_test_setup_teardown(who_fails_is_told_without_the_password, begin, end),
      cmocka_unit_test_setup_teardown(who_comes_and_goes_is_in_the_audit, begin, end),
      cmocka_unit_test_setup_teardown(a_password_that_was_set_is_in_the_audit_but_not_which, begin_with_file,
                                      end_with_file),
      cmocka_unit_test_setup_teardown(who_is_removed_or_changed_loses_his_sessions, begin_with_file,
                                      end_with_file),
      cmocka_unit_test_setup_teardown(who_is_removed_while_his_password_is_checked_does_not_get_in,
                                      begin_with_file, end_with_file),
      cmocka_unit_test_setup_teardown(without_passwords_nobody_logs_in, begin_without_logins, end),
  };
  return cmocka_run_group_tests(tests, begin_group, nullptr);
}
