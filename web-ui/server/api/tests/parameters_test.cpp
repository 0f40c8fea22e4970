// Runtime parameters by REST and live: set, reset, press; roles, the token, what is stale or wrong.
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel::parameters_test {
namespace {

using fixture::ProducerAndConsumer;

const std::string path = "components/producer/parameters";

json set(const char* component, const json& values) {
  return {{"op", "set"}, {"component", component}, {"values", values}};
}

void a_set_is_answered_with_the_values_in_force() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_operator);
  PlayedLink& link = rig.connect(an_operator);
  const json answer = rig.ask(link, set("producer", {{"gain", 2.5}}));
  CHECK(answer.at("ok") == true);
  CHECK_EQUAL(answer.at("values").at("gain").get<double>(), 2.5);
  const Answer got = rig.get(path);
  CHECK_EQUAL(got.status, 200U);
  CHECK_EQUAL(got.body.at("runtime").at("gain").get<double>(), 2.5);
  CHECK(got.body.at("sequence") == answer.at("sequence"));
  CHECK(got.body.at("configuration").contains("offset"));
  CHECK(got.body.at("feedback").is_null() || got.body.at("feedback").contains("steps"));
  const Answer put = rig.request(Method::put, path, an_operator, R"({"gain": 3})", got.reply.etag);
  CHECK_EQUAL(put.status, 200U);
  CHECK_EQUAL(put.body.at("runtime").at("gain").get<double>(), 3.0);
  CHECK(put.reply.etag != got.reply.etag);
  const json reset = rig.ask(link, {{"op", "reset"}, {"component", "producer"}, {"parameters", {"gain"}}});
  CHECK_EQUAL(reset.at("values").at("gain").get<double>(), 1.0);
}

void what_changed_since_is_stale() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_operator);
  PlayedLink& link = rig.connect(an_operator);
  const std::string tag = rig.get(path).reply.etag;
  const json first = rig.ask(link, set("producer", {{"gain", 2}}));
  const Answer put = rig.request(Method::put, path, an_operator, R"({"gain": 3})", tag);
  CHECK_EQUAL(put.status, 412U);
  CHECK_EQUAL(put.body.at("type").get<std::string>(), "/problems/stale");
  json late = set("producer", {{"gain", 4}});
  late["expected"] = first.at("sequence").get<std::uint64_t>() - 1;
  CHECK_EQUAL(rig.ask(link, late).at("problem").at("status").get<int>(), 412);
  late["expected"] = first.at("sequence");
  CHECK(rig.ask(link, late).at("ok") == true);
  // Another start of the application has other tags, whatever the number.
  const Answer other =
      rig.request(Method::put, path, an_operator, R"({"gain": 3})", "\"0123456789abcdef-1\"");
  CHECK_EQUAL(other.status, 412U);
  CHECK_CONTAINS(other.body.at("detail").get<std::string>(), "started again");
}

void wrong_values_are_refused_with_their_place() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_operator);
  struct Case {
    const char* body;
    unsigned status;
    const char* detail;
  };
  const Case cases[] = {{R"({"gain": 11})", 422, "lies outside 0 to 10"},
                        {R"({"gain": "2"})", 422, "wants a number"},
                        {R"({"gain": null})", 422, "wants a number"},
                        {R"({"gain": NaN})", 400, "no JSON"},
                        {R"({"gian": 1})", 404, "did you mean 'gain'?"},
                        {R"({"gain[0]": 1})", 404, "single value"},
                        {R"({"kick": 1})", 422, "to be pressed, not set"},
                        {R"({"move": true})", 422, "to be held, not set"},
                        {R"({})", 400, "There is no value"},
                        {R"([1])", 400, "no object"},
                        {R"({"gain": 1, "gain": 2})", 400, "comes twice"}};
  for (const Case& one : cases) {
    const Answer answer = rig.request(Method::put, path, an_operator, one.body);
    CHECK_EQUAL(answer.status, one.status);
    CHECK_EQUAL(answer.reply.content_type, "application/problem+json");
    CHECK_CONTAINS(answer.body.at("detail").get<std::string>(), one.detail);
  }
  const Answer answer = rig.request(Method::put, path, an_operator, R"({"gain": 11})");
  CHECK_EQUAL(answer.body.at("parameter").get<std::string>(), "gain");
  CHECK_EQUAL(rig.get(path).body.at("runtime").at("gain").get<double>(), 1.0);
}

void the_unit_may_refuse() {
  ProducerAndConsumer cell;
  cell.unit(ProducerAndConsumer::producer).script.accept = [](const fixture::Settings& settings) {
    return settings.gain > 5 ? Status::error(StatusCode::not_permitted, "too lively for this arm") : Status{};
  };
  Rig rig(cell);
  rig.start();
  rig.access().give(an_operator);
  const Answer answer = rig.request(Method::put, path, an_operator, R"({"gain": 6})");
  CHECK(answer.status == 409 || answer.status == 422);
  CHECK_CONTAINS(answer.body.at("reason").get<std::string>(), "too lively for this arm");
}

