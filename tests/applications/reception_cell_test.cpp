// Remote control in a whole cell: in virtual time with scripts that the test plays at the mock's far ends,
// and on the wall clock over the loopback interface.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "remote_control_unit.hpp"
#include "tests/applications/reception_play.hpp"

namespace flexrf::whole {
namespace {

// ---- in virtual time

void what_is_no_request_is_told_so() {
  const Safe safe;
  Play play;
  play.call(0);
  play.is_refused(0, "garbage", -32700, "no JSON");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": 1, "method": "read")", -32700, "line feed");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": NaN, "method": "state"})", -32700, "NaN");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": 1e999, "method": "state"})", -32700, "JSON");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": 123456789012345678901234567890, "method": "state"})", -32700,
                  "JSON");
  play.is_refused(0, std::string(40, '[') + std::string(40, ']'), -32700, "16 levels");
  play.is_refused(0, "\xFF\xFE", -32700, "JSON");
  play.is_refused(0, "7", -32600, "no object");
  play.is_refused(0, R"([{"jsonrpc": "2.0", "id": 1, "method": "state"}])", -32600, "batch");
  play.is_refused(0, R"({"jsonrpc": "2.0", "jsonrpc": "2.0"})", -32600, "comes twice");
  play.is_refused(0, R"({"jsonrpc": "1.0", "id": 1, "method": "state"})", -32600, "jsonrpc");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": 1.5, "method": "state"})", -32600, "'id'");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": 1, "method": 1})", -32600, "'method'");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": 1, "method": "state", "params": 7})", -32600, "'params'");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": 1, "method": "read", "params": ["pose"]})", -32602,
                  "position");
  play.is_refused(0, R"({"jsonrpc": "2.0", "id": 1, "method": "raed"})", -32601, "did you mean 'read'");
  play.is_refused(0, "list", {{"of", "slot"}}, -32602, "did you mean 'slots'");
  play.is_refused(0, "read", json::object(), -32602, "'slot'");
  // A line in halves, several at once, and one that nobody wants answered.
  play.give(0, R"({"jsonrpc": "2.0", "id": "ha)");
  play.wait(std::chrono::seconds{1});
  play.give(0, std::string{R"(lf", "method": "state"})"} + "\r\n\n" +
                   R"({"jsonrpc": "2.0", "method": "state"})" + "\n" +
                   R"({"jsonrpc": "2.0", "id": null, "method": "state"})" + "\n");
  play.expect(0, [](const json& line) { CHECK_EQUAL(line.at("id").get<std::string>(), "half"); });
  play.expect(0, [](const json& line) { CHECK(line.at("id").is_null() && line.contains("result")); });
  play.perform_all();
}

void without_a_token_scripts_look() {
  const Safe safe;
  Play play;
  play.call(0);
  play.ask(0, "state", json::object(), [](const json& result) {
    CHECK_EQUAL(result.at("mode").get<std::string>(), "running");
    CHECK(!result.at("remote").get<bool>());
  });
  play.ask(0, "list", {{"of", "slots"}},
           [](const json& result) { CHECK_CONTAINS(result.dump(), "mixer.feedback"); });
  play.ask(0, "list", {{"of", "components"}}, [](const json& result) {
    CHECK_EQUAL(result.at("components").size(), 4U);
    CHECK(result.at("next").is_null());
  });
  play.ask(0, "list", {{"of", "parameters"}, {"component", "mixer"}, {"from", 1}}, [](const json& result) {
    CHECK_EQUAL(result.at("parameters").at(0).at("name").get<std::string>(), "count");
  });
  play.wait(std::chrono::milliseconds{100});
  play.ask(0, "read", {{"slot", "pose"}}, [](const json& result) {
    CHECK_EQUAL(result.at("type").get<std::string>(), "Pose");
    CHECK_EQUAL(result.at("reason").get<std::string>(), "");
    CHECK(result.at("value").at("position").at(0).get<double>() > 1.0);
  });
  play.ask(0, "read", {{"component", "mixer"}}, [](const json& result) {
    CHECK_EQUAL(result.at("runtime").at("gain").get<double>(), 1.0);
    CHECK_EQUAL(result.at("feedback").at("kicks").get<int>(), 0);
  });
  play.ask(0, "read", {{"component", "door"}},
           [](const json& result) { CHECK_EQUAL(result.at("configuration").at("buffer").get<int>(), 8192); });
  play.is_refused(0, "read", {{"slot", "posse"}}, -32004, "did you mean 'pose'");
  play.is_refused(0, "read", {{"component", "mixter"}}, -32004, "did you mean 'mixer'");
  play.is_refused(0, "set", {{"component", "mixer"}, {"values", {{"gain", 2}}}}, -32001, "token");
  play.is_refused(0, "press", {{"component", "mixer"}, {"parameter", "kick"}}, -32001, "token");
  // Whoever sees the cell may stop it; nobody may start it from here.
  play.do_once([&] { CHECK(!play.cell().control().motion_stopped()); });
  play.ask(0, "stop_motion", json::object());
  play.do_once([&] { CHECK(play.cell().control().motion_stopped()); });
  play.is_refused(0, "start_motion", json::object(), -32601, "did you mean 'stop_motion'");
  play.perform_all();
}

