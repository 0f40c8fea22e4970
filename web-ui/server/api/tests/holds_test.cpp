// Holds: true while refreshed, ended by each cause, never revived.
#include <atomic>
#include <utility>

#include "runtime/parameters/parameter_store.hpp"
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel::holds_test {
namespace {

using fixture::ProducerAndConsumer;

const json hold{{"op", "hold"}, {"component", "producer"}, {"parameter", "move"}};
constexpr const char* too_late = "the press waited too long";

/// A cell whose producer tells whether it is held, and what became of its holds: on a loaded machine each may
/// end for want of a refresh in time, before anybody saw it.
struct Held {
  ProducerAndConsumer cell;
  std::atomic<bool> moves{false};
  std::atomic<std::uint64_t> begun{0};
  std::atomic<std::uint64_t> ended_early{0};  // although a refresh that had arrived was younger than a lease
  std::atomic<Time> refreshed{Time{}};        // when the newest refresh that was sent was not yet begun

  Held() {
    cell.unit(ProducerAndConsumer::producer).script.step = [this](fixture::TestUnit& unit, const Tick& tick) {
      const bool moved = moves;
      if (unit.runtime.move && !moved) ++begun;
      if (!unit.runtime.move && moved && tick.now < arrived_ + lease_time) ++ended_early;
      moves = unit.runtime.move;
      // What was sent before a step is taken in before the next, and looked at for its end before the one
      // after.
      arrived_ = std::exchange(sent_, refreshed.load());
    };
  }

 private:
  Time arrived_{};
  Time sent_{};
};

/// It runs; an operator has control, and is connected.
struct Operated : Held {
  Rig rig{cell};
  PlayedLink& link;

  Operated() : link(connect()) {}

  /// Holds, and returns the lease. A press that comes too late to its unit is refused; a person presses
  /// again.
  std::string begin() {
    const std::uint64_t before = begun;
    json answer;
    CHECK(rig.wait_until([&] {
      answer = rig.ask(link, hold);
      if (answer.at("ok") == true) return true;
      CHECK_CONTAINS(answer.at("problem").value("reason", ""), too_late);
      return false;
    }));
    CHECK(rig.wait_until([&] { return begun > before; }));
    return answer.at("lease").get<std::string>();
  }
  /// So often that requests which nobody takes in for as long as a lease lasts still find room.
  void refresh(const std::string& lease) {
    const Time now = MonotonicClock::now();
    if (now < refreshed.load() + 2 * lease_time / RequestQueue::capacity) return;
    rig.send(link, {{"op", "refresh"}, {"id", 1'000'000}, {"lease", lease}});
    refreshed = now;
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
  std::string lease;
  // Until one was held for long enough: those before had to end, as somebody was kept from his work for
  // longer than a lease.
  for (Time until{}; MonotonicClock::now() < until || !held.moves;) {
    if (!held.moves) {
      lease = held.begin();
      until = MonotonicClock::now() + std::chrono::milliseconds{600};
    }
    CHECK(rig.wait_until([&] {
      held.refresh(lease);
      return !held.moves || MonotonicClock::now() > until;
    }));
    CHECK_EQUAL(held.ended_early.load(), 0U);
  }
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
  // The thread that moves something sees the stop first.
  CHECK(rig.wait_until([&] { return rig.ask(link, {{"op", "start_motion"}}).at("ok") == true; }));
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
  // The thread that moves something sees the stop first.
  CHECK(
      rig.wait_until([&] { return rig.request(Method::post, "start-motion", an_operator).status == 200U; }));
}

}  // namespace
}  // namespace flexrf::panel::holds_test

int main() {
  using namespace flexrf::panel::holds_test;
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
