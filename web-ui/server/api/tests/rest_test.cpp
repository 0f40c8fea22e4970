// Reading by REST, the table of routes, and the document that describes it.
#include <algorithm>
#include <atomic>

#include "web-ui/server/api/routes.hpp"
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel::rest_test {
namespace {

using fixture::ProducerAndConsumer;

void everything_can_be_read() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  CHECK(rig.wait_until([&] { return !rig.get("slots/values").body.at("value").is_null(); }));
  const json slot = rig.get("slots/values").body;
  CHECK_EQUAL(slot.at("type").get<std::string>(), "Item");
  CHECK(slot.at("value").at("number").is_number_integer());
  CHECK_EQUAL(slot.at("reason").get<std::string>(), "");
  CHECK(slot.at("sequence").get<std::uint64_t>() > 0);
  CHECK_EQUAL(rig.get("slots").body.size(), 5U);
  CHECK_EQUAL(rig.get("queues").body.at(0).at("name").get<std::string>(), "jobs");
  const json jobs = rig.get("queues").body.at(0);
  CHECK(jobs.at("fill").get<std::uint32_t>() <= jobs.at("capacity").get<std::uint32_t>());
  CHECK_EQUAL(rig.get("threads").body.size(), 2U);
  CHECK(rig.get("threads").body.at(0).at("execution").at("buckets").size() % 2 == 0);
  CHECK_EQUAL(rig.get("devices").body.at(0).at("unit").get<std::string>(), "consumer");
  CHECK_EQUAL(rig.get("components").body.size(), 3U);
  CHECK_EQUAL(rig.get("components/actuator").body.at("kind").get<std::string>(), "device");
  CHECK(rig.get("components/actuator/parameters").body.at("runtime") == json::object());
  CHECK_EQUAL(rig.get("state").body.at("mode").get<std::string>(), "running");
  CHECK(!rig.get("state").body.contains("event"));
  CHECK(rig.get("log").body.at("lines").is_array());
  CHECK(rig.request(Method::get, "log", a_viewer, "", "", "", "after=999999").body.at("lines").empty());
  CHECK_EQUAL(rig.request(Method::get, "log", a_viewer, "", "", "", "after=x").status, 400U);
  CHECK_EQUAL(rig.request(Method::head, "slots/values", a_viewer).status, 200U);
}

void what_is_not_there_is_told() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  CHECK_EQUAL(rig.get("nothing").status, 404U);
  CHECK_EQUAL(rig.get("components/producer/parameters/gain").status, 404U);
  CHECK_EQUAL(rig.get("slots/valus").status, 404U);
  CHECK_CONTAINS(rig.get("slots/valus").body.at("detail").get<std::string>(), "did you mean 'values'?");
  CHECK_EQUAL(rig.get("slots/values/image").status, 404U);
  CHECK_EQUAL(rig.get("stop-motion").status, 405U);
  CHECK(!rig.executive().control().motion_stopped());
  CHECK_EQUAL(rig.request(Method::post, "slots", a_viewer).status, 405U);
  CHECK_EQUAL(rig.request(Method::other, "slots", a_viewer).status, 405U);
  CHECK_EQUAL(rig.get("slots", no_session).status, 403U);
}

void unchanged_bodies_are_not_sent_again() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  CHECK(rig.wait_until([&] { return rig.get("devices").body.at(0).at("inhibited") == false; }));
  for (const char* const path : {"descriptor", "openapi.json", "devices"}) {
    const Answer first = rig.get(path);
    CHECK_EQUAL(first.status, 200U);
    CHECK(!first.reply.etag.empty());
    const Answer second = rig.request(Method::get, path, a_viewer, "", "", "\"x\", " + first.reply.etag);
    CHECK_EQUAL(second.status, 304U);
    CHECK(second.reply.text.empty() && second.reply.fixed.empty());
  }
}

