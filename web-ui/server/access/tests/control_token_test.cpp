#include "web-ui/server/access/control_token.hpp"

#include <optional>

#include "tests/cmocka.hpp"

namespace flexrf::panel::control_token_test {
namespace {

using Taking = ControlToken::Taking;
using std::chrono::milliseconds;
using std::chrono::seconds;

struct Watcher final : AccessWatcher {
  void on_control_changed(SessionIndex from, SessionIndex to) override {
    ++changes;
    last_from = from;
    last_to = to;
  }
  void on_session_ended(SessionIndex) override {}
  int changes = 0;
  SessionIndex last_from = no_session;
  SessionIndex last_to = no_session;
};

std::optional<ControlToken> token;
Watcher watcher;
constexpr Time start{seconds{1000}};

constexpr ControlToken::Asker remote(SessionIndex session) {
  return {session, true, false};
}
constexpr ControlToken::Asker local(SessionIndex session) {
  return {session, true, true};
}

int begin(void**) {
  token.emplace();
  watcher = {};
  token->watch(watcher);
  return 0;
}

void a_free_token_is_taken_by_operators(void**) {
  assert_int_equal(token->take({1, false, true}, start), Taking::refused_role);
  assert_int_equal(token->holder(), no_session);
  assert_int_equal(token->take(remote(1), start), Taking::taken);
  assert_int_equal(token->holder(), 1);
  assert_int_equal(watcher.changes, 1);
  assert_int_equal(watcher.last_from, no_session);
  assert_int_equal(watcher.last_to, 1);
  assert_int_equal(token->take(remote(1), start), Taking::taken);
  assert_int_equal(watcher.changes, 1);
}

void no_answer_is_consent_after_ten_seconds(void**) {
  assert_int_equal(token->take(remote(1), start), Taking::taken);
  assert_int_equal(token->take(remote(2), start), Taking::asked);
  assert_int_equal(token->wanted_by(), 2);
  assert_int_equal(token->answer_within(start + seconds{3}).count(), Duration{seconds{7}}.count());
  // Asking again changes nothing.
  assert_int_equal(token->take(remote(2), start + seconds{5}), Taking::asked);
  token->update(start + seconds{10} - milliseconds{1}, true);
  assert_int_equal(token->holder(), 1);
  token->update(start + seconds{10}, true);
  assert_int_equal(token->holder(), 2);
  assert_int_equal(token->wanted_by(), no_session);
  assert_int_equal(watcher.last_from, 1);
  assert_int_equal(watcher.last_to, 2);
  assert_int_equal(token->answer_within(start).count(), 0);
}

void the_holder_grants_or_refuses(void**) {
  assert_int_equal(token->take(remote(1), start), Taking::taken);
  assert_false(token->answer(1, true));
  assert_int_equal(token->take(remote(2), start), Taking::asked);
  assert_false(token->answer(2, true));
  assert_false(token->answer(3, true));
  assert_false(token->answer(no_session, true));
  assert_true(token->answer(1, false));
  assert_int_equal(token->wanted_by(), no_session);
  token->update(start + seconds{60}, true);
  assert_int_equal(token->holder(), 1);
  assert_int_equal(token->take(remote(2), start), Taking::asked);
  assert_true(token->answer(1, true));
  assert_int_equal(token->holder(), 2);
}

void one_asks_at_a_time(void**) {
  assert_int_equal(token->take(remote(1), start), Taking::taken);
  assert_int_equal(token->take(remote(2), start), Taking::asked);
  assert_int_equal(token->take(remote(3), start), Taking::refused_asked);
  assert_int_equal(token->wanted_by(), 2);
  // Whoever stands beside the machine does not wait for who is afar, whoever else asked there.
  assert_int_equal(token->take(local(4), start + seconds{5}), Taking::taken);
  assert_int_equal(token->holder(), 4);
  assert_int_equal(watcher.last_from, 1);
  assert_int_equal(token->wanted_by(), no_session);
  // He asks who stands there, too.
  assert_int_equal(token->take(local(5), start + seconds{5}), Taking::asked);
  assert_int_equal(token->take(local(6), start + seconds{5}), Taking::refused_asked);
  token->update(start + seconds{15}, true);
  assert_int_equal(token->holder(), 5);
}

void silence_of_who_cannot_see_the_question_is_no_answer(void**) {
  assert_int_equal(token->take(remote(1), start), Taking::taken);
  assert_int_equal(token->take(remote(2), start), Taking::asked);
  token->update(start + seconds{9}, false);
  token->update(start + seconds{14}, false);
  assert_int_equal(token->holder(), 1);
  // He is back, and has all the time there is.
  assert_int_equal(token->answer_within(start + seconds{14}).count(), Duration{seconds{10}}.count());
  token->update(start + seconds{23}, true);
  assert_int_equal(token->holder(), 1);
  token->update(start + seconds{24}, true);
  assert_int_equal(token->holder(), 2);
}

void a_local_holder_cannot_be_displaced_from_afar(void**) {
  assert_int_equal(token->take(local(1), start), Taking::taken);
  assert_int_equal(token->take(remote(2), start), Taking::refused_local);
  assert_int_equal(token->wanted_by(), no_session);
  assert_int_equal(token->take(local(3), start), Taking::asked);
  token->update(start + seconds{10}, true);
  assert_int_equal(token->holder(), 3);
  // What he gives back is free for all.
  token->release(3);
  assert_int_equal(token->take(remote(2), start), Taking::taken);
}

void what_is_released_goes_to_who_waits(void**) {
  assert_int_equal(token->take(remote(1), start), Taking::taken);
  assert_int_equal(token->take(remote(2), start), Taking::asked);
  token->release(3);
  token->release(no_session);
  assert_int_equal(token->holder(), 1);
  token->release(1);
  assert_int_equal(token->holder(), 2);
  assert_int_equal(token->wanted_by(), no_session);
  token->release(2);
  assert_int_equal(token->holder(), no_session);
  assert_int_equal(watcher.changes, 3);
}

void who_asked_and_left_does_not_get_it(void**) {
  assert_int_equal(token->take(remote(1), start), Taking::taken);
  assert_int_equal(token->take(remote(2), start), Taking::asked);
  token->release(2);
  token->update(start + seconds{60}, true);
  assert_int_equal(token->holder(), 1);
  assert_int_equal(watcher.changes, 1);
}

void every_change_shows_in_the_revision(void**) {
  std::uint64_t last = token->revision();
  const auto has_risen = [&last] {
    const bool risen = token->revision() > last;
    last = token->revision();
    return risen;
  };
  token->take(remote(1), start);
  assert_true(has_risen());
  token->take(remote(2), start);
  assert_true(has_risen());
  token->take(remote(2), start);
  assert_false(has_risen());
  assert_true(token->answer(1, false));
  assert_true(has_risen());
  token->release(1);
  assert_true(has_risen());
  token->update(start + seconds{60}, true);
  assert_false(has_risen());
}

}  // namespace
}  // namespace flexrf::panel::control_token_test

int main() {
  using namespace flexrf::panel::control_token_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_free_token_is_taken_by_operators, begin),
      cmocka_unit_test_setup(no_answer_is_consent_after_ten_seconds, begin),
      cmocka_unit_test_setup(the_holder_grants_or_refuses, begin),
      cmocka_unit_test_setup(one_asks_at_a_time, begin),
      cmocka_unit_test_setup(a_local_holder_cannot_be_displaced_from_afar, begin),
      cmocka_unit_test_setup(what_is_released_goes_to_who_waits, begin),
      cmocka_unit_test_setup(who_asked_and_left_does_not_get_it, begin),
      cmocka_unit_test_setup(every_change_shows_in_the_revision, begin),
      cmocka_unit_test_setup(silence_of_who_cannot_see_the_question_is_no_answer, begin),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
