// Remote control's test cell in virtual time: the test plays scripts at the mock's far ends.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <functional>
#include <utility>
#include <vector>

#include "hal/socket/stream/mock/mock_stream_socket.hpp"
#include "tests/applications/process.hpp"
#include "tests/applications/reception/units/conductor/conductor.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {

using namespace user;  // types and units of the tables

using nlohmann::json;

inline constexpr const char* secret = "0123456789abcdef0123456789abcdef";

/// The folder that the application's token lies in.
struct Safe {
  Folder folder;
  explicit Safe(const std::string& content = std::string{secret} + "\n", mode_t mode = 0600) {
    write_file(folder / "token", content);
    CHECK(::chmod((folder / "token").c_str(), mode) == 0);
    CHECK(::chdir(folder.path().c_str()) == 0);
  }
};

inline Options simulated() {
  Options options;
  options.virtual_time = std::chrono::seconds{120};
  options.hardware = {{"", "mock"}};
  options.realtime = false;
  return options;
}

/// A cell in virtual time, and what scripts do in it, one act after the other: each is asked in every step of
/// the conductor until it says that it is done.
class Play {
 public:
  using Act = std::function<bool()>;

  explicit Play(Options options = simulated()) : executive_(application::application, std::move(options)) {
    const Status status = executive_.prepare();
    if (!status) throw fixture::CheckFailed{status.cause()};
    requester_ = cell().add_requester(answers_);
    door_ = dynamic_cast<MockStreamSocket*>(application::application.device_states[0].device);
    CHECK(door_ != nullptr);
  }
  ~Play() { Conductor::score = nullptr; }

  Cell& cell() { return executive_.cell(); }
  MockStreamTransport& far_ends() { return door_->far_ends(); }
  Executive& executive() { return executive_; }

  void then(Act act) { acts_.push_back(std::move(act)); }
  void do_once(std::function<void()> act) {
    then([act = std::move(act)] {
      act();
      return true;
    });
  }
  void call(std::size_t script) {
    do_once([this, script] { CHECK_EQUAL(far_ends().connect_to_it(), script); });
  }
  void give(std::size_t script, const std::string& bytes) {
    do_once([this, script, bytes] { CHECK(far_ends().give(script, bytes)); });
  }
  /// The next line of a kind that a script gets: an answer, or what it subscribed to.
  enum class Line : std::uint8_t { answer, update };
  void expect(std::size_t script, std::function<void(const json&)> check, Line kind = Line::answer) {
    then([this, script, kind, check = std::move(check)] {
      if (read_.size() <= script) read_.resize(script + 1);
      for (;;) {
        const std::string_view rest = far_ends().got(script).substr(read_[script]);
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) return false;
        read_[script] += end + 1;
        const json line = json::parse(rest.substr(0, end));
        if (line.contains("method") != (kind == Line::update)) continue;
        check(line);
        return true;
      }
    });
  }
  /// A request, and what comes as its answer.
  void ask(
      std::size_t script, const std::string& method, const json& params,
      std::function<void(const json& result)> check = [](const json&) {}) {
    const int id = ++last_id_;
    give(script, json{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", params}}.dump() + "\n");
    expect(script, [id, method, check = std::move(check)](const json& line) {
      if (!line.contains("result")) throw fixture::CheckFailed{method + ": " + line.dump()};
      CHECK_EQUAL(line.at("id").get<int>(), id);
      check(line.at("result"));
    });
  }
  /// A line that is answered by an error: its code, and a word of its reason and hint.
  void is_refused(std::size_t script, const std::string& line, int code, const std::string& word) {
    give(script, line + "\n");
    expect(script, [line, code, word](const json& answer) {
      if (!answer.contains("error")) throw fixture::CheckFailed{line + ": " + answer.dump()};
      CHECK_CONTAINS(answer.dump(), word);
      CHECK_EQUAL(answer.at("error").at("code").get<int>(), code);
      CHECK_EQUAL(answer.at("jsonrpc").get<std::string>(), "2.0");
      CHECK(!answer.at("error").at("data").at("hint").get<std::string>().empty());
    });
  }
  void is_refused(std::size_t script, const std::string& method, const json& params, int code,
                  const std::string& word) {
    is_refused(script,
               json{{"jsonrpc", "2.0"}, {"id", ++last_id_}, {"method", method}, {"params", params}}.dump(),
               code, word);
  }
  void wait(Duration duration) {
    then([this, duration, until = Time{}]() mutable {
      if (until == Time{}) until = now_ + duration;
      return now_ >= until;
    });
  }
  /// As a person does in the panel.
  void set_remote(bool on) {
    do_once([this, on] {
      ParameterRequest request;
      request.component = component("remote");
      request.requester = requester_;
      CHECK(request.add(0, 0, &on, sizeof(on)));
      cell().send(request);
    });
    then([this] {
      ParameterAnswer answer;
      if (!answers_.pop(answer)) return false;
      CHECK(answer.kind == AnswerKind::accepted);
      return true;
    });
  }
  /// With the token, and permission.
  void let_in(std::size_t script) {
    call(script);
    ask(script, "authenticate", {{"token", secret}},
        [](const json& result) { CHECK_EQUAL(result.at("role").get<std::string>(), "operator"); });
    set_remote(true);
  }
  ComponentIndex component(const std::string& name) {
    for (ComponentIndex i = 0; i < cell().component_count(); ++i) {
      if (name == cell().component_name(i)) return i;
    }
    throw fixture::CheckFailed{"there is no " + name};
  }
  // Before run().
  MockStreamSocket::Configuration& door() {
    return *static_cast<MockStreamSocket::Configuration*>(door_->parameter_memory().configuration);
  }
  RemoteControlUnit::Configuration& remote() {
    return *static_cast<RemoteControlUnit::Configuration*>(
        cell().component(component("remote")).parameter_memory().configuration);
  }

  RunSummary run() {
    Conductor::score = [this](const Tick& tick) { perform(tick.now); };
    const RunSummary summary = executive_.run();
    if (!failure_.empty()) throw fixture::CheckFailed{failure_};
    return summary;
  }
  /// To the last act.
  void perform_all() {
    CHECK_EQUAL(run().exit_code, 0);
    if (done_ != acts_.size()) throw fixture::CheckFailed{"act " + std::to_string(done_) + " never ended"};
  }

 private:
  void perform(Time now) {
    now_ = now;
    try {
      while (done_ < acts_.size() && acts_[done_]()) ++done_;
    } catch (const fixture::CheckFailed& failed) {
      failure_ = "act " + std::to_string(done_) + ": " + failed.message;
    } catch (const std::exception& thrown) {
      failure_ = "act " + std::to_string(done_) + ": " + thrown.what();
    }
    if (done_ == acts_.size() || !failure_.empty()) executive_.request_end();
  }

  Executive executive_;
  AnswerQueue answers_;
  std::uint16_t requester_ = 0;
  MockStreamSocket* door_ = nullptr;
  std::vector<Act> acts_;
  std::size_t done_ = 0;
  std::vector<std::size_t> read_;
  std::string failure_;
  Time now_{};
  int last_id_ = 0;
};

}  // namespace flexrf::whole
