#include "web-ui/server/access/session_table.hpp"

#include <optional>
#include <string>

#include "tests/cmocka.hpp"
#include "web-ui/server/access/panel_access.hpp"

namespace flexrf::panel::session_table_test {
namespace {

using std::chrono::hours;
using std::chrono::seconds;

constexpr Time start{seconds{1000}};
std::optional<SessionTable> table;
std::string text;  // of a test; outlives a failing assertion

int begin(void**) {
  if (!prepare_cryptography()) return -1;
  SessionLimits limits;
  limits.places = 3;
  table.emplace(limits, std::vector<Address>{*Address::parse("192.168.0.7"), *Address::parse("fe80::1")});
  return 0;
}

SessionIndex viewer(Time now = start) {
  return table->begin("", Role::viewer, "10.0.0.1", now);
}

bool is_same(std::string_view one, const char* other) {
  return one == other;
}

void a_session_is_found_by_its_cookie(void**) {
  const SessionIndex one = table->begin("ann", Role::operator_, "10.0.0.1", start);
  const SessionIndex other = viewer();
  assert_int_equal(table->cookie(one).size(), SessionTable::cookie_digits);
  assert_int_equal(table->find(table->cookie(one)), one);
  assert_int_equal(table->find(table->cookie(other)), other);
  assert_true(is_same(table->info(one)->user, "ann"));
  assert_true(is_same(table->info(one)->name, "panel-1"));
  assert_true(is_same(table->info(one)->address, "10.0.0.1"));
  assert_int_equal(table->info(one)->role, Role::operator_);
}

void other_cookies_find_nothing(void**) {
  text = table->cookie(viewer());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char digit = text[i];
    text[i] = digit == '0' ? '1' : '0';
    assert_int_equal(table->find(text), no_session);
    text[i] = digit;
  }
  assert_int_equal(table->find(text.substr(1)), no_session);
  assert_int_equal(table->find(text + "0"), no_session);
  assert_int_equal(table->find(""), no_session);
  assert_int_equal(table->find("00000000000000000000000000000000"), no_session);
  assert_int_equal(table->find("gggggggggggggggggggggggggggggggg"), no_session);
  table->end(0);
  assert_int_equal(table->find(text), no_session);
  assert_int_equal(table->find("00000000000000000000000000000000"), no_session);
}

void a_place_used_again_is_another_session(void**) {
  const SessionIndex session = viewer();
  text = table->cookie(session);
  const std::uint32_t serial = table->serial(session);
  table->end(session);
  assert_int_equal(table->serial(session), 0);
  assert_null(table->info(session));
  assert_int_equal(viewer(), session);
  assert_true(table->serial(session) != serial);
  assert_true(table->cookie(session) != text);
}

void places_are_bounded(void**) {
  for (int i = 0; i < 3; ++i) assert_true(viewer() != no_session);
  assert_true(table->is_full());
  assert_int_equal(viewer(), no_session);
  table->end(1);
  table->end(1);
  table->end(no_session);
  assert_int_equal(table->count(), 2);
  assert_int_equal(viewer(), 1);
}

void the_viewer_used_longest_ago_makes_room(void**) {
  const SessionIndex engineer = table->begin("eve", Role::engineer, "10.0.0.1", start);
  const SessionIndex first = viewer(start + seconds{1});
  const SessionIndex second = viewer(start + seconds{2});
  assert_int_equal(table->dispensable(no_session), first);
  table->touch(first, "10.0.0.1", start + seconds{3});
  assert_int_equal(table->dispensable(no_session), second);
  assert_int_equal(table->dispensable(second), first);
  table->link_opened(second);
  table->link_opened(first);
  // No viewer is idle: whoever is.
  assert_int_equal(table->dispensable(no_session), engineer);
  assert_int_equal(table->dispensable(engineer), no_session);
  table->link_closed(first, start + seconds{4});
  assert_int_equal(table->dispensable(no_session), first);
}

void idle_sessions_expire_linked_ones_do_not(void**) {
  const SessionIndex idle = viewer();
  const SessionIndex linked = viewer();
  table->link_opened(linked);
  assert_int_equal(table->expired(start + hours{1}), no_session);
  assert_int_equal(table->expired(start + hours{1} + seconds{1}), idle);
  table->end(idle);
  assert_int_equal(table->expired(start + hours{100}), no_session);
  assert_int_equal(table->lapsing(start + hours{100}), no_session);  // it never logged in
  const SessionIndex ann = table->begin("ann", Role::operator_, "10.0.0.1", start);
  table->touch(ann, "10.0.0.1", start + hours{8});
  assert_int_equal(table->expired(start + hours{8}), no_session);
  assert_int_equal(table->expired(start + hours{8} + seconds{1}), ann);
}

void presence(void**) {
  const SessionIndex session = viewer();
  assert_true(table->is_present(session, seconds{15}, start + seconds{15}));
  assert_false(table->is_present(session, seconds{15}, start + seconds{16}));
  table->link_opened(session);
  assert_true(table->is_present(session, seconds{15}, start + hours{1}));
  table->link_closed(session, start + hours{1});
  table->link_closed(session, start + hours{9});  // there is none any more
  assert_true(table->is_present(session, seconds{15}, start + hours{1} + seconds{15}));
  assert_false(table->is_present(session, seconds{15}, start + hours{1} + seconds{16}));
  assert_false(table->is_present(no_session, seconds{15}, start));
}

void local_is_what_the_table_says(void**) {
  for (const char* address : {"192.168.0.7", "::ffff:192.168.0.7", "fe80::1%eth1", "127.0.0.1", "::1"})
    assert_true(table->is_local(address));
  for (const char* address : {"192.168.0.8", "fe80::2", "", "x"}) assert_false(table->is_local(address));
  // A tunnel or a proxy ends at loopback.
  table.emplace(SessionLimits{}, std::vector<Address>{*Address::parse("192.168.0.7")}, false);
  assert_true(table->is_local("192.168.0.7"));
  assert_false(table->is_local("127.0.0.1"));
  assert_false(table->is_local("::1"));
  const SessionIndex session = viewer();
  assert_false(table->info(session)->local);
  table->touch(session, "192.168.0.7", start);
  assert_true(table->info(session)->local);
  assert_true(is_same(table->info(session)->address, "192.168.0.7"));
}

void long_texts_are_cut(void**) {
  text.assign(200, 'x');
  const SessionIndex session = table->begin(text, Role::viewer, text, start);
  assert_int_equal(table->info(session)->user.size(), 32);
  assert_int_equal(table->info(session)->address.size(), 48);
}

}  // namespace
}  // namespace flexrf::panel::session_table_test

int main() {
  using namespace flexrf::panel::session_table_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_session_is_found_by_its_cookie, begin),
      cmocka_unit_test_setup(other_cookies_find_nothing, begin),
      cmocka_unit_test_setup(a_place_used_again_is_another_session, begin),
      cmocka_unit_test_setup(places_are_bounded, begin),
      cmocka_unit_test_setup(the_viewer_used_longest_ago_makes_room, begin),
      cmocka_unit_test_setup(idle_sessions_expire_linked_ones_do_not, begin),
      cmocka_unit_test_setup(presence, begin),
      cmocka_unit_test_setup(local_is_what_the_table_says, begin),
      cmocka_unit_test_setup(long_texts_are_cut, begin),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
