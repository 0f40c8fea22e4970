// Who observes a running application: when it is started and stopped, and what its threads inherit.
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "runtime/executive/tests/running_cell.hpp"
#include "runtime/run/run_application.hpp"

namespace flexrf::fixture::observer_test {
namespace {

using Cell = ProducerAndConsumer;

/// What a test wants of the observer, and what became of it. One test at a time.
struct Record {
  Cell* cell = nullptr;
  std::string report;
  Status prepared;
  Status started;
  std::vector<std::string> calls;
  std::uint64_t steps_at_start = 1;
  bool running_was_seen = false;
  bool threads_had_ended = false;
  bool report_was_written = true;
  bool ending_signals_are_blocked = false;
  int policy = -1;
  std::size_t stack = 0;
};
Record* record = nullptr;

class TestObserver final : public Observer {
 public:
  explicit TestObserver(Executive& executive) : executive_(&executive) { record->calls.push_back("make"); }
  ~TestObserver() override { record->calls.push_back("destroy"); }

  Status prepare() override {
    record->calls.push_back("prepare");
    return record->prepared;
  }

  Status start() override {
    record->calls.push_back("start");
    record->steps_at_start = record->cell->unit_state(Cell::producer).steps;
    if (!record->started) return record->started;
    thread_ = std::thread([this] { watch(); });
    return {};
  }

  void stop() noexcept override {
    record->calls.push_back("stop");
    if (thread_.joinable()) thread_.join();
    record->threads_had_ended = executive_->control().mode() == Mode::ended &&
                                record->cell->unit_state(Cell::consumer).life == Life::stopped;
    record->report_was_written = access(record->report.c_str(), F_OK) == 0;
    // The objects still stand.
    record->calls.push_back(executive_->cell().component(Cell::consumer).name());
  }

 private:
  void watch() {
    pthread_attr_t attributes;
    pthread_getattr_np(pthread_self(), &attributes);
    pthread_attr_getstacksize(&attributes, &record->stack);
    pthread_attr_destroy(&attributes);
    record->policy = sched_getscheduler(0);
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
    record->ending_signals_are_blocked =
        sigismember(&blocked, SIGINT) == 1 && sigismember(&blocked, SIGTERM) == 1;
    record->running_was_seen = wait_until([] { return record->cell->unit_state(Cell::consumer).steps > 5; });
    executive_->request_end();
  }

  Executive* executive_;
  std::thread thread_;
};

std::unique_ptr<Observer> make_observer(Executive& executive) {
  return std::make_unique<TestObserver>(executive);
}

constexpr Option watch{
    .name = "--watch", .kind = OptionKind::text, .value = "on|off", .summary = "Whether to observe."};

Result<bool> is_wanted(const Options& options) {
  const std::string_view how = options.values().text("--watch", "on");
  if (how != "on" && how != "off")
    return Status::error(StatusCode::invalid_argument, "--watch: give on or off");
  return how == "on";
}

constexpr ObserverPart test_observer{"Test", {&watch, 1}, &is_wanted, &make_observer};

int run(Record& wanted, Cell& cell, std::vector<const char*> more,
        const ObserverPart* part = &test_observer) {
  record = &wanted;
  wanted.cell = &cell;
  std::vector<std::string> words{"test_cell", "--no-realtime"};
  words.insert(words.end(), more.begin(), more.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  return run_application(cell.application(), static_cast<int>(arguments.size()), arguments.data(), part);
}

using Calls = std::vector<std::string>;

// [exec-39] [exec-40] [exec-67]
void it_lives_as_long_as_the_application_runs() {
  Cell cell;
  Record seen;
  seen.report = "/tmp/flexrf-observer-" + std::to_string(getpid());
  CHECK_EQUAL(run(seen, cell, {"--report", seen.report.c_str()}), 0);
  CHECK(seen.threads_had_ended);
  CHECK(!seen.report_was_written);
  CHECK_EQUAL(unlink(seen.report.c_str()), 0);
  CHECK(seen.calls == (Calls{"make", "prepare", "start", "stop", "consumer", "destroy"}));
  CHECK_EQUAL(seen.steps_at_start, 0U);
  CHECK(seen.running_was_seen);
  CHECK(seen.ending_signals_are_blocked);
  CHECK_EQUAL(seen.policy, SCHED_OTHER);
#ifndef FLEXRF_SANITIZER
  // glibc adds the guard.
  CHECK(seen.stack >= observer_stack_size && seen.stack < 2 * observer_stack_size);
#endif
}

void what_it_cannot_prepare_refuses_the_start() {
  Cell cell;
  Record seen;
  seen.prepared = Status::error(StatusCode::unavailable, "port 8080 is in use");
  CHECK_EQUAL(run(seen, cell, {}), 1);
  CHECK(seen.calls == (Calls{"make", "prepare", "stop", "consumer", "destroy"}));
  CHECK_EQUAL(cell.events().count_of("actuator: initialise"), 0U);
}

void what_it_cannot_start_ends_the_start() {
  Cell cell;
  Record seen;
  seen.started = Status::error(StatusCode::internal, "no thread");
  CHECK_EQUAL(run(seen, cell, {}), 2);
  CHECK(seen.calls == (Calls{"make", "prepare", "start", "stop", "consumer", "destroy"}));
  CHECK_EQUAL(cell.events().count_of("actuator: initialise"), 0U);
}

void nobody_observes_who_is_not_wanted() {
  Cell cell;
  Record seen;
  CHECK_EQUAL(run(seen, cell, {"--watch", "off", "--virtual-time", "20ms"}), 0);
  CHECK(seen.calls.empty());
}

void what_it_refuses_or_nobody_knows_is_an_error() {
  Cell cell;
  Record seen;
  CHECK_EQUAL(run(seen, cell, {"--watch", "off"}, nullptr), 1);
  CHECK_EQUAL(run(seen, cell, {"--watch", "perhaps"}), 1);
  CHECK(seen.calls.empty());
  CHECK_EQUAL(cell.events().all().size(), 0U);
}

}  // namespace
}  // namespace flexrf::fixture::observer_test

int main() {
  using namespace flexrf::fixture::observer_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(it_lives_as_long_as_the_application_runs),
      CONTAINED_TEST(what_it_cannot_prepare_refuses_the_start),
      CONTAINED_TEST(what_it_cannot_start_ends_the_start),
      CONTAINED_TEST(nobody_observes_who_is_not_wanted),
      CONTAINED_TEST(what_it_refuses_or_nobody_knows_is_an_error),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
