// The real driver on the guest's watchdog: the conformance suite, and that the machine lives as long as it is
// fed. That it is reset when it is not is watchdog_reset_guest_test.
#include <sys/wait.h>

#include <csignal>

#include "hal/watchdog/linux/tests/kernel_watchdog.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

void fed_it_lets_the_machine_live(void**) {
  bool well = false;
  {
    KernelWatchdog world;
    well = world.start({.timeout = 4}).is_ok();
    if (well) world.live_by_the_clock(std::chrono::seconds{13}, nullptr);
    well = well && world.feedback().fed > 3 && world.counts();
    world.watchdog().stop();
    well = well && !world.counts();
  }
  assert_true(well);
}

// [watchdog-5]
void what_ends_the_process_leaves_it_armed(void**) {
  const pid_t process = fork();
  if (process == 0) {
    KernelWatchdog world;
    if (world.start({.timeout = 30})) std::raise(SIGKILL);
    _exit(1);
  }
  int ending = 0;
  const bool killed =
      waitpid(process, &ending, 0) == process && WIFSIGNALED(ending) && WTERMSIG(ending) == SIGKILL;
  bool armed = false;
  {
    KernelWatchdog world;
    armed = world.counts();
    // Whoever takes it over lets go of it in good order, so that this machine is not reset.
    if (world.start({.timeout = 30})) world.watchdog().stop();
  }
  assert_true(killed);
  assert_true(armed);
}

void this_chip_gives_no_warning(void**) {
  bool none = false;
  {
    KernelWatchdog world;
    none = world.start({.timeout = 30, .pretimeout = 5}) && world.feedback().pretimeout == 0;
    world.watchdog().stop();
  }
  assert_true(none);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(fed_it_lets_the_machine_live),
      cmocka_unit_test(what_ends_the_process_leaves_it_armed),
      cmocka_unit_test(this_chip_gives_no_warning),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_watchdog_conformance("linux watchdog on i6300esb", []() -> std::unique_ptr<WatchdogWorld> {
           return std::make_unique<KernelWatchdog>();
         });
}