void queues_and_threads_are_seen_by_name() {
  const Safe safe;
  Play play;
  play.let_in(0);
  play.set_remote(true);
  play.ask(0, "list", {{"of", "queues"}}, [](const json& result) {
    CHECK(result ==
          json({{"queues", {{{"name", "kicked"}, {"type", "Pose"}, {"capacity", 2}}}}, {"next", nullptr}}));
  });
  play.ask(0, "list", {{"of", "threads"}}, [](const json& result) {
    const json& threads = result.at("threads");
    CHECK_EQUAL(threads.size(), 2U);
    CHECK(std::find(threads.begin(), threads.end(), json({{"name", "service"}, {"priority", 0}})) !=
          threads.end());
  });
  play.ask(0, "list", {{"of", "threads"}, {"from", 1}}, [](const json& result) {
    CHECK_EQUAL(result.at("threads").size(), 1U);
    CHECK(result.at("next").is_null());
  });
  play.ask(0, "press", {{"component", "mixer"}, {"parameter", "kick"}, {"count", 3}});
  play.wait(std::chrono::milliseconds{50});
  play.ask(0, "read", {{"queue", "kicked"}}, [](const json& result) {
    CHECK(result ==
          json({{"name", "kicked"},
                {"type", "Pose"},
                {"capacity", 2},
                {"fill", 2},
                {"writers", {{{"name", "mixer.kicked"}, {"pushed", 2}, {"popped", 0}, {"dropped", 1}}}},
                {"readers", {"conductor.kicked"}}}));
  });
  play.ask(0, "read", {{"thread", "work"}}, [](const json& result) {
    CHECK_EQUAL(result.at("name").get<std::string>(), "work");
    CHECK(result.at("cycles").get<std::uint64_t>() > 10);
    CHECK_EQUAL(result.at("overruns").get<int>(), 0);
    for (const char* const figure :
         {"priority", "skipped", "skipped_time_ns", "longest_standstill_ns", "budget_ns", "deadline_ns"})
      CHECK(result.at(figure).is_number());
    for (const char* const measured : {"lateness", "execution"}) {
      for (const char* const quantile : {"count", "p50_ns", "p99_ns", "p99.9_ns", "max_ns"})
        CHECK(result.at(measured).at(quantile).is_number());
    }
  });
  play.is_refused(0, "read", {{"queue", "kickde"}}, -32004, "did you mean 'kicked'");
  play.is_refused(0, "read", {{"thread", "pose"}}, -32004, "There is no thread 'pose'");
  play.is_refused(0, "read", {{"thread", "work"}, {"queue", "kicked"}}, -32602, "several");
  play.is_refused(0, "list", {{"of", "thread"}}, -32602, "did you mean 'threads'");
  play.perform_all();
}

