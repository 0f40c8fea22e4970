// A start that fails, before anything runs or although everything looked right before: what is said of it.
#include <sys/wait.h>
#include <unistd.h>

#include "runtime/executive/tests/running_cell.hpp"
#include "runtime/run/report.hpp"
#include "tests/log_ear.hpp"

namespace flexrf::fixture::start_test {
namespace {

using Cell = ProducerAndConsumer;

struct Ending {
  int exit_code = -1;
  std::string report;
};

/// In a process of its own, which gives its rights away between prepare() and run().
Ending run_without_rights(Cell& cell) {
  int ends[2];
  CHECK(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    Options options = on_the_wall_clock();
    options.realtime = true;
    Executive executive(cell.application(), options);
    if (!executive.prepare() || setgid(65534) != 0 || setuid(65534) != 0) _exit(100);
    const RunSummary summary = executive.run();
    const std::string report = report_text(executive.cell(), summary);
    const bool written = write(ends[1], report.data(), report.size()) == static_cast<ssize_t>(report.size());
    _exit(written ? summary.exit_code : 101);
  }
  close(ends[1]);
  Ending ending;
  char part[4096];
  for (ssize_t size = 0; (size = read(ends[0], part, sizeof(part))) > 0;) {
    ending.report.append(part, static_cast<std::size_t>(size));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
  return ending;
}

void a_right_lost_before_the_start_is_named() {
  if (geteuid() != 0) skip();  // nobody else has rights to lose
  Cell cell;
  cell.thread(Cell::producing).priority = 20;
  const Ending ending = run_without_rights(cell);
  CHECK_EQUAL(ending.exit_code, 3);
  CHECK_CONTAINS(ending.report, "not started: ");
  CHECK_CONTAINS(ending.report, "not held");  // CAP_IPC_LOCK or, where no memory is locked, CAP_SYS_NICE
}

/// Of the thread that it lives in, before it is initialised.
Duration longest_step_told(Options options) {
  Cell cell;
  for (const std::uint16_t thread : {Cell::producing, Cell::consuming})
    cell.thread(thread).deadline = std::chrono::milliseconds{1};
  Executive executive(cell.application(), std::move(options));
  CHECK(executive.prepare());
  return cell.application().device_states[Cell::actuator].environment.longest_step;
}

void a_driver_is_told_how_long_a_step_may_take() {
  Options options = on_the_wall_clock();
  options.standstill_limit = std::chrono::seconds{1};
  CHECK(longest_step_told(options) == std::chrono::milliseconds{500});
  options.standstill_limit = std::chrono::milliseconds{300};
  CHECK(longest_step_told(options) == std::chrono::milliseconds{300});
  CHECK(longest_step_told(in_virtual_time(std::chrono::seconds{1})) == Duration{});
}

/// As its tables were when they were generated, and this machine's roles are now.
// [exec-68]
void a_deadline_that_may_be_missed_is_told() {
  Cell cell;
  const LogEar ear;
  cell.thread(Cell::producing).priority = 20;
  cell.thread(Cell::producing).deadline = std::chrono::milliseconds{1};
  cell.unit(Cell::producer).budget = std::chrono::microseconds{1500};
  Executive executive(cell.application(), on_the_wall_clock());
  cell.unit(Cell::producer).script.step = [&](TestUnit&, const Tick&) { executive.request_end(); };
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK(ear.has_heard("producing: response without bound, deadline 1.000 ms: missed"));
}

// [exec-8]
void a_thread_that_waits_for_too_much_is_refused() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::on_slots(std::vector<std::uint16_t>(33, Cell::values));
  Executive executive(cell.application(), in_virtual_time(std::chrono::seconds{1}));
  const Status status = executive.prepare();
  CHECK(status.code() == StatusCode::invalid_argument);
  CHECK_CONTAINS(status.cause(), "thread consuming waits for 33 slots and queues, more than 32");
}

}  // namespace
}  // namespace flexrf::fixture::start_test

int main() {
  using namespace flexrf::fixture::start_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_right_lost_before_the_start_is_named),
      CONTAINED_TEST(a_driver_is_told_how_long_a_step_may_take),
      CONTAINED_TEST(a_deadline_that_may_be_missed_is_told),
      CONTAINED_TEST(a_thread_that_waits_for_too_much_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