void control_is_taken_asked_for_and_given() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  CHECK_EQUAL(rig.request(Method::post, "control/take", a_viewer).status, 403U);
  CHECK(rig.request(Method::post, "control/take", an_operator).body.at("taken") == true);
  CHECK(rig.request(Method::post, "control/take", an_engineer).body.at("taken") == false);
  CHECK_EQUAL(rig.request(Method::post, "control/take", another_engineer).status, 409U);
  CHECK_EQUAL(rig.request(Method::post, "control/answer", an_engineer, R"({"grant": true})").status, 409U);
  CHECK_EQUAL(rig.request(Method::post, "control/answer", an_operator, R"({"grant": "yes"})").status, 400U);
  CHECK_EQUAL(rig.request(Method::post, "control/answer", an_operator, R"({"grant": true})").status, 200U);
  CHECK_EQUAL(rig.access().holder(), SessionIndex{an_engineer});
  CHECK_EQUAL(rig.request(Method::post, "control/release", an_engineer).status, 200U);
  CHECK_EQUAL(rig.access().holder(), no_session);
}

void the_document_describes_every_route() {
  const json document = json::parse(openapi_document("test"));
  CHECK_EQUAL(document.at("openapi").get<std::string>(), "3.1.0");
  const json& schemas = document.at("components").at("schemas");
  const auto check_schema = [&schemas](std::string_view name) {
    if (!name.empty() && name.find('/') == std::string_view::npos) CHECK(schemas.contains(std::string{name}));
  };
  for (const Route& route : routes()) {
    const json& operations = document.at("paths").at("/" + std::string{route.path});
    const char* const method = route.method == Method::get   ? "get"
                               : route.method == Method::put ? "put"
                                                             : "post";
    CHECK(operations.contains(method));
    CHECK(operations.at(method).at("summary") == route.summary);
    check_schema(route.request);
    if (route.response == "204") {
      CHECK(!operations.at(method).at("responses").at("204").contains("content"));
    } else {
      check_schema(route.response);
    }
    std::string path{route.path};
    for (std::size_t open = path.find('{'); open != std::string::npos; open = path.find('{'))
      path.replace(open, path.find('}') - open + 1, "some");
    CHECK(match(route.method, path).route == (route.resource == Resource::access ? nullptr : &route));
  }
  CHECK(match(Method::get, "").route == nullptr);
  CHECK(match(Method::get, "slots/").route == nullptr || match(Method::get, "slots/").segments[0].empty());
}

void a_generated_client_can_log_in_and_change_what_it_has_read() {
  const json paths = json::parse(openapi_document("test")).at("paths");
  const auto schema_of = [](const json& content) {
    return content.at("content").at("application/json").at("schema").at("$ref").get<std::string>();
  };
  const json& login = paths.at("/login").at("post");
  CHECK_EQUAL(schema_of(login.at("requestBody")), "#/components/schemas/Login");
  CHECK_EQUAL(schema_of(login.at("responses").at("200")), "#/components/schemas/LoggedIn");
  CHECK_EQUAL(schema_of(paths.at("/session").at("get").at("responses").at("200")),
              "#/components/schemas/LoggedIn");
  CHECK(paths.contains("/logout"));
  const json header = {
      {"name", "If-Match"}, {"in", "header"}, {"required", false}, {"schema", {{"type", "string"}}}};
  const json& put = paths.at("/components/{name}/parameters").at("put").at("parameters");
  CHECK(std::find(put.begin(), put.end(), header) != put.end());
  // They are answered elsewhere.
  CHECK(!match(Method::post, "login").known_path);
}

