#include "tests/applications/running.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "runtime/core/value_json.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {

void in_a_process(void (*body)()) {
  static char message[8192];
  std::memset(message, 0, sizeof(message));
  int ends[2];
  assert_int_equal(pipe(ends), 0);
  std::fflush(nullptr);
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    try {
      body();
    } catch (const fixture::CheckFailed& failed) {
      const std::size_t size = std::min(failed.message.size(), sizeof(message) - 1);
      if (write(ends[1], failed.message.data(), size) < 0) _exit(3);
      _exit(1);
    } catch (const std::exception& other) {
      const std::string text = std::string{"the test itself: "} + other.what();
      if (write(ends[1], text.data(), std::min(text.size(), sizeof(message) - 1)) < 0) _exit(3);
      _exit(1);
    }
    _exit(0);
  }
  close(ends[1]);
  for (std::size_t size = 0; size < sizeof(message) - 1;) {
    const ssize_t count = read(ends[0], message + size, sizeof(message) - 1 - size);
    if (count <= 0) break;
    size += static_cast<std::size_t>(count);
  }
  close(ends[0]);
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  if (message[0] != '\0') fail_msg("%s", message);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail_msg("the process ended with status 0x%x", status);
}

namespace {

Options quietly(Options options, RightsOfATest rights) {
  options.realtime = rights == RightsOfATest::real_time;
  options.status_view = false;
  // Other programs take the processors away; a test of a standstill says so itself.
  if (!options.standstill_limit) options.standstill_limit = std::chrono::minutes{10};
  return options;
}

}  // namespace

Running::Running(const Application& application, Options options, RightsOfATest rights)
    : executive_(application, quietly(std::move(options), rights)) {
  int ends[2];
  CHECK(pipe(ends) == 0);
  dup2(ends[0], STDIN_FILENO);
  close(ends[0]);
  keys_ = ends[1];
  const Status status = executive_.prepare();
  if (!status) throw fixture::CheckFailed{std::string{"prepare: "} + status.cause()};
  requester_ = executive_.cell().add_requester(answers_);
  thread_ = std::thread([this] { summary_ = executive_.run(); });
  CHECK(wait_until([this] { return control().mode() >= Mode::running; }));
}

Running::~Running() {
  if (thread_.joinable()) stop();
  close(keys_);
}

void Running::type(const std::string& keys) {
  CHECK(write(keys_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
}

void Running::start_motion() {
  CHECK(wait_until([this] { return control().start_motion().is_ok(); }));
}

std::uint16_t Running::unit(const std::string& name) {
  const std::span<const UnitRecord> units = application().units;
  for (std::size_t i = 0; i < units.size(); ++i)
    if (name == units[i].name) return static_cast<std::uint16_t>(i);
  throw fixture::CheckFailed{"there is no unit " + name};
}

nlohmann::json Running::newest(const std::string& slot) {
  for (const SlotRecord& record : application().slots) {
    if (slot != record.name || record.observer == nullptr) continue;
    const auto lock = executive_.cell().observe();
    if (record.observer->newest() == nullptr) return nullptr;
    JsonWriter json;
    write_value(json, *record.control->type(), record.observer->payload());
    return nlohmann::json::parse(json.take());
  }
  throw fixture::CheckFailed{"there is no observed slot " + slot};
}

nlohmann::json Running::newest(const std::string& slot, const std::string& field) {
  const nlohmann::json value = newest(slot);
  return value.is_null() ? value : value.at(field);
}

ParameterAnswer Running::ask(ParameterRequest request) {
  request.requester = requester_;
  executive_.cell().send(request);
  ParameterAnswer answer;
  if (!wait_until([&] { return answers_.pop(answer); })) throw fixture::CheckFailed{"no answer"};
  return answer;
}

RunSummary Running::stop() {
  control().set_cause(EndCause::requested);
  control().rise_to(Mode::stopping);
  thread_.join();
  return summary_;
}

}  // namespace flexrf::whole
