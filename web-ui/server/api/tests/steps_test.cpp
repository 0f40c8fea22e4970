// When which unit was stepped, and what threads learned that poll by back-off: the list of steps, which costs
// the threads something only while somebody wants it.
#include "web-ui/server/api/tests/rig.hpp"
#include "web-ui/server/api/topic_bodies.hpp"

namespace flexrf::panel::steps_test {
namespace {

using fixture::ProducerAndConsumer;
using fixture::TriggerPlan;

json subscribe(const json& topics) {
  return {{"op", "subscribe"}, {"slots", json::array()}, {"topics", topics}};
}

/// The newest that came; null before.
json steps_in(const PlayedLink& link) {
  json newest;
  for (const json& text : link.texts)
    if (text.value("event", "") == "topic" && text.at("name") == "steps") newest = text.at("body");
  return newest;
}

void steps_are_told_while_somebody_subscribes() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  StepTraces& traces = *rig.executive().cell().step_traces();
  CHECK(traces.asked(0, MonotonicClock::now()) == nullptr);
  const std::int64_t before = nanoseconds(MonotonicClock::now());
  PlayedLink& link = rig.connect(a_viewer);
  json topics = json::array();
  topics.push_back({{"name", "steps"}, {"rate", 10}});
  CHECK(rig.ask(link, subscribe(topics)).at("unknown").empty());
  json threads;
  CHECK(rig.wait_until([&] {
    threads = steps_in(link);
    return threads.is_array() && threads.at(0).at("steps").size() > 30;
  }));
  CHECK_EQUAL(threads.size(), 2U);
  CHECK_EQUAL(threads.at(0).at("thread").get<std::string>(), "producing");
  CHECK(!threads.at(0).at("cut").get<bool>());
  constexpr std::int64_t second = 1'000'000'000;
  CHECK(threads.at(0).at("begin_ns").get<std::int64_t>() > before - second);
  const json& steps = threads.at(0).at("steps");
  CHECK_EQUAL(steps.size() % 3, 0U);
  CHECK_EQUAL(steps.at(1).get<std::int64_t>(), 0);  // the first begins at begin_ns
  for (std::size_t i = 0; i < steps.size(); i += 3) {
    CHECK_EQUAL(steps.at(i).get<int>(), 0);
    CHECK(steps.at(i + 2).get<std::int64_t>() >= 0);
    if (i == 0) continue;
    CHECK(steps.at(i + 1).get<std::int64_t>() >=
          steps.at(i - 2).get<std::int64_t>() + steps.at(i - 1).get<std::int64_t>());
  }
  CHECK_EQUAL(threads.at(1).at("steps").at(0).get<int>(), 1);
  CHECK(traces.asked(0, MonotonicClock::now()) != nullptr);

  rig.ask(link, subscribe(json::array()));
  const Time over = MonotonicClock::now() + TopicBodies::traced_for;
  for (int i = 0; i < 50; ++i) rig.tick();
  CHECK(traces.asked(0, over) == nullptr);
}

void a_polling_thread_tells_what_it_learned() {
  ProducerAndConsumer cell;
  cell.thread(ProducerAndConsumer::producing).trigger = TriggerPlan::periodic(std::chrono::milliseconds{5});
  cell.thread(ProducerAndConsumer::consuming).trigger = TriggerPlan::backing_off(
      ProducerAndConsumer::values, std::chrono::microseconds{200}, std::chrono::milliseconds{20});
  Rig rig(cell);
  rig.start();
  CHECK(rig.wait_until(
      [&] { return rig.get("threads").body.at(1).at("backoff").at("mean_ns").get<std::int64_t>() > 0; }));
  CHECK(rig.get("threads").body.at(1).at("backoff").contains("spread_ns"));
  CHECK(rig.get("threads").body.at(0).at("backoff").is_null());
}

}  // namespace
}  // namespace flexrf::panel::steps_test

int main() {
  using namespace flexrf::panel::steps_test;
  const CMUnitTest tests[] = {CONTAINED_TEST(steps_are_told_while_somebody_subscribes),
                              CONTAINED_TEST(a_polling_thread_tells_what_it_learned)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
