#include "web-ui/server/access/entrance.hpp"

#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "tests/cmocka.hpp"

namespace flexrf::panel::entrance_test {
namespace {

constexpr std::uint32_t places = 4;
Time now;
Time test_clock() {
  return now;
}

struct World {
  explicit World(bool needs_login)
      : access(settings(needs_login)),
        rules(false, {"cell7"}),
        entrance(access, limits, rules, places, &test_clock) {}
  static AccessSettings settings(bool needs_login) {
    AccessSettings made;
    made.needs_login = needs_login;
    return made;
  }
  PanelAccess access;
  LoginLimits limits;
  HostRules rules;
  Entrance entrance;
};
std::optional<World> world;
Request request;
Reply reply;
SessionIndex session;
std::string query;
std::string cookie;

int begin_with(bool needs_login) {
  if (!prepare_cryptography()) return -1;
  now = Time{std::chrono::seconds{1000}};
  world.emplace(needs_login);
  request = {};
  request.path = "/";
  request.host = "localhost:8080";
  request.remote_address = "127.0.0.1";
  request.local_end = *Address::parse("127.0.0.1");
  request.loopback = true;
  cookie.clear();
  return 0;
}
int begin(void**) {
  return begin_with(false);
}
int begin_with_logins(void**) {
  return begin_with(true);
}

bool admit() {
  reply = {};
  request.cookie = cookie;
  return world->entrance.admit(request, session, reply);
}
/// The status of the refusal; 0: admitted.
unsigned refusal() {
  return admit() ? 0 : reply.status;
}
unsigned refusal_of(Method method, const char* path) {
  request.method = method;
  request.path = path;
  return refusal();
}
void keep_cookie() {
  cookie = reply.set_cookie.substr(0, reply.set_cookie.find(';'));
}

void a_visitor_on_loopback_is_a_viewer(void**) {
  assert_true(admit());
  assert_true(world->access.has_role(session, Role::viewer));
  assert_true(reply.set_cookie.size() > 0);
  const SessionIndex first = session;
  assert_true(admit());  // the same connection, without a cookie
  assert_int_equal(session, first);
  world->entrance.on_connection_closed(0);
  assert_true(admit());
  assert_int_not_equal(session, first);
}

void a_foreign_host_is_misdirected(void**) {
  request.host = "evil.example";
  assert_int_equal(refusal(), 421);
  assert_int_equal(session, no_session);
  assert_string_equal(reply.set_cookie.c_str(), "");
  assert_non_null(strstr(reply.text.c_str(), "not called evil.example"));
  request.host = "cell7:8080";
  assert_int_equal(refusal(), 0);
}

void changes_and_upgrades_need_our_own_page(void**) {
  request.origin = "http://localhost:3000";
  assert_int_equal(refusal_of(Method::get, "/api/v1/state"), 0);
  for (const Method method : {Method::put, Method::post, Method::other})
    assert_int_equal(refusal_of(method, "/api/v1/stop-motion"), 403);
  request.upgrade = true;
  assert_int_equal(refusal_of(Method::get, "/api/v1/live"), 403);
  request.origin = "http://localhost:8080";
  assert_int_equal(refusal_of(Method::get, "/api/v1/live"), 0);
  request.upgrade = false;
  assert_int_equal(refusal_of(Method::post, "/api/v1/stop-motion"), 0);
  request.origin = {};
  assert_int_equal(refusal_of(Method::post, "/api/v1/stop-motion"), 0);  // a script
  request.has_fetch_site = true;
  assert_int_equal(refusal_of(Method::post, "/api/v1/stop-motion"), 403);
}

void the_token_makes_an_admin_once(void**) {
  query = "x=1&token=" + std::string{world->access.one_time_token()->text()};
  request.query = query;
  assert_int_equal(refusal(), 303);
  assert_true(reply.location == "/");
  keep_cookie();
  // Its browser may open the address again.
  assert_int_equal(refusal(), 303);
  assert_true(world->access.has_role(session, Role::admin));
  request.query = {};
  assert_int_equal(refusal(), 0);
  assert_true(world->access.has_role(session, Role::admin));
  // Nobody else may.
  cookie.clear();
  request.query = query;
  request.place = 1;
  assert_int_equal(refusal(), 403);
  assert_false(world->access.has_role(session, Role::operator_));
}

/// What a browser keeps: of each name the newest.
struct CookieJar {
  std::map<std::string, std::string> values;
  void keep(const std::string& set_cookie) {
    if (set_cookie.empty()) return;
    const std::size_t equals = set_cookie.find('=');
    values[set_cookie.substr(0, equals)] = set_cookie.substr(equals + 1, set_cookie.find(';') - equals - 1);
  }
  std::string header() const {
    std::string text;
    for (const auto& [name, value] : values)
      text.append(text.empty() ? "" : "; ").append(name).append("=").append(value);
    return text;
  }
};

void what_was_asked_before_the_token_does_not_take_its_session_away(void**) {
  CookieJar jar;
  assert_int_equal(refusal_of(Method::get, "/"), 0);
  jar.keep(reply.set_cookie);
  const std::string before = jar.header();
  cookie = before;
  query = "token=" + std::string{world->access.one_time_token()->text()};
  request.query = query;
  request.place = 1;
  assert_int_equal(refusal(), 303);
  jar.keep(reply.set_cookie);
  request.query = {};
  // Each on a connection of its own, sent by the first page: file, question, live connection.
  for (const auto& [path, upgrade] :
       {std::pair{"/assets/index-1234.js", false}, {"/api/v1/session", false}, {"/api/v1/live", true}}) {
    cookie = before;
    world->entrance.on_connection_closed(2);
    request.place = 2;
    request.upgrade = upgrade;
    assert_int_equal(refusal_of(Method::get, path), 0);
    assert_false(world->access.has_role(session, Role::operator_));  // whoever knew the old one has nothing
    jar.keep(reply.set_cookie);
  }
  request.upgrade = false;
  cookie = jar.header();
  request.place = 3;
  assert_int_equal(refusal_of(Method::get, "/api/v1/session"), 0);
  assert_true(world->access.has_role(session, Role::admin));
  assert_string_equal(reply.set_cookie.c_str(), "");
}

void only_a_get_uses_the_token_up(void**) {
  query = "token=" + std::string{world->access.one_time_token()->text()};
  request.query = query;
  assert_int_equal(refusal_of(Method::head, "/"), 0);
  assert_int_equal(refusal_of(Method::get, "/api/v1/state"), 0);
  assert_int_equal(refusal_of(Method::get, "/"), 303);
}

void the_token_is_for_this_machine(void**) {
  query = "token=" + std::string{world->access.one_time_token()->text()};
  request.query = query;
  request.loopback = false;
  request.remote_address = "10.0.0.9";
  assert_int_equal(refusal(), 403);
  assert_int_equal(world->access.one_time_token()->text().size(), OneTimeToken::digits);
}

void wrong_tokens_count_as_failed_logins(void**) {
  request.query = "token=00000000000000000000000000000000";
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    if (refusal() == 429) ++refused;
  }
  assert_int_equal(refused, 996);
  assert_int_equal(reply.retry_after, 1);
  // The right one is not kept waiting.
  query = "token=" + std::string{world->access.one_time_token()->text()};
  request.query = query;
  assert_int_equal(refusal(), 303);
}

void before_logging_in_there_is_only_the_page(void**) {
  assert_int_equal(refusal_of(Method::get, "/"), 0);
  assert_int_equal(session, no_session);
  assert_int_equal(refusal_of(Method::get, "/assets/index-1234.js"), 0);
  assert_int_equal(refusal_of(Method::post, "/api/v1/login"), 0);
  for (const char* path :
       {"/api/v1/session", "/api/v1/state", "/api/v1/live", "/api/v1/descriptor", "/application/arm.urdf",
        "/api/v1/loginx", "/api/v1/openapi.json", "/api/v1/healthy"})
    assert_int_equal(refusal_of(Method::get, path), 401);
  assert_int_equal(refusal_of(Method::post, "/api/v1/stop-motion"), 401);
}

void this_machine_asks_for_health_without_a_login(void**) {
  assert_int_equal(refusal_of(Method::get, "/api/v1/health"), 0);
  assert_int_equal(session, no_session);
  request.loopback = false;
  request.remote_address = "10.0.0.9";
  assert_int_equal(refusal_of(Method::get, "/api/v1/health"), 401);
}

void after_it_the_cookie_opens(void**) {
  assert_int_not_equal(world->access.log_in({}, "ann", Role::operator_, "127.0.0.1", now, reply.set_cookie),
                       no_session);
  keep_cookie();
  request.loopback = false;
  request.remote_address = "10.0.0.9";
  assert_int_equal(refusal_of(Method::get, "/api/v1/state"), 0);
  assert_true(world->access.has_role(session, Role::operator_));
}

void without_passwords_others_see_nothing(void**) {
  request.loopback = false;
  request.remote_address = "10.0.0.9";
  assert_int_equal(refusal_of(Method::get, "/api/v1/state"), 403);
}

}  // namespace
}  // namespace flexrf::panel::entrance_test

int main() {
  using namespace flexrf::panel::entrance_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_visitor_on_loopback_is_a_viewer, begin),
      cmocka_unit_test_setup(a_foreign_host_is_misdirected, begin),
      cmocka_unit_test_setup(changes_and_upgrades_need_our_own_page, begin),
      cmocka_unit_test_setup(the_token_makes_an_admin_once, begin),
      cmocka_unit_test_setup(what_was_asked_before_the_token_does_not_take_its_session_away, begin),
      cmocka_unit_test_setup(only_a_get_uses_the_token_up, begin),
      cmocka_unit_test_setup(the_token_is_for_this_machine, begin),
      cmocka_unit_test_setup(wrong_tokens_count_as_failed_logins, begin),
      cmocka_unit_test_setup(before_logging_in_there_is_only_the_page, begin_with_logins),
      cmocka_unit_test_setup(this_machine_asks_for_health_without_a_login, begin_with_logins),
      cmocka_unit_test_setup(after_it_the_cookie_opens, begin_with_logins),
      cmocka_unit_test_setup(without_passwords_others_see_nothing, begin),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
