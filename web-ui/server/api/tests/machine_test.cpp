// The industrial PC by REST, with a helper that the test plays.
#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

#include "web-ui/server/api/tests/rig.hpp"
#include "web-ui/server/machine/tests/played_helper.hpp"

namespace flexrf::panel::machine_test {
namespace {

using fixture::ProducerAndConsumer;
using How = PlayedHelper::How;
using Reaction = PlayedHelper::Reaction;

constexpr const char* token = "0123456789abcdef0123456789abcdef";

const json idle_state = {
    {"ok", true},
    {"application", "pick-station"},
    {"version", "20261128T001500Z-4fb48992"},
    {"built", 1795824900},
    {"slot", "A"},
    {"boot", "confirmed"},
    {"slots", {{"A", {{"version", "x"}, {"whole", true}, {"primary", true}}}}},
    {"notices", json::array({"a \"notice\""})},
    {"hosts", json::array({"cell7.example.org"})},
    {"update", {{"phase", "verified"}, {"application", "pick-station"}, {"version", "20261201T1"}}},
};

/// A helper that does what it is asked for, and notes it; a test may put another answer in its place.
class Helper {
 public:
  Helper()
      : played_(place_.path(), [this](const std::string& line, const std::string& bytes) {
          return react(json::parse(line), bytes);
        }) {}

  const std::string& path() const { return place_.path(); }
  void say(const std::string& verb, Reaction reaction) {
    const std::lock_guard lock(mutex_);
    said_[verb] = std::move(reaction);
  }
  void say(const std::string& verb, const json& answer) { say(verb, Reaction{How::answers, answer.dump()}); }
  std::vector<json> asked(const std::string& verb) {
    const std::lock_guard lock(mutex_);
    std::vector<json> requests;
    for (const json& request : requests_)
      if (request.at("verb") == verb) requests.push_back(request);
    return requests;
  }
  std::size_t bytes() const { return bytes_; }

 private:
  Reaction react(const json& request, const std::string& bytes) {
    const std::lock_guard lock(mutex_);
    requests_.push_back(request);
    bytes_ += bytes.size();
    const std::string verb = request.at("verb");
    if (const auto found = said_.find(verb); found != said_.end()) return found->second;
    if (verb == "state") return {How::answers, idle_state.dump()};
    json answer = {{"ok", true}};
    if (verb == "upload") answer["upload"] = token;
    if (verb == "make-room") answer["freed"] = 1234;
    if (verb == "part") answer["received"] = request.at("offset").get<std::size_t>() + bytes.size();
    return {How::answers, answer.dump()};
  }