void with_it_and_permission_they_change() {
  const Safe safe;
  Play play;
  play.call(0);
  play.ask(0, "authenticate", {{"token", secret}});
  play.is_refused(0, "set", {{"component", "mixer"}, {"values", {{"gain", 2}}}}, -32002, "remote.remote");
  play.set_remote(true);
  std::uint64_t sequence = 0;
  play.ask(0, "set", {{"component", "mixer"}, {"values", {{"gain", 2.5}, {"label", "a\"b"}}}},
           [&](const json& result) {
             CHECK_EQUAL(result.at("values").at("gain").get<double>(), 2.5);
             CHECK_EQUAL(result.at("values").at("label").get<std::string>(), "a\"b");
             sequence = result.at("sequence").get<std::uint64_t>();
             CHECK(sequence > 0);
           });
  play.ask(0, "press", {{"component", "mixer"}, {"parameter", "kick"}, {"count", 3}});
  play.wait(std::chrono::milliseconds{50});
  play.ask(0, "read", {{"slot", "mixer.feedback"}},
           [](const json& result) { CHECK_EQUAL(result.at("value").at("kicks").get<int>(), 3); });
  const auto set = [&](const json& values, int code, const char* word) {
    play.is_refused(0, "set", {{"component", "mixer"}, {"values", values}}, code, word);
  };
  set({{"gain", 11}}, -32005, "10");
  set({{"gain", "2"}}, -32005, "a number");
  set({{"gain", 2}, {"count", 256}}, -32005, "from 0 to 255");
  set({{"gain", 2}, {"count", 1.5}}, -32005, "integer");
  set({{"count", 13}}, -32005, "bad luck");
  set({{"label", "more than sixteen"}}, -32005, "at most 16");
  set({{"gian", 2}}, -32004, "did you mean 'gain'");
  set({{"trim", {1, 2, 3}}}, -32003, "engineers");
  set({{"move", true}}, -32005, "held");
  set({{"kick", 1}}, -32005, "pressed");
  set(json::object(), -32602, "empty");
  play.is_refused(0, "press", {{"component", "mixer"}, {"parameter", "gain"}}, -32005, "no button");
  play.is_refused(0, "press", {{"component", "mixer"}, {"parameter", "move"}}, -32005, "only a person");
  play.is_refused(0, "press", {{"component", "mixer"}, {"parameter", "kick"}, {"count", 101}}, -32602, "100");
  play.is_refused(0, "press", {{"component", "mixer"}, {"parameter", "fire"}}, -32005,
                  "mixer.fire has no effect now: needs armed to be on");
  play.is_refused(0, "set", {{"component", "remote"}, {"values", {{"remote", true}}}}, -32003,
                  "not for scripts");
  play.is_refused(0, "set", {{"component", "mixer"}, {"values", {{"gain", 3}}}, {"expected", 1}}, -32006,
                  "changed");
  // What was refused changed nothing; the permission ends at once.
  play.ask(0, "read", {{"component", "mixer"}},
           [&](const json& result) { CHECK_EQUAL(result.at("runtime").at("gain").get<double>(), 2.5); });
  play.set_remote(false);
  play.is_refused(0, "set", {{"component", "mixer"}, {"values", {{"gain", 2}}}}, -32002, "panel");
  play.perform_all();
}

void what_they_set_is_saved_when_they_ask() {
  const Safe safe;
  Options options = simulated();
  options.configuration_file = "cell.xml";
  Play play(options);
  play.call(0);
  play.ask(0, "authenticate", {{"token", secret}});
  play.is_refused(0, "save_values", json::object(), -32002, "remote.remote");
  play.set_remote(true);
  play.ask(0, "set", {{"component", "mixer"}, {"values", {{"gain", 2.5}}}});
  play.ask(0, "state", json::object(), [](const json& result) {
    CHECK(result.at("values") == json({{"file", true}, {"unsaved", true}, {"failure", ""}}));
  });
  play.ask(0, "save_values", json::object(),
           [](const json& result) { CHECK(result.at("saved_at_ms").get<std::int64_t>() > 0); });
  play.do_once([&] { CHECK_CONTAINS(contents_of(safe.folder / "cell.xml"), ">2.5</gain>"); });
  play.ask(0, "state", json::object(),
           [](const json& result) { CHECK(result.at("values").at("unsaved") == false); });
  play.do_once([&] { CHECK(::mkdir((safe.folder / "cell.xml.new").c_str(), 0700) == 0); });
  play.ask(0, "set", {{"component", "mixer"}, {"values", {{"gain", 3}}}});
  play.is_refused(0, "save_values", json::object(), -32005, "cannot create");
  play.do_once([&] { CHECK(::rmdir((safe.folder / "cell.xml.new").c_str()) == 0); });
  play.perform_all();
  CHECK_CONTAINS(contents_of(safe.folder / "cell.xml"), ">3</gain>");
}

