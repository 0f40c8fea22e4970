// The configuration flow, and start, stop and initialise of single components.
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel::edits_test {
namespace {

using fixture::ProducerAndConsumer;

const json edit_consumer{{"op", "edit_begin"}, {"components", {"consumer"}}};

json change(double offset) {
  return json::array({{{"component", "consumer"}, {"values", {{"offset", offset}}}}});
}

void stop_motion(Rig& rig, PlayedLink& link) {
  rig.ask(link, {{"op", "stop_motion"}});
  CHECK(rig.wait_until([&] { return rig.executive().moving().empty(); }));
}

double offset(Rig& rig) {
  return rig.get("components/consumer/parameters").body.at("configuration").at("offset").get<double>();
}

void an_edit_is_applied_and_ends_inhibited() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_engineer);
  PlayedLink& link = rig.connect(an_engineer);
  const json moving = rig.ask(link, edit_consumer);
  CHECK_EQUAL(moving.at("problem").at("status").get<int>(), 409);
  CHECK(!moving.at("problem").at("moving").empty());
  stop_motion(rig, link);
  const json begun = rig.ask(link, edit_consumer);
  CHECK(begun.at("ok") == true);
  CHECK(begun.at("reinitialised") == json::array({"consumer"}));
  CHECK(begun.at("configuration").at("consumer").contains("offset"));
  const json& edit = begun.at("edit");
  const json wrong = rig.ask(
      link,
      {{"op", "edit_apply"},
       {"edit", edit},
       {"changes", json::array({{{"component", "consumer"}, {"values", {{"offset", "x"}, {"ofset", 1}}}},
                                {{"component", "producer"}, {"values", {{"offset", 1}}}}})}});
  CHECK_EQUAL(wrong.at("outcome").get<std::string>(), "refused");
  CHECK_EQUAL(wrong.at("causes").size(), 3U);
  CHECK_CONTAINS(wrong.at("causes").at(0).get<std::string>(), "consumer.offset is refused: ");
  const json applied = rig.ask(link, {{"op", "edit_apply"}, {"edit", edit}, {"changes", change(0.25)}});
  CHECK_EQUAL(applied.at("outcome").get<std::string>(), "done");
  CHECK_EQUAL(applied.at("owners").dump(), json::array({"consumer"}).dump());
  CHECK_EQUAL(offset(rig), 0.25);
  CHECK(!rig.executive().control().may_move());
  CHECK(cell.events().count_of("consumer: initialise") == 2);
  const json over = rig.ask(link, {{"op", "edit_apply"}, {"edit", edit}, {"changes", change(0.7)}});
  CHECK_EQUAL(over.at("problem").at("status").get<int>(), 409);
}

void a_failed_initialise_rolls_back() {
  ProducerAndConsumer cell;
  cell.unit(ProducerAndConsumer::consumer).script.initialise = [](fixture::TestUnit& unit) {
    return unit.configuration.offset > 1 ? Status::error(StatusCode::out_of_range, "the cable is too short")
                                         : Status{};
  };
  Rig rig(cell);
  rig.start();
  rig.access().give(an_engineer);
  PlayedLink& link = rig.connect(an_engineer);
  stop_motion(rig, link);
  const double before = offset(rig);
  const json begun = rig.ask(link, edit_consumer);
  const json applied =
      rig.ask(link, {{"op", "edit_apply"}, {"edit", begun.at("edit")}, {"changes", change(2)}});
  CHECK_EQUAL(applied.at("outcome").get<std::string>(), "rolled_back");
  CHECK_CONTAINS(applied.at("causes").at(0).get<std::string>(), "the cable is too short");
  CHECK_EQUAL(offset(rig), before);
  CHECK(rig.wait_until(
      [&] { return rig.get("components/consumer").body.at("life").get<std::string>() == "running"; }));
  CHECK(rig.ask(link, edit_consumer).at("ok") == true);
}

void one_edit_at_a_time_and_none_for_ever() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  PlayedLink& link = rig.connect(an_engineer);
  PlayedLink& other = rig.connect(another_engineer);
  CHECK_EQUAL(rig.ask(link, edit_consumer).at("problem").at("type").get<std::string>(),
              "/problems/control-missing");
  rig.access().give(an_operator);
  PlayedLink& worker = rig.connect(an_operator);
  CHECK_EQUAL(rig.ask(worker, edit_consumer).at("problem").at("type").get<std::string>(),
              "/problems/role-missing");
  rig.access().give(an_engineer);
  stop_motion(rig, link);
  CHECK(rig.ask(link, edit_consumer).at("ok") == true);
  rig.event(other, "state");
  CHECK(rig.wait_until([&] {
    const json state = rig.get("state").body;
    return !state.at("edit").is_null() && state.at("edit").at("holder").at("user") == "eric";
  }));
  // While it is open, nothing begins to move.
  rig.ask(link, {{"op", "clear_stop_motion"}});
  CHECK_CONTAINS(rig.ask(link, {{"op", "start_motion"}}).at("problem").at("detail").get<std::string>(),
                 "edited");
  // It ends with control,
  rig.access().give(another_engineer);
  CHECK(rig.get("state").body.at("edit").is_null());
  const json begun = rig.ask(other, edit_consumer);
  CHECK(begun.at("ok") == true);
  CHECK(rig.ask(other, {{"op", "edit_discard"}, {"edit", begun.at("edit")}}).at("ok") == true);
  CHECK(rig.ask(other, {{"op", "edit_discard"}, {"edit", begun.at("edit")}}).at("ok") == false);
  // and after five minutes.
  CHECK(rig.ask(other, edit_consumer).at("ok") == true);
  rig.tick(MonotonicClock::now() + std::chrono::minutes{6});
  CHECK(rig.get("state").body.at("edit").is_null());
}