  SocketPlace place_;
  std::mutex mutex_;
  std::vector<json> requests_;
  std::atomic<std::size_t> bytes_{0};
  std::map<std::string, Reaction> said_;
  PlayedHelper played_;
};

struct World {
  World() : rig(cell, Rig::patient, fixture::on_the_wall_clock(), helper.path()) { rig.start(); }
  Answer post(const std::string& what, const json& body, SessionIndex session = an_admin) {
    return rig.request(Method::post, "machine/" + what, session, body.dump());
  }
  Answer put(const std::string& bytes, const std::string& query, SessionIndex session = an_admin,
             const std::string& type = "application/octet-stream") {
    return rig.request(Method::put, "machine/bundle", session, bytes, "", "", query, type);
  }
  bool is_in_audit(const std::string& did, const std::string& what) {
    return rig.wait_until([&] {
      const json entries = rig.get("audit", an_admin).body.at("entries");
      return std::any_of(entries.begin(), entries.end(), [&](const json& entry) {
        return entry.at("did") == did && entry.value("what", "") == what &&
               entry.at("who") == "adam (192.168.0.7)";
      });
    });
  }
  Helper helper;
  ProducerAndConsumer cell;
  Rig rig;
};

std::string detail(const Answer& answer) {
  return answer.body.at("detail").get<std::string>();
}

void everybody_sees_how_the_pc_is() {
  World world;
  const Answer answer = world.rig.get("machine");
  CHECK_EQUAL(answer.status, 200U);
  json expected = idle_state;
  expected.erase("ok");
  CHECK(answer.body == expected);
  CHECK_EQUAL(world.rig.get("machine", no_session).status, 403U);
  PlayedLink& link = world.rig.connect(a_viewer);
  CHECK(world.rig.event(link, "hello").at("machine") == true);
}

void without_a_pc_there_is_nothing() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  CHECK_EQUAL(rig.get("machine").status, 404U);
  CHECK_CONTAINS(detail(rig.get("machine")), "does not run on a FlexRF PC");
  CHECK_EQUAL(rig.request(Method::post, "machine/restart", an_admin, R"({"password": "p"})").status, 404U);
  PlayedLink& link = rig.connect(a_viewer);
  CHECK(rig.event(link, "hello").at("machine") == false);
}

void an_admin_updates_the_pc() {
  World world;
  const Answer begun = world.post("upload", {{"password", "secret of adam"}, {"size", 5}});
  CHECK_EQUAL(begun.status, 200U);
  CHECK(begun.body == json({{"upload", token}}));
  CHECK(world.helper.asked("upload").at(0) ==
        json({{"verb", "upload"}, {"user", "adam"}, {"password", "secret of adam"}, {"size", 5}}));
  const Answer part = world.put(std::string("a\n\0c", 4), std::string{"upload="} + token + "&offset=1");
  CHECK_EQUAL(part.status, 200U);
  CHECK(part.body == json({{"received", 5}}));
  CHECK_EQUAL(world.helper.bytes(), 4U);
  CHECK(world.helper.asked("part").at(0) == json({{"verb", "part"}, {"upload", token}, {"offset", 1}}));
  world.rig.get("machine");  // what it is that is installed
  CHECK(world.post("install", {{"password", "secret of adam"}, {"older", true}, {"other_drivers", true}})
            .body == json::object());
  CHECK(world.helper.asked("install").at(0).at("older") == true);
  CHECK(world.helper.asked("install").at(0).at("other_drivers") == true);
  CHECK_EQUAL(world.post("install", {{"password", "p"}}).status, 200U);
  CHECK(world.helper.asked("install").at(1).at("older") == false);
  CHECK(world.helper.asked("install").at(1).at("other_drivers") == false);
  CHECK_EQUAL(world.post("choose", {{"password", "p"}, {"slot", "B"}, {"other_drivers", true}}).status, 200U);
  CHECK(world.helper.asked("choose").at(0).at("slot") == "B");
  CHECK_EQUAL(world.post("restart", {{"password", "p"}}).status, 200U);
  CHECK(world.is_in_audit("began to upload an update", "(5 bytes)"));
  CHECK(world.is_in_audit("began to install",
                          "pick-station 20261201T1, though it is older, with other drivers"));
  CHECK(world.is_in_audit("chose for the next start the slot", "B, with other drivers"));
  CHECK(world.is_in_audit("restarted the PC", ""));
  CHECK_EQUAL(
      world.post("network", {{"password", "p"}, {"interface", "enp0s2"}, {"address", "10.0.2.16/24"}}).status,
      200U);
  CHECK(world.helper.asked("network").at(0) == json({{"verb", "network"},
                                                     {"user", "adam"},
                                                     {"password", "p"},
                                                     {"interface", "enp0s2"},
                                                     {"address", "10.0.2.16/24"},
                                                     {"gateway", ""}}));
  CHECK_EQUAL(world.post("keep-network", {{"password", "p"}}).status, 200U);
  CHECK(world.helper.asked("keep-network").at(0) ==
        json({{"verb", "keep-network"}, {"user", "adam"}, {"password", "p"}, {"reached_by", "10.0.2.16"}}));
  CHECK(world.is_in_audit("set the address of", "enp0s2: 10.0.2.16/24"));
  CHECK(world.is_in_audit("kept the address", ""));
  CHECK_EQUAL(world.post("dismiss-failure", {{"password", "p"}, {"slot", "B"}}).status, 200U);
  CHECK(world.helper.asked("dismiss-failure").at(0) ==
        json({{"verb", "dismiss-failure"}, {"user", "adam"}, {"password", "p"}, {"slot", "B"}}));
  CHECK(world.is_in_audit("dismissed the failure of the slot", "B"));
  CHECK(world.post("make-room", {{"password", "p"}, {"what", "logs"}}).body == json({{"freed", 1234}}));
  CHECK(world.helper.asked("make-room").at(0) ==
        json({{"verb", "make-room"}, {"user", "adam"}, {"password", "p"}, {"what", "logs"}}));
  CHECK(world.is_in_audit("made room for data", "logs"));
  CHECK_EQUAL(world.post("hosts", {{"password", "p"}, {"hosts", "cell7.example.org 203.0.113.7"}}).status,
              200U);
  CHECK(world.helper.asked("hosts").at(0) == json({{"verb", "hosts"},
                                                   {"user", "adam"},
                                                   {"password", "p"},
                                                   {"hosts", "cell7.example.org 203.0.113.7"}}));
  CHECK_EQUAL(world.post("hosts", {{"password", "p"}, {"hosts", ""}}).status, 200U);
  CHECK(world.is_in_audit("declared as other addresses of the PC", "cell7.example.org 203.0.113.7"));
  CHECK(world.is_in_audit("declared as other addresses of the PC", "(none)"));
  const std::string told = world.rig.get("audit", an_admin).body.dump() + world.rig.get("log").body.dump();
  CHECK(told.find("secret of adam") == std::string::npos);
}

void others_change_nothing() {
  World world;
  CHECK_EQUAL(world.post("upload", {{"password", "p"}, {"size", 5}}, an_engineer).status, 403U);
  CHECK_EQUAL(world.post("restart", {{"password", "p"}}, an_engineer).status, 403U);
  CHECK_EQUAL(world.post("dismiss-failure", {{"password", "p"}, {"slot", "B"}}, an_engineer).status, 403U);
  CHECK_EQUAL(world.post("hosts", {{"password", "p"}, {"hosts", "cell7"}}, an_engineer).status, 403U);
  CHECK_EQUAL(world.put("x", std::string{"upload="} + token + "&offset=0", an_engineer).status, 403U);
  CHECK(world.helper.asked("hosts").empty());
  CHECK(world.helper.asked("upload").empty() && world.helper.asked("restart").empty());
  CHECK_EQUAL(world.helper.bytes(), 0U);
}

void what_makes_no_sense_is_refused() {
  World world;
  const std::string query = std::string{"upload="} + token + "&offset=";
  CHECK_EQUAL(world.put("x", query + "0", an_admin, "application/json").status, 415U);
  CHECK_EQUAL(world.put("", query + "0").status, 415U);
  CHECK_EQUAL(world.put("x", query).status, 400U);
  CHECK_EQUAL(world.put("x", query + "-1").status, 400U);
  CHECK_EQUAL(world.put("x", "offset=0").status, 400U);
  CHECK_EQUAL(world.put("x", "upload=..%2F..&offset=0").status, 400U);
  CHECK_EQUAL(world.put(std::string(HelperClient::longest_part + 1, 'x'), query + "0").status, 413U);
  CHECK_EQUAL(world.put(std::string(HelperClient::longest_part, 'x'), query + "0").status, 200U);
  CHECK_EQUAL(world.post("upload", {{"password", "p"}}).status, 400U);
  CHECK_EQUAL(world.post("upload", {{"size", 5}}).status, 400U);
  CHECK_EQUAL(world.post("choose", {{"password", "p"}}).status, 400U);
  CHECK_EQUAL(world.post("dismiss-failure", {{"password", "p"}}).status, 400U);
  CHECK_EQUAL(world.post("make-room", {{"password", "p"}}).status, 400U);
  CHECK_EQUAL(world.post("install", {{"password", "p"}, {"older", "yes"}}).status, 400U);
  CHECK_EQUAL(world.post("network", {{"password", "p"}, {"interface", "enp0s2"}}).status, 400U);
  CHECK_EQUAL(world.post("hosts", {{"password", "p"}}).status, 400U);
  CHECK_EQUAL(world.post("hosts", {{"password", "p"}, {"hosts", json::array({"cell7"})}}).status, 400U);
  CHECK_EQUAL(world.post("hosts", {{"password", "p"}, {"hosts", std::string(2000, 'x')}}).status, 413U);
  CHECK_EQUAL(world.post("restart", {{"password", std::string(2000, 'x')}}).status, 413U);
  CHECK_EQUAL(world.rig.get("machine/restart", an_admin).status, 405U);
  CHECK(world.helper.asked("upload").empty() && world.helper.asked("restart").empty());
  CHECK(world.helper.asked("hosts").empty());
}

void only_the_bundle_takes_bytes() {
  World world;
  const auto with_bytes = [&](Method method, const std::string& path) {
    return world.rig.request(method, path, an_admin, "{}", "", "", "", "application/octet-stream").status;
  };
  for (const Route& route : routes()) {
    if (route.method == Method::get || route.resource == Resource::access ||
        route.resource == Resource::machine_bundle)
      continue;
    CHECK_EQUAL(with_bytes(route.method, std::string{route.path}), 415U);
  }
  CHECK(!world.rig.executive().control().motion_stopped());
}

void the_helpers_refusals_keep_status_and_words() {
  World world;
  world.helper.say("install",
                   {{"ok", false}, {"status", 409}, {"why", "The cell may move: give Stop motion."}});
  const Answer moving = world.post("install", {{"password", "p"}});
  CHECK_EQUAL(moving.status, 409U);
  CHECK_EQUAL(detail(moving), "The cell may move: give Stop motion.");
  CHECK_EQUAL(moving.reply.content_type, std::string_view{"application/problem+json"});
  world.helper.say("restart", {{"ok", false}, {"status", 429}, {"why", "Wait."}, {"retry_after", 8}});
  const Answer wait = world.post("restart", {{"password", "p"}});
  CHECK_EQUAL(wait.status, 429U);
  CHECK_EQUAL(wait.reply.retry_after, 8U);
  world.helper.say("choose", {{"ok", false}, {"status", 403}, {"why", "The password is wrong."}});
  CHECK_EQUAL(world.post("choose", {{"password", "p"}, {"slot", "B"}}).status, 403U);
  CHECK(world.is_in_audit("was not allowed to", "choose the slot"));
  CHECK(world.is_in_audit("was not allowed to", "restart the PC"));
  world.helper.say("part", {{"ok", false}, {"status", 409}, {"why", "Go on there."}, {"received", 61440}});
  const Answer resumed = world.put("x", std::string{"upload="} + token + "&offset=0");
  CHECK_EQUAL(resumed.status, 409U);
  CHECK(resumed.body.at("received") == 61440);
  world.helper.say("state", {{"ok", false}, {"status", 503}, {"why", "The boot choice cannot be read."}});
  CHECK_EQUAL(world.rig.get("machine").status, 503U);
}

void a_helper_that_is_of_no_use_is_told() {
  World world;
  const auto check_refused = [&](const Reaction& reaction, const char* words) {
    world.helper.say("state", reaction);
    world.helper.say("upload", reaction);
    for (const Answer& answer :
         {world.rig.get("machine"), world.post("upload", {{"password", "p"}, {"size", 5}})}) {
      CHECK_EQUAL(answer.status, 503U);
      CHECK_CONTAINS(detail(answer), words);
    }
  };
  check_refused({How::answers, "rubbish"}, "is not understood");
  check_refused({How::answers, "[]"}, "is not understood");
  check_refused({How::answers, "{}"}, "is not understood");
  check_refused({How::answers, R"({"ok":"yes"})"}, "is not understood");
  check_refused({How::answers, R"({"ok":true})"}, "is not understood");
  check_refused({How::answers, R"({"ok":false})"}, "is not understood");
  check_refused({How::answers, R"({"ok":false,"status":200,"why":"I like it."})"}, "is not understood");
  check_refused({How::answers, R"({"ok":false,"status":302,"why":"Elsewhere."})"}, "is not understood");
  check_refused({How::hangs_up, ""}, "ended before it answered");
  CHECK(world.rig.get("audit", an_admin).body.dump().find("upload") == std::string::npos);
}

void no_helper_is_told() {
  const SocketPlace nowhere;
  ProducerAndConsumer cell;
  Rig rig(cell, Rig::patient, fixture::on_the_wall_clock(), nowhere.path());
  rig.start();
  const Answer answer = rig.get("machine");
  CHECK_EQUAL(answer.status, 503U);
  CHECK_CONTAINS(detail(answer), "The PC's helper is not there");
}

/// Asks without waiting.
std::uint32_t ask(Rig& rig, Method method, const std::string& path, const std::string& body,
                  SessionIndex session, std::uint32_t exchange) {
  const std::string whole = "/api/v1/" + path;
  Request request;
  request.method = method;
  request.path = whole;
  request.body = body;
  request.content_type = "application/json";
  request.session = session;
  CHECK(rig.api().handle(request, rig.replies().waiting[exchange], {0, exchange}) == Handled::later);
  return exchange;
}

void all_who_ask_at_once_hear_the_same() {
  World world;
  world.helper.say("restart", Reaction{How::says_nothing, ""});
  constexpr std::uint32_t first = 1000;
  constexpr std::uint32_t count = 20;
  for (std::uint32_t i = 0; i < count; ++i) ask(world.rig, Method::get, "machine", "", a_viewer, first + i);
  // One of them closes its page.
  world.rig.replies().waiting.erase(first + 1);
  CHECK(world.rig.wait_until([&] { return world.rig.replies().completed.size() == count - 1; }));
  CHECK(world.helper.asked("state").size() <= 2);
  CHECK_EQUAL(world.rig.get("machine").status, 200U);
}

void eight_may_wait() {
  World world;
  world.helper.say("restart", Reaction{How::says_nothing, ""});
  for (std::uint32_t i = 0; i < HelperClient::places; ++i)
    ask(world.rig, Method::post, "machine/restart", R"({"password":"p"})", an_admin, 1000 + i);
  CHECK_EQUAL(world.post("restart", {{"password", "p"}}).status, 503U);
  CHECK_EQUAL(world.rig.get("machine").status, 503U);
}

}  // namespace
}  // namespace flexrf::panel::machine_test

int main() {
  using namespace flexrf::panel::machine_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(everybody_sees_how_the_pc_is),
      CONTAINED_TEST(without_a_pc_there_is_nothing),
      CONTAINED_TEST(an_admin_updates_the_pc),
      CONTAINED_TEST(others_change_nothing),
      CONTAINED_TEST(what_makes_no_sense_is_refused),
      CONTAINED_TEST(only_the_bundle_takes_bytes),
      CONTAINED_TEST(the_helpers_refusals_keep_status_and_words),
      CONTAINED_TEST(a_helper_that_is_of_no_use_is_told),
      CONTAINED_TEST(no_helper_is_told),
      CONTAINED_TEST(all_who_ask_at_once_hear_the_same),
      CONTAINED_TEST(eight_may_wait),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
