// Holds: true while refreshed, ended by each cause, never revived.
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel {
namespace {

using fixture::ProducerAndConsumer;

const json hold{{"op", "hold"}, {"component", "producer"}, {"parameter", "move"}};

/// A cell whose producer tells whether it is held.
struct Held {
  ProducerAndConsumer cell;
  std::atomic<bool> moves{false};
  Held() {
    cell.unit(ProducerAndConsumer::producer).script.step = [this](fixture::TestUnit& unit, const Tick&) {
      moves = unit.runtime.move;
    };
  }
};

/// It runs; an operator has control, and is connected.
struct Operated : Held {
  Rig rig{cell};
  PlayedLink& link;

  Operated() : link(connect()) {}

  /// Holds, and returns the lease.
  std::string begin() {
    const json answer = rig.ask(link, hold);
    if (answer.at("ok") != true) throw fixture::CheckFailed{answer.dump()};
    CHECK(rig.wait_until([&] { return moves.load(); }));
    return answer.at("lease").get<std::string>();
  }
  void refresh(const std::string& lease) {
    rig.send(link, {{"op", "refresh"}, {"id", 1'000'000}, {"lease", lease}});
  }
  /// Refreshes until the hold is over in spite of it.
  void check_ends(const std::string& lease) {
    CHECK(rig.wait_until([&] {
      if (link.closed == 0) refresh(lease);
      return !moves.load();
    }));
  }

 private:
  PlayedLink& connect() {
    rig.start();
    rig.access().give(an_operator);
    return rig.connect(an_operator);
  }
};

/// By its release, not with its lease: what was asked before this request is in force when it is answered.
void check_is_released(Rig& rig, PlayedLink& link) {
  const json answer = rig.ask(link, {{"op", "set"}, {"component", "producer"}, {"values", {{"gain", 2}}}});
  CHECK(answer.at("ok") == true);
  CHECK(answer.at("values").at("move") == false);
}

void a_hold_lives_while_it_is_refreshed() {
  Operated held;
  Rig& rig = held.rig;
  PlayedLink& link = held.link;
  const std::string lease = held.begin();
  link.texts.clear();
  const Time until = MonotonicClock::now() + std::chrono::milliseconds{600};
  CHECK(rig.wait_until([&] {
    held.refresh(lease);
    return MonotonicClock::now() > until;
  }));
  CHECK(held.moves);
  // Nobody refreshes: the runtime ends it, and no refresh revives it.
  CHECK(rig.wait_until([&] { return !held.moves.load(); }));
  link.texts.clear();
  const json late = rig.ask(link, {{"op", "refresh"}, {"lease", lease}});
  CHECK(late.at("ok") == false);
  CHECK(!held.moves);
  CHECK_EQUAL(rig.ask(link, {{"op", "refresh"}, {"lease", lease}}).at("problem").at("status").get<int>(),
              409);
}

void a_release_ends_it() {
  Operated held;
  Rig& rig = held.rig;
  PlayedLink& link = held.link;
  const std::string lease = held.begin();
  CHECK(rig.ask(link, {{"op", "release"}, {"lease", lease}}).at("ok") == true);
  check_is_released(rig, link);
  held.check_ends(lease);
  const std::string second = held.begin();
  CHECK(second != lease);
}

void a_lost_connection_ends_it() {
  Operated held;
  Rig& rig = held.rig;
  PlayedLink& link = held.link;
  const std::string lease = held.begin();
  rig.disconnect(link);
  PlayedLink& next = rig.connect(an_operator);
  check_is_released(rig, next);
  // Not even from the same place with the same number.
  CHECK(rig.ask(next, {{"op", "refresh"}, {"lease", lease}}).at("ok") == false);
  CHECK(rig.wait_until([&] { return !held.moves.load(); }));
}

void lost_control_ends_it() {
  Operated held;
  Rig& rig = held.rig;
  PlayedLink& link = held.link;
  PlayedLink& other = rig.connect(an_engineer);
  const std::string lease = held.begin();
  const json asked = rig.ask(other, {{"op", "take_control"}});
  CHECK(asked.at("ok") == true && asked.at("taken") == false);
  CHECK(rig.ask(link, {{"op", "answer_control"}, {"grant", true}}).at("ok") == true);
  check_is_released(rig, other);
  held.check_ends(lease);
  CHECK_EQUAL(rig.ask(link, hold).at("problem").at("type").get<std::string>(), "/problems/control-missing");
}

void an_ended_session_ends_it() {
  Operated held;
  Rig& rig = held.rig;
  PlayedLink& link = held.link;
  const std::string lease = held.begin();
  rig.access().end(an_operator);
  CHECK_EQUAL(link.closed, 1008);
  held.check_ends(lease);
}

void stop_motion_ends_it_whoever_gives_it() {
  Operated held;
  Rig& rig = held.rig;
  PlayedLink& link = held.link;
  PlayedLink& watcher = rig.connect(a_viewer);
  const std::string lease = held.begin();
  rig.send(watcher, {{"op", "stop_motion"}, {"id", 1}});
  CHECK(rig.executive().control().motion_stopped());
  held.check_ends(lease);
  CHECK(rig.ask(link, hold).at("ok") == false);
  // Clearing and Start are the holder's, and two acts.
  CHECK(rig.ask(watcher, {{"op", "clear_stop_motion"}}).at("ok") == false);
  CHECK(rig.ask(link, {{"op", "start_motion"}}).at("ok") == false);
  CHECK(rig.ask(link, {{"op", "clear_stop_motion"}}).at("ok") == true);
  CHECK(!rig.executive().control().may_move());
  CHECK(rig.ask(link, {{"op", "start_motion"}}).at("ok") == true);
  CHECK(rig.executive().control().may_move());
  CHECK(rig.ask(link, {{"op", "refresh"}, {"lease", lease}}).at("ok") == false);
  CHECK(rig.wait_until([&] { return rig.ask(link, hold).at("ok") == true; }));
}

void stop_motion_by_rest_needs_no_body_and_no_token() {
  Held held;
  Rig rig(held.cell);
  rig.start();
  CHECK_EQUAL(rig.request(Method::post, "stop-motion", a_viewer).status, 200U);
  CHECK(rig.executive().control().motion_stopped());
  CHECK_EQUAL(rig.request(Method::post, "clear-stop-motion", an_engineer).status, 403U);
  rig.access().give(an_operator);
  CHECK_EQUAL(rig.request(Method::post, "start-motion", an_operator).status, 409U);
  CHECK_EQUAL(rig.request(Method::post, "clear-stop-motion", an_operator).status, 200U);
  CHECK_EQUAL(rig.request(Method::post, "start-motion", an_operator).status, 200U);
}

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_hold_lives_while_it_is_refreshed),
      CONTAINED_TEST(a_release_ends_it),
      CONTAINED_TEST(a_lost_connection_ends_it),
      CONTAINED_TEST(lost_control_ends_it),
      CONTAINED_TEST(an_ended_session_ends_it),
      CONTAINED_TEST(stop_motion_ends_it_whoever_gives_it),
      CONTAINED_TEST(stop_motion_by_rest_needs_no_body_and_no_token),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