void without_a_file_they_cannot_save() {
  const Safe safe;
  Play play;
  play.let_in(0);
  play.is_refused(0, "save_values", json::object(), -32005, "--config FILE");
  play.perform_all();
}

void a_wrong_token_ends_the_connection() {
  const Safe safe;
  Play play;
  play.call(0);
  play.is_refused(0, "authenticate", {{"token", "0123456789abcdef0123456789abcdeF"}}, -32001,
                  "not the token");
  play.then([&] { return !play.far_ends().is_open(0); });
  play.call(1);
  play.is_refused(1, "authenticate", json::object(), -32602, "missing");
  play.is_refused(1, "authenticate", {{"token", ""}}, -32001, "not the token");
  play.then([&] { return !play.far_ends().is_open(1); });
  play.call(2);
  play.ask(2, "read", {{"slot", "remote.feedback"}}, [](const json& result) {
    CHECK_EQUAL(result.at("value").at("wrong_tokens").get<int>(), 2);
    CHECK_EQUAL(result.at("value").at("sent_away").get<int>(), 2);
  });
  play.perform_all();
}

void initialised_anew_it_knows_nobody() {
  const Safe safe;
  Play play;
  play.let_in(0);
  bool done = false;
  play.do_once([&] {
    play.executive().act(ComponentAction::initialise, play.component("remote"), [&](const Status& status) {
      CHECK(status.is_ok());
      done = true;
    });
  });
  play.then([&] { return done; });
  play.is_refused(0, "set", {{"component", "mixer"}, {"values", {{"gain", 3}}}}, -32001, "has not given");
  play.ask(0, "authenticate", {{"token", secret}});
  play.ask(0, "set", {{"component", "mixer"}, {"values", {{"gain", 3}}}});
  play.perform_all();
}

void subscribers_get_the_newest_at_their_rate() {
  const Safe safe;
  Play play;
  play.call(0);
  play.is_refused(0, "subscribe", {{"slots", {{{"name", "posse"}}}}}, -32004, "did you mean 'pose'");
  play.is_refused(0, "subscribe", {{"slots", {{{"name", "pose"}, {"rate", 1000}}}}}, -32602, "60");
  play.ask(0, "subscribe", {{"slots", {{{"name", "pose"}, {"rate", 5}}, "door.feedback"}}},
           [](const json& result) { CHECK_EQUAL(result.at("slots").size(), 2U); });
  play.ask(0, "unsubscribe", {{"slots", {"door.feedback"}}},
           [](const json& result) { CHECK_EQUAL(result.dump(), R"({"slots":["pose"]})"); });
  std::vector<std::uint64_t> sequences;
  for (int i = 0; i < 4; ++i) {
    play.expect(
        0,
        [&](const json& line) {
          CHECK_EQUAL(line.at("method").get<std::string>(), "slot");
          CHECK(!line.contains("id"));
          CHECK_EQUAL(line.at("params").at("name").get<std::string>(), "pose");
          sequences.push_back(line.at("params").at("sequence").get<std::uint64_t>());
        },
        Play::Line::update);
  }
  play.do_once([&] {
    // The mixer publishes 200 times a second: 40 between two that are 200 ms apart.
    for (std::size_t i = 1; i < sequences.size(); ++i) CHECK(sequences[i] >= sequences[i - 1] + 38);
  });
  play.perform_all();
}

