// The live connection: greeting, state, topics, frames of values, clients that are slow or hostile.
#include <cstring>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/log/log.hpp"
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel::live_test {
namespace {

using fixture::ProducerAndConsumer;

template <class Value>
Value at(const std::string& bytes, std::size_t offset) {
  if (offset + sizeof(Value) > bytes.size()) throw fixture::CheckFailed{"a frame is too short"};
  Value value{};
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

std::uint32_t items(const std::string& frame) {
  return at<std::uint32_t>(frame, 16);
}

json subscribe(const json& slots, const json& topics = json::array()) {
  return {{"op", "subscribe"}, {"slots", slots}, {"topics", topics}};
}

void a_page_is_greeted_and_told_the_state() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(an_operator);
  CHECK(link.texts.size() >= 1);
  const json hello = link.texts.front();
  CHECK_EQUAL(hello.at("event").get<std::string>(), "hello");
  CHECK_EQUAL(hello.at("protocol").get<int>(), 1);
  CHECK_EQUAL(hello.at("application").get<std::string>(), "test_cell");
  CHECK_EQUAL(hello.at("descriptor").get<std::string>(), "0000000000007e57");
  CHECK_EQUAL(hello.at("boot").get<std::string>().size(), 16U);
  CHECK(hello.at("drivers") == json({{"actuator", "mock"}}));
  const json& reasons = hello.at("null_reasons");
  CHECK_EQUAL(reasons.at(static_cast<std::size_t>(NullReason::ahead_of_time)).get<std::string>(),
              "stamped ahead of time");
  // Each has words of its own.
  const auto words = reasons.get<std::vector<std::string>>();
  CHECK_EQUAL(std::set<std::string>(words.begin(), words.end()).size(), null_reason_count);
  CHECK(
      hello.at("session") ==
      json(
          {{"name", "panel-2"}, {"role", "operator"}, {"local", true}, {"user", "olga"}, {"lapsed", false}}));
  json state = rig.event(link, "state");
  CHECK_EQUAL(state.at("mode").get<std::string>(), "running");
  CHECK(state.at("motion") ==
        json({{"stopped", false}, {"may_move", true}, {"start_refused", ""}, {"stopped_by", nullptr}}));
  CHECK(state.at("control").at("holder").is_null());
  CHECK(state.at("edit").is_null());
  // What changes is told at once, and to whom it happens.
  PlayedLink& other = rig.connect(a_viewer);
  rig.event(other, "state");
  // Also one of those that come each second.
  link.texts.clear();
  other.texts.clear();
  rig.ask(link, {{"op", "take_control"}});
  CHECK(rig.event(link, "state").at("control").at("holder").at("you") == true);
  const json seen = rig.event(other, "state").at("control").at("holder");
  CHECK(seen.at("you") == false && seen.at("user") == "olga");
  rig.ask(other, {{"op", "stop_motion"}});
  CHECK(rig.wait_until([&] { return rig.get("state").body.at("motion").at("stopped") == true; }));
}

void a_fault_is_told_with_its_cause() {
  ProducerAndConsumer cell;
  std::atomic<bool> fails{false};
  cell.unit(ProducerAndConsumer::producer).script.step = [&fails](fixture::TestUnit& unit, const Tick&) {
    if (fails) unit.fail(Status::error(StatusCode::device_fault, "the gripper lost its part"));
  };
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(a_viewer);
  CHECK(rig.event(link, "state").at("faults").empty());
  link.texts.clear();
  const std::int64_t before = MonotonicClock::now().time_since_epoch().count();
  fails = true;
  json fault;
  const auto told = [&] {
    for (const json& text : link.texts)
      if (text.value("event", "") == "state" && !text.at("faults").empty()) fault = text.at("faults").at(0);
    return !fault.is_null();
  };
  CHECK(rig.wait_until(told));
  CHECK(fault.at("component") == "producer" && fault.at("cause") == "the gripper lost its part");
  const auto since = fault.at("since_ns").get<std::int64_t>();
  CHECK(since > before && since <= MonotonicClock::now().time_since_epoch().count());
  // And stays so for as long as it is the same one.
  fault = {};
  link.texts.clear();
  CHECK(rig.wait_until(told));
  CHECK_EQUAL(fault.at("since_ns").get<std::int64_t>(), since);
}

void frames_hold_what_is_new() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(a_viewer);
  const json answer = rig.ask(link, subscribe({{{"name", "values"}, {"rate", 60}}, {{"name", "valves"}}}));
  CHECK(answer.at("unknown") == json::array({"valves"}));
  std::uint64_t sequence = 0;
  for (int seen = 0; seen < 5; ++seen) {
    CHECK(rig.wait_until([&] {
      const auto has_value = [](const std::string& frame) {
        return items(frame) == 1 && at<std::uint32_t>(frame, 36) != 0;
      };
      while (!link.frames.empty() && !has_value(link.frames.front())) link.frames.pop_front();
      return !link.frames.empty();
    }));
    const std::string frame = link.frames.front();
    link.frames.pop_front();
    CHECK_EQUAL(at<std::uint64_t>(frame, 0), 0x7E57U);
    CHECK_EQUAL(items(frame), 1U);
    CHECK_EQUAL(frame.size(), 32 + 32 + sizeof(fixture::Item));
    CHECK_EQUAL(at<std::uint32_t>(frame, 32), 0U);
    CHECK_EQUAL(at<std::uint32_t>(frame, 36), sizeof(fixture::Item));
    const auto next = at<std::uint64_t>(frame, 40);
    CHECK(next > sequence);
    CHECK_EQUAL(at<std::uint32_t>(frame, 60), sequence == 0 ? 0 : next - sequence - 1);
    sequence = next;
    const auto item = at<fixture::Item>(frame, 64);
    CHECK(item.number > 0 || seen == 0);
  }
}

/// What is wrong with a client's frames, each after the other; empty: nothing.
std::string fault_of(const std::deque<std::string>& frames) {
  std::uint64_t number = 0;
  std::map<std::uint32_t, std::uint64_t> sequences;
  for (const std::string& frame : frames) {
    const std::uint64_t previous_number = std::exchange(number, at<std::uint64_t>(frame, 24));
    if (previous_number != 0 && number != previous_number + 1) return "a number is missing";
    std::size_t place = 32;
    for (std::uint32_t item = 0; item < items(frame); ++item) {
      const auto sequence = at<std::uint64_t>(frame, place + 8);
      const std::uint64_t seen = std::exchange(sequences[at<std::uint32_t>(frame, place)], sequence);
      const std::uint64_t missed = seen == 0 || seen == sequence ? 0 : sequence - seen - 1;
      if (at<std::uint32_t>(frame, place + 28) != missed) return "not the number of items that it missed";
      place += 32 + (at<std::uint32_t>(frame, place + 4) + 7) / 8 * 8;
    }
    if (place != frame.size()) return "more bytes than items";
  }
  return {};
}

void who_wants_the_same_gets_the_same_with_counts_of_its_own() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  const json both{{{"name", "values"}, {"rate", 60}}, {{"name", "producer.runtime"}, {"rate", 60}}};
  PlayedLink& one = rig.connect(a_viewer);
  PlayedLink& same = rig.connect(a_viewer);
  PlayedLink& fewer = rig.connect(a_viewer);
  PlayedLink& slower = rig.connect(a_viewer);
  rig.ask(one, subscribe(both));
  rig.ask(same, subscribe(both));
  rig.ask(fewer, subscribe({{{"name", "values"}, {"rate", 60}}}));
  rig.ask(slower,
          subscribe({{{"name", "values"}, {"rate", 20}}, {{"name", "producer.runtime"}, {"rate", 20}}}));
  CHECK(rig.wait_until([&] { return slower.frames.size() >= 10 && same.frames.size() >= 30; }));
  for (const PlayedLink* link : {&one, &same, &fewer, &slower}) CHECK_EQUAL(fault_of(link->frames), "");
  std::map<std::int64_t, std::string> items_at;
  for (const std::string& frame : one.frames) items_at[at<std::int64_t>(frame, 8)] = frame.substr(32);
  std::size_t equal = 0;
  for (const std::string& frame : same.frames) {
    const auto found = items_at.find(at<std::int64_t>(frame, 8));
    if (found != items_at.end() && items(frame) > 0 && found->second == frame.substr(32)) ++equal;
  }
  CHECK(equal >= 10);
  for (const std::string& frame : fewer.frames) CHECK(items(frame) <= 1);
}