void the_descriptor_comes_compressed_to_who_takes_it() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  const Answer plain = rig.get("openapi.json");
  Request request;
  request.path = "/api/v1/openapi.json";
  request.session = a_viewer;
  request.accepts_gzip = true;
  Reply reply;
  CHECK(rig.api().handle(request, reply, {0, 999'999}) == Handled::now);
  CHECK_EQUAL(reply.content_encoding, std::string_view{"gzip"});
  CHECK(reply.varies_by_encoding && plain.reply.varies_by_encoding);
  CHECK(reply.fixed.size() < plain.reply.fixed.size() / 3);
  CHECK(reply.etag != plain.reply.etag);
  request.if_none_match = reply.etag;
  Reply again;
  CHECK(rig.api().handle(request, again, {0, 999'999}) == Handled::now);
  CHECK_EQUAL(again.status, 304U);
}

void an_admin_reads_who_did_what() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  CHECK_EQUAL(rig.get("audit", an_engineer).status, 403U);
  rig.access().give(an_operator);
  CHECK_EQUAL(
      rig.request(Method::put, "components/producer/parameters", an_operator, R"({"gain": 4.5})").status,
      200U);
  CHECK_EQUAL(
      rig.request(Method::post, "components/producer/actions/press", an_operator, R"({"parameter": "kick"})")
          .status,
      200U);
  const auto finds = [&](const char* did, const char* what, const char* who) {
    return rig.wait_until([&] {
      const json entries = rig.get("audit", an_admin).body.at("entries");
      return std::any_of(entries.begin(), entries.end(), [&](const json& entry) {
        return entry.at("did") == did && entry.value("what", "") == what && entry.at("who") == who;
      });
    });
  };
  CHECK(finds("took control", "", "olga (127.0.0.1)"));
  CHECK(finds("changed", "producer.gain", "olga (127.0.0.1)"));
  CHECK(finds("pressed", "producer.kick", "olga (127.0.0.1)"));
  const json all = rig.get("audit", an_admin).body;
  const std::uint64_t last = all.at("last").get<std::uint64_t>();
  CHECK_EQUAL(all.at("entries").back().at("number").get<std::uint64_t>(), last);
  const json rest =
      rig.request(Method::get, "audit", an_admin, "", "", "", "after=" + std::to_string(last - 1)).body;
  CHECK_EQUAL(rest.at("entries").size(), 1U);
  CHECK_EQUAL(rig.request(Method::get, "audit", an_admin, "", "", "", "after=x").status, 400U);
}

void health_is_one_word() {
  ProducerAndConsumer cell;
  std::atomic<bool> fails{false};
  cell.unit(ProducerAndConsumer::producer).script.step = [&fails](fixture::TestUnit& unit, const Tick&) {
    if (fails) unit.fail(Status::error(StatusCode::device_fault, "the gripper lost its part"));
  };
  Rig rig(cell);
  rig.start();
  const Answer healthy = rig.get("health");
  CHECK_EQUAL(healthy.status, 200U);
  CHECK(healthy.body == json({{"healthy", true}, {"why_not", ""}, {"may_move", true}}));
  CHECK_EQUAL(rig.request(Method::post, "stop-motion", an_operator).status, 200U);
  CHECK(rig.get("health").body.at("healthy") == true);
  CHECK(rig.get("health").body.at("may_move") == false);
  CHECK_EQUAL(rig.get("health", no_session).status, 403U);
  Request request;
  request.path = "/api/v1/health";
  request.loopback = true;
  Reply reply;
  CHECK(rig.api().handle(request, reply, {0, 999'999}) == Handled::now);
  CHECK_EQUAL(reply.status, 200U);
  fails = true;
  CHECK(rig.wait_until([&] { return rig.get("health").status == 503U; }));
  CHECK_EQUAL(rig.get("health").body.at("why_not").get<std::string>(),
              "unit producer is in fault: the gripper lost its part");
}

void the_state_says_who_stopped() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  CHECK(rig.get("state").body.at("motion").at("stopped_by").is_null());
  CHECK_EQUAL(rig.request(Method::post, "stop-motion", an_engineer).status, 200U);
  CHECK(rig.wait_until([&] { return !rig.get("state").body.at("motion").at("stopped_by").is_null(); }));
  const json stop = rig.get("state").body.at("motion").at("stopped_by");
  CHECK_EQUAL(stop.at("who").get<std::string>(), "eric (127.0.0.1)");
  CHECK(stop.at("at_ms").get<std::int64_t>() > 1'600'000'000'000);
  rig.access().give(an_operator);
  CHECK_EQUAL(rig.request(Method::post, "clear-stop-motion", an_operator).status, 200U);
  CHECK(rig.wait_until([&] { return rig.get("state").body.at("motion").at("stopped_by").is_null(); }));
}

}  // namespace
}  // namespace flexrf::panel::rest_test

int main() {
  using namespace flexrf::panel::rest_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(everything_can_be_read),
      CONTAINED_TEST(what_is_not_there_is_told),
      CONTAINED_TEST(unchanged_bodies_are_not_sent_again),
      CONTAINED_TEST(control_is_taken_asked_for_and_given),
      CONTAINED_TEST(the_document_describes_every_route),
      CONTAINED_TEST(a_generated_client_can_log_in_and_change_what_it_has_read),
      CONTAINED_TEST(an_admin_reads_who_did_what),
      CONTAINED_TEST(health_is_one_word),
      CONTAINED_TEST(the_state_says_who_stopped),
      CONTAINED_TEST(the_descriptor_comes_compressed_to_who_takes_it),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