void who_does_not_read_delays_nobody() {
  const Safe safe;
  Play play;
  play.call(0);
  play.call(1);
  play.ask(1, "state", json::object());
  play.do_once([&] { play.far_ends().set_reads(0, false); });
  play.give(
      0, R"({"jsonrpc": "2.0", "method": "subscribe", "params": {"slots": [{"name": "pose", "rate": 60}]}})"
         "\n");
  play.wait(std::chrono::seconds{5});
  for (int i = 0; i < 20; ++i) play.ask(1, "state", json::object());
  play.ask(1, "read", {{"slot", "remote.feedback"}}, [](const json& result) {
    CHECK(result.at("value").at("dropped").get<int>() > 100);
    CHECK_EQUAL(result.at("value").at("sent_away").get<int>(), 0);
  });
  // It reads again: what had waited, and then the newest, which says how many it did not get.
  play.do_once([&] { play.far_ends().set_reads(0, true); });
  play.then([&] {
    const std::string_view got = play.far_ends().got(0);
    const std::size_t last = got.rfind("\"dropped\":");
    return last != std::string_view::npos && std::atoi(std::string(got.substr(last + 10, 8)).c_str()) > 100;
  });
  // Answers are not left out; who never reads them is sent away.
  play.do_once([&] { play.far_ends().set_reads(0, false); });
  for (int i = 0; i < 40; ++i)
    play.give(0, R"({"jsonrpc": "2.0", "id": 1, "method": "list", "params": {"of": "slots"}})"
                 "\n");
  play.then([&] { return !play.far_ends().is_open(0); });
  play.ask(1, "state", json::object());
  play.perform_all();
}

void lines_have_an_end() {
  const Safe safe;
  Play play;
  play.call(0);
  play.give(0, std::string(9000, 'x') + "\n");
  play.ask(0, "state", json::object());
  play.wait(std::chrono::milliseconds{50});
  play.ask(0, "read", {{"slot", "door.feedback"}},
           [](const json& result) { CHECK_EQUAL(result.at("value").at("long_lines").get<int>(), 1); });
  // One too many is refused; a place that was left is given again.
  play.call(1);
  play.call(2);
  play.ask(1, "state", json::object());
  play.ask(2, "state", json::object());
  play.call(3);
  play.then([&] { return !play.far_ends().is_open(3); });
  play.do_once([&] { play.far_ends().end(0); });
  play.then([&] { return !play.far_ends().is_open(0); });
  play.call(4);
  play.ask(4, "state", json::object());
  play.perform_all();
}

/// What the operator reads where the unit does not start.
std::string fault_of_remote(const std::function<void(Play&)>& prepare) {
  Play play;
  prepare(play);
  const RunSummary summary = play.run();
  CHECK(summary.exit_code != 0);
  return application::application.unit_states[play.component("remote")].fault.read().cause();
}

void other_machines_need_a_key() {
  const Safe safe;
  CHECK_CONTAINS(fault_of_remote([](Play& play) { play.door().set_address("tcp:0.0.0.0:5000"); }),
                 "other machines reach");
}

void other_machines_need_a_token() {
  const Safe safe;
  CHECK_CONTAINS(fault_of_remote([](Play& play) {
                   play.door().set_address("tcp::5000");
                   play.remote().other_machines = true;
                   play.remote().set_token_file("");
                 }),
                 "there is no token");
}

void a_door_must_listen() {
  const Safe safe;
  CHECK_CONTAINS(fault_of_remote([](Play& play) { play.door().listen = false; }), "listen = true");
}

void a_door_must_have_room() {
  const Safe safe;
  CHECK_CONTAINS(fault_of_remote([](Play& play) { play.door().buffer = 1024; }), "at least 4096");
}

void a_token_that_others_read_is_refused() {
  const Safe safe(std::string{secret} + "\n", 0640);
  CHECK_CONTAINS(fault_of_remote([](Play&) {}), "0600");
}

void other_machines_look_with_the_token_only() {
  const Safe safe;
  Play play;
  play.door().set_address("tcp::5000");
  play.remote().other_machines = true;
  play.call(0);
  play.call(1);
  play.is_refused(0, "read", {{"slot", "pose"}}, -32001, "authenticate");
  play.is_refused(0, "stop_motion", json::object(), -32001, "authenticate");
  play.ask(0, "authenticate", {{"token", secret}});
  play.ask(0, "read", {{"slot", "pose"}});
  play.then([&] { return !play.far_ends().is_open(1); });  // gave none in time
  play.ask(0, "read", {{"slot", "pose"}});
  play.perform_all();
}