void silence_has_its_heartbeat() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(a_viewer);
  const Time now = MonotonicClock::now();
  link.frames.clear();
  rig.tick(now + std::chrono::milliseconds{300});
  CHECK_EQUAL(link.frames.size(), 1U);
  rig.tick(now + std::chrono::milliseconds{400});
  CHECK_EQUAL(link.frames.size(), 1U);
  rig.tick(now + std::chrono::milliseconds{600});
  CHECK_EQUAL(link.frames.size(), 2U);
  CHECK_EQUAL(items(link.frames.back()), 0U);
}

void the_reason_of_a_null_comes_too() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_engineer);
  PlayedLink& link = rig.connect(an_engineer);
  rig.ask(link, subscribe({{{"name", "values"}, {"rate", 60}}}));
  rig.ask(link, {{"op", "action"}, {"component", "producer"}, {"action", "stop"}});
  CHECK(rig.wait_until([&] {
    for (const std::string& frame : link.frames)
      if (items(frame) == 1 && at<std::uint32_t>(frame, 36) == 0 &&
          at<std::uint8_t>(frame, 56) == static_cast<std::uint8_t>(NullReason::writer_stopped))
        return true;
    return false;
  }));
}

void a_slow_client_delays_nobody() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& slow = rig.connect(a_viewer);
  PlayedLink& quick = rig.connect(a_viewer);
  for (PlayedLink* link : {&slow, &quick}) rig.ask(*link, subscribe({{{"name", "values"}, {"rate", 50}}}));
  slow.frames.clear();
  slow.stuck = true;
  CHECK(rig.wait_until([&] { return slow.is_writing(); }));
  const std::size_t before = slow.sent;
  quick.frames.clear();
  CHECK(rig.wait_until([&] { return quick.frames.size() >= 15; }));
  CHECK_EQUAL(slow.sent, before);
  CHECK(rig.api().until_next(MonotonicClock::now()) <= std::chrono::milliseconds{100});
  slow.frames.clear();
  const auto newest = rig.get("slots/values").body.at("sequence").get<std::uint64_t>();
  slow.unstick(rig.api());
  CHECK(slow.frames.size() <= 1);
  CHECK(rig.wait_until([&] {
    while (!slow.frames.empty() && items(slow.frames.front()) == 0) slow.frames.pop_front();
    return !slow.frames.empty();
  }));
  // It gets what is newest, and is told how much was left out.
  CHECK(at<std::uint64_t>(slow.frames.front(), 40) >= newest);
  CHECK(at<std::uint32_t>(slow.frames.front(), 20) >= 10);
}

