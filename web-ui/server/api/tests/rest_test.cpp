// Reading by REST, the table of routes, and the document that describes it.
#include <algorithm>

#include "web-ui/server/api/routes.hpp"
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel {
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
    if (!name.empty() && name != "image/jpeg") CHECK(schemas.contains(std::string{name}));
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

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(everything_can_be_read),
      CONTAINED_TEST(what_is_not_there_is_told),
      CONTAINED_TEST(unchanged_bodies_are_not_sent_again),
      CONTAINED_TEST(control_is_taken_asked_for_and_given),
      CONTAINED_TEST(the_document_describes_every_route),
      CONTAINED_TEST(a_generated_client_can_log_in_and_change_what_it_has_read),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