// ---- on the wall clock

constexpr int patience = 60'000;  // ms

class Script {
 public:
  explicit Script(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    CHECK(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }
  ~Script() { ::close(socket_); }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  json ask(const std::string& method, const json& params) {
    const std::string text =
        json{{"jsonrpc", "2.0"}, {"id", ++id_}, {"method", method}, {"params", params}}.dump() + "\n";
    CHECK(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size()));
    for (;;) {
      json line = next();
      if (line.contains("id")) return line;
    }
  }
  json next() {
    for (;;) {
      if (const std::size_t end = heard_.find('\n'); end != std::string::npos) {
        json line = json::parse(heard_.substr(0, end));
        heard_.erase(0, end + 1);
        return line;
      }
      pollfd wanted{socket_, POLLIN, 0};
      char bytes[4096];
      CHECK(::poll(&wanted, 1, patience) == 1);
      const ssize_t count = ::recv(socket_, bytes, sizeof bytes, 0);
      CHECK(count > 0);
      heard_.append(bytes, static_cast<std::size_t>(count));
    }
  }

 private:
  int socket_;
  std::string heard_;
  int id_ = 0;
};

void over_the_loopback_interface() {
  const Safe safe;
  Running cell(application::application);
  std::uint16_t port = 0;
  CHECK(wait_until([&] {
    const json feedback = cell.newest("door.feedback");
    port = feedback.is_null() ? std::uint16_t{0} : feedback.at("port").get<std::uint16_t>();
    return port != 0;
  }));
  Script script(port);
  Script watcher(port);
  CHECK_EQUAL(
      watcher.ask("subscribe", {{"slots", {{{"name", "mixer.values"}, {"rate", 60}}}}}).contains("result"),
      true);
  CHECK_CONTAINS(script.ask("set", {{"component", "mixer"}, {"values", {{"gain", 2}}}}).dump(), "-32001");
  CHECK(script.ask("authenticate", {{"token", secret}}).contains("result"));
  CHECK_CONTAINS(script.ask("set", {{"component", "mixer"}, {"values", {{"gain", 2}}}}).dump(), "-32002");
  ParameterRequest permission;
  permission.component = cell.unit("remote");
  const bool on = true;
  CHECK(permission.add(0, 0, &on, sizeof(on)));
  CHECK(cell.ask(permission).kind == AnswerKind::accepted);
  const json answer = script.ask("set", {{"component", "mixer"}, {"values", {{"gain", 2}}}});
  CHECK_EQUAL(answer.at("result").at("values").at("gain").get<double>(), 2.0);
  while (watcher.next().at("params").at("value").at("gain").get<double>() != 2.0) {
  }
  CHECK(script.ask("press", {{"component", "mixer"}, {"parameter", "kick"}}).contains("result"));
  CHECK(wait_until([&] {
    const json feedback = script.ask("read", {{"slot", "mixer.feedback"}});
    return feedback.at("result").at("value").at("kicks").get<int>() == 1;
  }));
  CHECK_EQUAL(cell.stop().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(what_is_no_request_is_told_so),
      TEST_APART(without_a_token_scripts_look),
      TEST_APART(queues_and_threads_are_seen_by_name),
      TEST_APART(with_it_and_permission_they_change),
      TEST_APART(what_they_set_is_saved_when_they_ask),
      TEST_APART(without_a_file_they_cannot_save),
      TEST_APART(a_wrong_token_ends_the_connection),
      TEST_APART(initialised_anew_it_knows_nobody),
      TEST_APART(subscribers_get_the_newest_at_their_rate),
      TEST_APART(who_does_not_read_delays_nobody),
      TEST_APART(lines_have_an_end),
      TEST_APART(other_machines_need_a_key),
      TEST_APART(other_machines_need_a_token),
      TEST_APART(a_door_must_listen),
      TEST_APART(a_door_must_have_room),
      TEST_APART(a_token_that_others_read_is_refused),
      TEST_APART(other_machines_look_with_the_token_only),
      TEST_APART(over_the_loopback_interface),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
