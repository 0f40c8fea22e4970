#include "web-ui/server/access/panel_access.hpp"

#include <cstring>
#include <optional>
#include <string>

#include "tests/cmocka.hpp"

namespace flexrf::panel::panel_access_test {
namespace {

using Taking = AccessControl::Taking;
using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;

struct Watcher final : AccessWatcher {
  void on_control_changed(SessionIndex, SessionIndex to) override {
    ++control_changes;
    holder = to;
  }
  void on_session_ended(SessionIndex session) override {
    ++ended;
    last_ended = session;
    // Whoever closes connections still wants to know whose they were.
    was_known = access->session(session) != nullptr;
  }
  const PanelAccess* access = nullptr;
  int control_changes = 0;
  int ended = 0;
  SessionIndex holder = no_session;
  SessionIndex last_ended = no_session;
  bool was_known = false;
};

constexpr Time start{seconds{1000}};
std::optional<PanelAccess> access_control;
Watcher watcher;
SessionHandle own;
std::string set_cookie;
std::string cookies;
std::string renewed;

int begin_with(bool needs_login) {
  if (!prepare_cryptography()) return -1;
  AccessSettings settings;
  settings.needs_login = needs_login;
  settings.port = 8081;
  settings.sessions.places = 4;
  settings.token_renewed = [](const OneTimeToken& token) { renewed = token.text(); };
  access_control.emplace(settings);
  watcher = {};
  watcher.access = &*access_control;
  own = {};
  set_cookie.clear();
  cookies.clear();
  access_control->watch(watcher);
  return 0;
}
int begin(void**) {
  return begin_with(false);
}
int begin_with_logins(void**) {
  return begin_with(true);
}

/// A new connection that sends `cookies`.
SessionIndex visit(Time now = start, bool loopback = true) {
  own = {};
  set_cookie.clear();
  return access_control->identify({cookies, loopback ? "127.0.0.1" : "10.0.0.1", loopback}, own, now,
                                  set_cookie);
}
void keep_cookie() {
  cookies = set_cookie.substr(0, set_cookie.find(';'));
}
SessionIndex log_in(const char* user, Role role, SessionHandle former = {}) {
  return access_control->log_in(former, user, role, "10.0.0.1", start, set_cookie);
}

void on_loopback_everybody_is_a_viewer(void**) {
  const SessionIndex session = visit();
  assert_int_equal(access_control->session(session)->role, Role::viewer);
  assert_true(access_control->has_role(session, Role::viewer));
  assert_false(access_control->has_role(session, Role::operator_));
  assert_non_null(strstr(set_cookie.c_str(), "flexrf_visitor_8081="));
  assert_int_equal(access_control->take(session, start), Taking::refused_role);
  assert_int_equal(access_control->take(no_session, start), Taking::refused_role);
  assert_false(access_control->has_role(no_session, Role::viewer));
}

void a_cookie_brings_the_session_back(void**) {
  const SessionIndex session = visit();
  keep_cookie();
  assert_int_equal(visit(), session);
  assert_string_equal(set_cookie.c_str(), "");
  cookies = "flexrf_visitor_8081=" + std::string(32, '0') + "; a=b; " + cookies;
  assert_int_equal(visit(), session);
  assert_int_equal(access_control->session_count(), 1);
}

void a_connection_without_cookies_keeps_its_session(void**) {
  const SessionIndex session = visit();
  for (int i = 0; i < 10; ++i) {
    set_cookie.clear();
    assert_int_equal(access_control->identify({"", "127.0.0.1", true}, own, start, set_cookie), session);
    assert_string_equal(set_cookie.c_str(), "");
  }
  const SessionHandle before = own;
  access_control->log_out(session, set_cookie);
  // Its place may be another's by now.
  assert_int_equal(access_control->identify({"", "127.0.0.1", true}, own, start, set_cookie), session);
  assert_true(own.serial != before.serial);
}

void without_passwords_only_this_machine(void**) {
  assert_int_equal(visit(start, false), no_session);
  assert_non_null(access_control->one_time_token());
}

void with_passwords_nobody_before_logging_in(void**) {
  assert_int_equal(visit(), no_session);
  assert_string_equal(set_cookie.c_str(), "");
  assert_null(access_control->one_time_token());
  const SessionIndex session = log_in("ann", Role::operator_);
  keep_cookie();
  assert_int_equal(visit(start, false), session);
  access_control->log_out(session, set_cookie);
  assert_non_null(strstr(set_cookie.c_str(), "Max-Age=0"));
  assert_int_equal(visit(), no_session);
}

void a_login_ends_the_former_session(void**) {
  const SessionIndex former = visit();
  keep_cookie();
  const SessionIndex session = log_in("ann", Role::engineer, access_control->handle(former));
  assert_int_equal(watcher.ended, 1);
  assert_int_equal(watcher.last_ended, former);
  assert_true(watcher.was_known);
  assert_true(access_control->has_role(session, Role::engineer));
  // Who had planted the former cookie has nothing.
  assert_true(visit() != session);
}

void a_handle_is_not_fooled_by_a_place_used_again(void**) {
  const SessionIndex first = visit();
  const SessionHandle handle = access_control->handle(first);
  access_control->log_out(first, set_cookie);
  const SessionIndex second = visit();
  assert_int_equal(second, first);
  log_in("ann", Role::operator_, handle);
  assert_non_null(access_control->session(second));
}

void a_session_that_ends_gives_up_control(void**) {
  const SessionIndex ann = log_in("ann", Role::operator_);
  assert_int_equal(access_control->take(ann, start), Taking::taken);
  assert_int_equal(watcher.holder, ann);
  access_control->log_out(ann, set_cookie);
  assert_int_equal(access_control->holder(), no_session);
  assert_int_equal(watcher.holder, no_session);
  assert_int_equal(watcher.control_changes, 2);
}

void a_holder_that_is_gone_loses_control(void**) {
  const SessionIndex ann = log_in("ann", Role::operator_);
  access_control->link_opened(ann);
  access_control->take(ann, start);
  access_control->update(start + hours{1});
  assert_int_equal(access_control->holder(), ann);
  access_control->link_closed(ann, start + hours{1});
  access_control->update(start + hours{1} + PanelAccess::absence);
  assert_int_equal(access_control->holder(), ann);
  access_control->update(start + hours{1} + PanelAccess::absence + seconds{1});
  assert_int_equal(access_control->holder(), no_session);
  assert_non_null(access_control->session(ann));
}

void who_asked_and_left_gets_nothing(void**) {
  const SessionIndex ann = log_in("ann", Role::operator_);
  const SessionIndex bob = log_in("bob", Role::operator_);
  access_control->link_opened(ann);
  access_control->take(ann, start);
  assert_int_equal(access_control->take(bob, start), Taking::asked);
  access_control->update(start + PanelAccess::absence + seconds{1});
  assert_int_equal(access_control->holder(), ann);
  assert_int_equal(access_control->wanted_by(), no_session);
}

void a_waiting_session_gets_control_in_time(void**) {
  const SessionIndex ann = log_in("ann", Role::operator_);
  const SessionIndex bob = log_in("bob", Role::operator_);
  access_control->take(ann, start);
  access_control->take(bob, start);
  assert_false(access_control->answer(bob, true, start));
  access_control->update(start + seconds{10});
  assert_int_equal(access_control->holder(), bob);
}

void idle_sessions_end(void**) {
  visit();
  access_control->update(start + hours{13});
  assert_int_equal(access_control->session_count(), 0);
  assert_int_equal(watcher.ended, 1);
}

void room_is_made_but_never_by_the_holder(void**) {
  const SessionIndex ann = log_in("ann", Role::operator_);
  access_control->take(ann, start);
  for (int i = 0; i < 100; ++i) assert_true(visit(start + seconds{i}) != no_session);
  assert_int_equal(access_control->session_count(), 4);
  assert_int_equal(access_control->holder(), ann);
  assert_int_equal(watcher.ended, 97);
  // Open connections make none.
  for (SessionIndex session = 0; session < 4; ++session) access_control->link_opened(session);
  assert_int_equal(visit(start + hours{1}), no_session);
}

void the_one_time_token_is_good_once_and_another_follows(void**) {
  cookies = access_control->one_time_token()->text();
  assert_int_equal(cookies.size(), OneTimeToken::digits);
  assert_false(access_control->use_token(""));
  assert_false(access_control->use_token(cookies.substr(1)));
  cookies[0] = cookies[0] == '0' ? '1' : '0';
  assert_false(access_control->use_token(cookies));
  cookies = access_control->one_time_token()->text();
  assert_true(access_control->use_token(cookies));
  assert_false(access_control->use_token(cookies));
  assert_false(access_control->use_token(
      std::string_view{"\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 32}));
  // Who stands at the machine is told of the next.
  const std::string next{access_control->one_time_token()->text()};
  assert_true(next != cookies);
  assert_string_equal(renewed.c_str(), next.c_str());
  assert_true(access_control->use_token(next));
}

void a_session_that_logged_in_lapses_in_place(void**) {
  const SessionIndex ann = log_in("ann", Role::admin);
  access_control->link_opened(ann);
  access_control->take(ann, start);
  // Whoever acts is there; after an hour without he may have gone.
  access_control->acted(ann, start + minutes{50});
  access_control->update(start + minutes{110});
  assert_false(access_control->session(ann)->lapsed);
  const std::uint64_t revision = access_control->revision();
  access_control->update(start + minutes{110} + seconds{1});
  assert_true(access_control->session(ann)->lapsed);
  assert_true(access_control->revision() > revision);
  assert_int_equal(access_control->holder(), no_session);
  assert_false(access_control->has_role(ann, Role::operator_));
  assert_true(access_control->has_role(ann, Role::viewer));  // sees, and stops motion
  assert_int_equal(watcher.ended, 0);
  access_control->acted(ann, start + minutes{111});
  assert_int_equal(access_control->take(ann, start + minutes{111}), Taking::refused_role);
  // A link that is lost for a moment takes Stop motion from nobody; without a page it ends.
  access_control->link_closed(ann, start + minutes{112});
  access_control->update(start + minutes{112} + seconds{30});
  assert_true(access_control->has_role(ann, Role::viewer));
  access_control->link_opened(ann);
  access_control->update(start + minutes{120});
  assert_int_equal(watcher.ended, 0);
  access_control->link_closed(ann, start + minutes{120});
  access_control->update(start + minutes{120} + seconds{31});
  assert_int_equal(watcher.ended, 1);
}

void a_session_whose_time_ends_while_its_link_is_lost_lapses_when_it_is_back(void**) {
  const SessionIndex ann = log_in("ann", Role::admin);
  access_control->link_opened(ann);
  access_control->link_closed(ann, start + hours{8});
  access_control->update(start + hours{8} + seconds{30});
  access_control->link_opened(ann);
  access_control->update(start + hours{8} + seconds{30});
  assert_true(access_control->session(ann)->lapsed);
  access_control->link_closed(ann, start + hours{8} + seconds{30});
  access_control->update(start + hours{8} + seconds{61});
  assert_null(access_control->session(ann));
}

void eight_hours_are_enough_for_a_password_but_not_for_a_token(void**) {
  const SessionIndex ann = log_in("ann", Role::admin);
  const SessionIndex token = log_in("", Role::admin);
  access_control->link_opened(ann);
  access_control->link_opened(token);
  for (int half_hours = 1; half_hours <= 20; ++half_hours) {
    access_control->acted(ann, start + half_hours * minutes{30});
    access_control->update(start + half_hours * minutes{30});
    assert_int_equal(access_control->session(ann)->lapsed, half_hours > 16);
  }
  access_control->update(start + hours{100});
  assert_true(access_control->has_role(token, Role::admin));
  // Its page is loaded anew, and closed in the end.
  access_control->link_closed(token, start + hours{100});
  access_control->update(start + hours{101});
  assert_true(access_control->has_role(token, Role::admin));
  access_control->update(start + hours{101} + seconds{1});
  assert_null(access_control->session(token));
}

void by_tls_the_cookie_is_this_hosts_alone(void**) {
  AccessSettings settings;
  settings.port = 8443;
  settings.secure = true;
  access_control.emplace(settings);
  visit();
  assert_int_equal(set_cookie.rfind("__Host-flexrf_visitor_8443=", 0), 0);
  log_in("ann", Role::operator_);
  assert_int_equal(set_cookie.rfind("__Host-flexrf_session_8443=", 0), 0);
  assert_non_null(strstr(set_cookie.c_str(), "; Path=/; HttpOnly; SameSite=Strict; Secure"));
}

void changes_show_in_the_revision(void**) {
  const std::uint64_t first = access_control->revision();
  const SessionIndex ann = log_in("ann", Role::operator_);
  const std::uint64_t second = access_control->revision();
  assert_true(second > first);
  access_control->take(ann, start);
  assert_true(access_control->revision() > second);
}

}  // namespace
}  // namespace flexrf::panel::panel_access_test

int main() {
  using namespace flexrf::panel::panel_access_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(on_loopback_everybody_is_a_viewer, begin),
      cmocka_unit_test_setup(a_cookie_brings_the_session_back, begin),
      cmocka_unit_test_setup(a_connection_without_cookies_keeps_its_session, begin),
      cmocka_unit_test_setup(without_passwords_only_this_machine, begin),
      cmocka_unit_test_setup(with_passwords_nobody_before_logging_in, begin_with_logins),
      cmocka_unit_test_setup(a_login_ends_the_former_session, begin),
      cmocka_unit_test_setup(a_handle_is_not_fooled_by_a_place_used_again, begin),
      cmocka_unit_test_setup(a_session_that_ends_gives_up_control, begin),
      cmocka_unit_test_setup(a_holder_that_is_gone_loses_control, begin),
      cmocka_unit_test_setup(who_asked_and_left_gets_nothing, begin),
      cmocka_unit_test_setup(a_waiting_session_gets_control_in_time, begin),
      cmocka_unit_test_setup(idle_sessions_end, begin),
      cmocka_unit_test_setup(room_is_made_but_never_by_the_holder, begin),
      cmocka_unit_test_setup(the_one_time_token_is_good_once_and_another_follows, begin),
      cmocka_unit_test_setup(a_session_that_logged_in_lapses_in_place, begin_with_logins),
      cmocka_unit_test_setup(a_session_whose_time_ends_while_its_link_is_lost_lapses_when_it_is_back,
                             begin_with_logins),
      cmocka_unit_test_setup(eight_hours_are_enough_for_a_password_but_not_for_a_token, begin_with_logins),
      cmocka_unit_test_setup(by_tls_the_cookie_is_this_hosts_alone, begin),
      cmocka_unit_test_setup(changes_show_in_the_revision, begin),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
