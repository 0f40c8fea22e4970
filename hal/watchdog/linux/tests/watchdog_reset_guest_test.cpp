// A thread that falls silent has the machine reset. This test is run twice: the first run must never end, the
// second is in the machine that came up anew (docs/guest.md).
#include <cstdlib>

#include "hal/watchdog/linux/tests/kernel_watchdog.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

// [watchdog-1]
void while_a_thread_is_silent_the_machine_is_not_kept_alive(void**) {
  std::uint64_t fed = 0;
  {
    KernelWatchdog world;
    if (world.start({.timeout = 4})) {
      world.live_by_the_clock(std::chrono::seconds{10}, nullptr);
      fed = world.feedback().fed;
      std::printf("fed %d times; from now on a thread is silent\n", static_cast<int>(fed));
      std::fflush(stdout);
      world.live_by_the_clock(std::chrono::seconds{60}, "control");
    }
    world.watchdog().stop();
  }
  fail_msg("fed %d times, and then not for a minute: the machine still runs", static_cast<int>(fed));
}

void after_the_reset_it_is_told_whose_it_was(void**) {
  bool told = false;
  {
    KernelWatchdog world;
    told = world.start({}) && world.feedback().caused_last_reset;
    world.watchdog().stop();
  }
  assert_true(told);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest before[] = {cmocka_unit_test(while_a_thread_is_silent_the_machine_is_not_kept_alive)};
  const CMUnitTest after[] = {cmocka_unit_test(after_the_reset_it_is_told_whose_it_was)};
  return std::getenv("FLEXRF_AFTER_RESET") == nullptr ? cmocka_run_group_tests(before, nullptr, nullptr)
                                                      : cmocka_run_group_tests(after, nullptr, nullptr);
}
