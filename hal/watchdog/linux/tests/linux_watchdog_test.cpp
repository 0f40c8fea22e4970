// What the operator reads when there is no watchdog. Everything that needs one is in watchdog_guest_test.
#include "hal/watchdog/linux/linux_watchdog.hpp"

#include <cstring>

#include "hal/driver/device_bench.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

Status initialise(const char* path) {
  DeviceBench<LinuxWatchdog> bench(nullptr);
  set_text(bench.configuration().device, path);
  return bench.driver().initialise();
}

void one_that_is_not_there_is_told(void**) {
  const Status status = initialise("/dev/no-such-watchdog");
  assert_int_equal(status.code(), StatusCode::unavailable);
  assert_non_null(std::strstr(status.cause(), "/dev/no-such-watchdog"));
  assert_non_null(std::strstr(status.cause(), "wdctl"));
}

void what_is_no_watchdog_is_told(void**) {
  const Status status = initialise("/dev/null");
  assert_int_equal(status.code(), StatusCode::invalid_argument);
  assert_non_null(std::strstr(status.cause(), "/dev/null is no watchdog"));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_that_is_not_there_is_told),
      cmocka_unit_test(what_is_no_watchdog_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
