#include "hal/watchdog/conformance/watchdog_conformance.hpp"
#include "hal/watchdog/mock/mock_watchdog.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

class MockWorld final : public WatchdogBenchWorld<MockWatchdog> {
 public:
  using WatchdogBenchWorld::driver;

  bool counts() override { return driver().is_armed(); }
  bool occupy() override { return refuse(StatusCode::busy); }
  bool forbid() override { return refuse(StatusCode::not_permitted); }
  bool take_away() override { return refuse(StatusCode::unavailable); }
  std::optional<std::uint32_t> longest() override { return driver().script.longest_timeout; }

 private:
  bool refuse(StatusCode code) {
    driver().script.refusal = Status::error(code, "scripted");
    return true;
  }
};

void cycles(MockWorld& world, int seconds, const char* missed_by) {
  for (int i = 0; i < 10 * seconds; ++i) world.cycle(std::chrono::milliseconds{100}, missed_by);
}

/// Resets the machine: whether the timer would, and how long the thread was silent until then.
bool is_reset_after(int silent_seconds, const char* missed_by) {
  MockWorld world;
  if (!world.start({.timeout = 10})) return false;
  cycles(world, 60, nullptr);
  cycles(world, silent_seconds, missed_by);
  cycles(world, 1, nullptr);
  return world.driver().was_late();
}

void the_machine_is_reset_only_when_a_thread_is_silent_for_its_time_out(void**) {
  assert_false(is_reset_after(600, nullptr));
  assert_false(is_reset_after(7, "control"));
  assert_true(is_reset_after(11, "control"));
}

void one_that_cannot_be_fed_is_in_fault(void**) {
  bool well = false;
  bool failed = false;
  {
    MockWorld world;
    well = world.start({}).is_ok();
    cycles(world, 10, nullptr);
    well = well && world.watchdog().fault().is_ok();
    world.driver().break_off();
    cycles(world, 10, nullptr);
    failed = world.watchdog().fault().code() == StatusCode::unavailable;
  }
  assert_true(well);
  assert_true(failed);
}

void what_the_timer_says_is_shown(void**) {
  bool caused = false;
  std::uint32_t pretimeout = 1;
  {
    MockWorld world;
    world.driver().script.caused_last_reset = true;
    world.driver().script.warns = false;
    if (world.start({.timeout = 20, .pretimeout = 5})) {
      caused = world.feedback().caused_last_reset;
      pretimeout = world.feedback().pretimeout;
    }
  }
  assert_true(caused);
  assert_int_equal(pretimeout, 0);
}

/// In virtual time there is nobody who judges: one thread runs them all.
void without_a_judge_it_is_fed(void**) {
  std::uint64_t fed = 0;
  {
    DeviceBench<MockWatchdog> bench(nullptr);
    if (bench.driver().initialise()) {
      for (int i = 0; i < 100; ++i) bench.receive(std::chrono::seconds{1});
    }
    fed = bench.feedback().fed;
  }
  assert_int_equal(fed, 34);  // at once, then every third second: the first after 2.5 s
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_machine_is_reset_only_when_a_thread_is_silent_for_its_time_out),
      cmocka_unit_test(one_that_cannot_be_fed_is_in_fault),
      cmocka_unit_test(what_the_timer_says_is_shown),
      cmocka_unit_test(without_a_judge_it_is_fed),
  };
  return cmocka_run_group_tests_name("mock watchdog", tests, nullptr, nullptr) +
         run_watchdog_conformance("mock watchdog conformance", []() -> std::unique_ptr<WatchdogWorld> {
           return std::make_unique<MockWorld>();
         });
}