void an_edit_may_be_left_open_for_as_long_as_is_said() {
  ProducerAndConsumer cell;
  ApiTimeouts timeouts = Rig::patient;
  timeouts.edit = std::chrono::minutes{15};
  Rig rig(cell, timeouts);
  rig.start();
  rig.access().give(an_engineer);
  PlayedLink& link = rig.connect(an_engineer);
  stop_motion(rig, link);
  CHECK(rig.ask(link, edit_consumer).at("ok") == true);
  rig.tick(MonotonicClock::now() + std::chrono::minutes{14});
  CHECK(!rig.get("state").body.at("edit").is_null());
  rig.tick(MonotonicClock::now() + std::chrono::minutes{16});
  CHECK(rig.get("state").body.at("edit").is_null());
}

void a_reconfiguration_in_one_request() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_engineer);
  const std::string body = json{{"changes", change(0.25)}}.dump();
  const Answer moving = rig.request(Method::post, "reconfigure", an_engineer, body);
  CHECK_EQUAL(moving.status, 409U);
  CHECK(!moving.body.at("moving").empty());
  rig.executive().control().stop_motion();
  CHECK(rig.wait_until([&] { return rig.executive().moving().empty(); }));
  const Answer done = rig.request(Method::post, "reconfigure", an_engineer, body);
  CHECK_EQUAL(done.status, 200U);
  CHECK_EQUAL(done.body.at("outcome").get<std::string>(), "done");
  CHECK_EQUAL(offset(rig), 0.25);
  CHECK_EQUAL(
      rig.request(Method::post, "reconfigure", an_engineer, R"({"changes": [{"component": "nobody"}]})")
          .body.at("outcome")
          .get<std::string>(),
      "refused");
  CHECK(rig.get("state").body.at("edit").is_null());
}

void components_are_stopped_and_started() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_engineer);
  const std::string actions = "components/producer/actions/";
  CHECK_EQUAL(rig.request(Method::post, actions + "stop", an_operator).status, 403U);
  CHECK_EQUAL(rig.request(Method::post, actions + "stop", an_engineer).status, 200U);
  CHECK_EQUAL(rig.get("components/producer").body.at("life").get<std::string>(), "stopped");
  const Answer refused =
      rig.request(Method::put, "components/producer/parameters", an_engineer, R"({"gain": 2})");
  CHECK_EQUAL(refused.status, 409U);
  CHECK_EQUAL(rig.request(Method::post, actions + "start", an_engineer).status, 200U);
  CHECK_EQUAL(rig.get("components/producer").body.at("life").get<std::string>(), "running");
  CHECK_EQUAL(rig.request(Method::post, actions + "start", an_engineer).status, 409U);
  CHECK_EQUAL(rig.request(Method::post, actions + "initialise", an_engineer).status, 200U);
  CHECK_CONTAINS(
      rig.request(Method::post, actions + "initialize", an_engineer).body.at("detail").get<std::string>(),
      "did you mean 'initialise'?");
  CHECK_CONTAINS(
      rig.request(Method::post, actions + "activate", an_engineer).body.at("detail").get<std::string>(),
      "not a member of a population");
}

void members_come_and_go() {
  fixture::TestApplication cell;
  for (const char* const name : {"walker[0]", "walker[1]"}) {
    fixture::UnitPlan plan;
    plan.name = name;
    cell.add(plan);
  }
  cell.add(fixture::PopulationPlan{"walker", 0, 2, 1});
  cell.add(fixture::ThreadPlan{.name = "walking",
                               .trigger = fixture::TriggerPlan::periodic(std::chrono::milliseconds{1}),
                               .units = {0, 1},
                               .devices = {}});
  Rig rig(cell);
  rig.start();
  rig.access().give(an_operator);
  PlayedLink& link = rig.connect(an_operator);
  CHECK(rig.get("components/walker[1]").body.at("active") == false);
  CHECK(rig.get("components/walker[1]").body.at("member") == json({{"population", "walker"}, {"index", 1}}));
  rig.request(Method::put, "components/walker[0]/parameters", an_operator, R"({"gain": 4})");
  const json clone{
      {"op", "action"}, {"component", "walker[1]"}, {"action", "clone"}, {"source", "walker[0]"}};
  CHECK(rig.ask(link, clone).at("ok") == true);
  CHECK(rig.get("components/walker[1]").body.at("active") == true);
  CHECK_EQUAL(rig.get("components/walker[1]/parameters").body.at("runtime").at("gain").get<double>(), 4.0);
  CHECK(rig.ask(link, clone).at("ok") == false);
  CHECK_EQUAL(rig.request(Method::post, "components/walker[1]/actions/retire", an_operator).status, 200U);
  CHECK(rig.get("components/walker[1]").body.at("active") == false);
}

}  // namespace
}  // namespace flexrf::panel::edits_test

int main() {
  using namespace flexrf::panel::edits_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(an_edit_is_applied_and_ends_inhibited),
      CONTAINED_TEST(a_failed_initialise_rolls_back),
      CONTAINED_TEST(one_edit_at_a_time_and_none_for_ever),
      CONTAINED_TEST(an_edit_may_be_left_open_for_as_long_as_is_said),
      CONTAINED_TEST(a_reconfiguration_in_one_request),
      CONTAINED_TEST(components_are_stopped_and_started),
      CONTAINED_TEST(members_come_and_go),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