void topics_come_when_they_change() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(a_viewer);
  json topics = json::array();
  for (const char* const name : {"components", "slots", "queues", "threads", "log"})
    topics.push_back({{"name", name}, {"rate", 10}});
  topics.push_back({{"name", "weather"}});
  CHECK(rig.ask(link, subscribe(json::array(), topics)).at("unknown") == json::array({"weather"}));
  std::map<std::string, json> bodies;
  CHECK(rig.wait_until([&] {
    for (const json& text : link.texts)
      if (text.value("event", "") == "topic") bodies[text.at("name").get<std::string>()] = text.at("body");
    return bodies.size() == 4;
  }));
  CHECK_EQUAL(bodies["components"].size(), 3U);
  CHECK_EQUAL(bodies["components"][0].at("name").get<std::string>(), "producer");
  CHECK_EQUAL(bodies["slots"][0].at("readers").at(0).at("name").get<std::string>(), "consumer.first");
  CHECK_EQUAL(bodies["queues"][0].at("writers").at(0).at("name").get<std::string>(), "producer.orders");
  CHECK(bodies["threads"][0].at("lateness").contains("p99.9_ns"));
  log_info("test", "a line for the page");
  drain_log(-1);
  CHECK(rig.wait_until([&] {
    for (const json& text : link.texts)
      if (text.value("event", "") == "log")
        for (const json& line : text.at("lines"))
          if (line.at("text").get<std::string>().find("a line for the page") != std::string::npos)
            return true;
    return false;
  }));
}

void what_is_no_message_closes_the_connection() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  struct Case {
    const char* text;
    std::uint16_t code;
  };
  for (const Case& one : {Case{"hello", 1007}, Case{"[1]", 1007}, Case{R"({"op": "ping"})", 1008},
                          Case{R"({"op": "ping", "id": 0})", 1008}, Case{R"({"id": 1})", 1008},
                          Case{R"({"op": "ping", "id": -1})", 1008}, Case{R"({"op": 7, "id": 1})", 1008}}) {
    PlayedLink& link = rig.connect(a_viewer);
    rig.api().live().on_text(link, one.text);
    CHECK_EQUAL(link.closed, one.code);
    rig.disconnect(link);
  }
  PlayedLink& link = rig.connect(a_viewer);
  CHECK_CONTAINS(rig.ask(link, {{"op", "pong"}}).at("problem").at("detail").get<std::string>(),
                 "did you mean 'ping'?");
  CHECK_CONTAINS(rig.ask(link, {{"op", "ping"}}).at("problem").at("detail").get<std::string>(),
                 "'sent' is missing");
  CHECK_CONTAINS(rig.ask(link, subscribe({{{"name", "values"}, {"rate", 1000}}}))
                     .at("problem")
                     .at("detail")
                     .get<std::string>(),
                 "60 a second");
  CHECK_CONTAINS(rig.ask(link, {{"op", "set"}, {"component", "producr"}, {"values", {{"gain", 1}}}})
                     .at("problem")
                     .at("detail")
                     .get<std::string>(),
                 "did you mean 'producer'?");
  CHECK_EQUAL(rig.ask(link, {{"op", "ping"}, {"sent", 17.25}}).at("sent").get<double>(), 17.25);
}