void roles_and_the_token_are_asked_for() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_engineer);
  const Answer viewer = rig.request(Method::put, path, a_viewer, R"({"gain": 2})");
  CHECK_EQUAL(viewer.status, 403U);
  CHECK_EQUAL(viewer.body.at("type").get<std::string>(), "/problems/role-missing");
  const Answer without = rig.request(Method::put, path, an_operator, R"({"gain": 2})");
  CHECK_EQUAL(without.status, 403U);
  CHECK_EQUAL(without.body.at("type").get<std::string>(), "/problems/control-missing");
  CHECK_EQUAL(rig.request(Method::put, path, no_session, R"({"gain": 2})").status, 403U);
  CHECK_EQUAL(rig.request(Method::put, path, an_engineer, R"({"gain": 2})").status, 200U);
  PlayedLink& link = rig.connect(an_operator);
  for (const char* const op : {"press", "hold"}) {
    const json answer = rig.ask(link, {{"op", op}, {"component", "producer"}, {"parameter", "kick"}});
    CHECK_EQUAL(answer.at("problem").at("status").get<int>(), 403);
  }
}

void presses_arrive() {
  ProducerAndConsumer cell;
  std::atomic<std::uint32_t> kicks{0};
  cell.unit(ProducerAndConsumer::producer).script.step = [&kicks](fixture::TestUnit& unit, const Tick&) {
    kicks += unit.runtime.kick;
  };
  Rig rig(cell);
  rig.start();
  rig.access().give(an_operator);
  PlayedLink& link = rig.connect(an_operator);
  const json press{{"op", "press"}, {"component", "producer"}, {"parameter", "kick"}, {"count", 3}};
  CHECK(rig.ask(link, press).at("ok") == true);
  CHECK(rig.wait_until([&] { return kicks == 3; }));
  const Answer by_rest =
      rig.request(Method::post, "components/producer/actions/press", an_operator, R"({"parameter": "kick"})");
  CHECK_EQUAL(by_rest.status, 200U);
  CHECK(rig.wait_until([&] { return kicks == 4; }));
  CHECK_EQUAL(
      rig.request(Method::post, "components/producer/actions/press", an_operator, R"({"parameter": "gain"})")
          .status,
      422U);
  CHECK_EQUAL(rig.request(Method::post, "components/producer/actions/press", an_operator,
                          R"({"parameter": "kick", "count": 0})")
                  .status,
              400U);
}

void a_thread_that_does_not_answer_is_given_up() {
  ProducerAndConsumer cell;
  // Released by nothing but what the producer publishes: with the producer stopped it sleeps; requests wake
  // it.
  std::atomic<bool> hang{false};
  std::atomic<bool> hung{false};
  cell.unit(ProducerAndConsumer::producer).script.step = [&](fixture::TestUnit&, const Tick&) {
    while (hang) hung = true;
  };
  Rig rig(cell, ApiTimeouts{});
  rig.start();
  rig.access().give(an_operator);
  PlayedLink& link = rig.connect(an_operator);
  hang = true;
  CHECK(rig.wait_until([&] { return hung.load(); }));
  json message = set("producer", {{"gain", 2}});
  message["id"] = 77;
  const Time before = MonotonicClock::now();
  rig.send(link, message);
  link.texts.clear();
  rig.tick(before + ApiTimeouts{}.answer - std::chrono::milliseconds{1});
  for (const json& text : link.texts) CHECK(text.value("id", 0) != 77);
  rig.tick(MonotonicClock::now() + ApiTimeouts{}.answer);
  hang = false;
  bool found = false;
  for (const json& text : link.texts)
    if (text.value("id", 0) == 77) found = text.at("problem").at("status") == 504;
  CHECK(found);
}

/// Nobody has to look whether there is an answer: whoever has one rings.
void answers_of_other_threads_ring() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_engineer);
  PlayedLink& link = rig.connect(an_engineer);
  for (json message : {set("producer", {{"gain", 2.5}}),
                       json{{"op", "action"}, {"component", "producer"}, {"action", "initialise"}}}) {
    message["id"] = 55;
    link.texts.clear();
    const std::uint32_t heard = rig.bell().listen();
    rig.send(link, message);
    CHECK(rig.bell().wait(heard, MonotonicClock::now() + fixture::patience));
    rig.tick();
    const auto answers = std::count_if(link.texts.begin(), link.texts.end(),
                                       [](const json& text) { return text.value("id", 0) == 55; });
    CHECK_EQUAL(answers, 1);
  }
}

}  // namespace
}  // namespace flexrf::panel::parameters_test

int main() {
  using namespace flexrf::panel::parameters_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_set_is_answered_with_the_values_in_force),
      CONTAINED_TEST(what_changed_since_is_stale),
      CONTAINED_TEST(wrong_values_are_refused_with_their_place),
      CONTAINED_TEST(the_unit_may_refuse),
      CONTAINED_TEST(roles_and_the_token_are_asked_for),
      CONTAINED_TEST(presses_arrive),
      CONTAINED_TEST(a_thread_that_does_not_answer_is_given_up),
      CONTAINED_TEST(answers_of_other_threads_ring),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