void who_asks_and_never_reads_is_closed() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(a_viewer);
  PlayedLink& other = rig.connect(a_viewer);
  link.stuck = true;
  CHECK(rig.wait_until([&] { return link.is_writing(); }));
  for (int i = 1; i < 100'000 && link.closed == 0; ++i)
    rig.send(link, {{"op", "ping"}, {"id", i}, {"sent", i}});
  CHECK_EQUAL(link.closed, 1013);
  CHECK(rig.ask(other, {{"op", "ping"}, {"sent", 1}}).at("ok") == true);
}

void two_pages_see_each_others_changes() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_operator);
  PlayedLink& hand = rig.connect(an_operator);
  PlayedLink& eye = rig.connect(a_viewer);
  rig.ask(eye, subscribe({{{"name", "producer.runtime"}, {"rate", 60}}}));
  rig.ask(hand, {{"op", "set"}, {"component", "producer"}, {"values", {{"gain", 7.5}}}});
  CHECK(rig.wait_until([&] {
    for (const std::string& frame : eye.frames)
      if (items(frame) == 1 && at<double>(frame, 64) == 7.5) return true;
    return false;
  }));
}

void the_end_is_told() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(a_viewer);
  rig.executive().request_end();
  CHECK(rig.event(link, "ended").contains("text"));
}

void a_lapsed_session_is_told_to_log_in_and_can_still_stop() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(an_operator);
  CHECK(rig.event(link, "hello").at("session").at("lapsed") == false);
  const int acts = rig.access().acts;
  rig.ask(link, {{"op", "ping"}, {"sent", 1}});
  CHECK_EQUAL(rig.access().acts, acts);
  rig.ask(link, {{"op", "take_control"}});
  CHECK_EQUAL(rig.access().acts, acts + 1);
  rig.access().lapse(an_operator);
  const json told = rig.event(link, "session");
  CHECK(told.at("session").at("lapsed") == true);
  CHECK_EQUAL(told.at("session").at("role").get<std::string>(), "viewer");
  CHECK_EQUAL(link.closed, 0);
  CHECK(rig.ask(link, {{"op", "start_motion"}}).at("ok") == false);
  CHECK(rig.ask(link, {{"op", "stop_motion"}}).at("ok") == true);
  CHECK(rig.executive().control().motion_stopped());
}

void links_count_for_their_session_until_it_ends() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& first = rig.connect(an_operator);
  PlayedLink& second = rig.connect(an_operator);
  CHECK_EQUAL(rig.access().links, 2);
  rig.disconnect(first);
  CHECK_EQUAL(rig.access().links, 1);
  rig.access().end(an_operator);
  CHECK_EQUAL(second.closed, 1008);
  // The index may be another session's by now, whose links are still there.
  rig.disconnect(second);
  CHECK_EQUAL(rig.access().links, 1);
}

}  // namespace
}  // namespace flexrf::panel::live_test

int main() {
  using namespace flexrf::panel::live_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_page_is_greeted_and_told_the_state),
      CONTAINED_TEST(a_fault_is_told_with_its_cause),
      CONTAINED_TEST(frames_hold_what_is_new),
      CONTAINED_TEST(who_wants_the_same_gets_the_same_with_counts_of_its_own),
      CONTAINED_TEST(silence_has_its_heartbeat),
      CONTAINED_TEST(the_reason_of_a_null_comes_too),
      CONTAINED_TEST(a_slow_client_delays_nobody),
      CONTAINED_TEST(topics_come_when_they_change),
      CONTAINED_TEST(what_is_no_message_closes_the_connection),
      CONTAINED_TEST(who_asks_and_never_reads_is_closed),
      CONTAINED_TEST(two_pages_see_each_others_changes),
      CONTAINED_TEST(the_end_is_told),
      CONTAINED_TEST(a_lapsed_session_is_told_to_log_in_and_can_still_stop),
      CONTAINED_TEST(links_count_for_their_session_until_it_ends),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
