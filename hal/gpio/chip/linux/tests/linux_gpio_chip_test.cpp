// What the operator reads when there is no chip. Everything that needs one is in gpio_guest_test.
#include "hal/gpio/chip/linux/linux_gpio_chip.hpp"

#include <cerrno>
#include <cstring>

#include "base/text.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/gpio/chip/linux/gpio_messages.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

Status initialise(const char* chip) {
  DeviceBench<LinuxGpioChip> bench(nullptr);
  set_text(bench.configuration().chip, chip);
  return bench.driver().initialise();
}

void a_chip_that_is_not_there_is_told(void**) {
  for (const char* chip : {"/dev/no-such-gpiochip", "gpiochip987", "no-such-label"}) {
    const Status status = initialise(chip);
    assert_int_equal(status.code(), StatusCode::unavailable);
    assert_non_null(std::strstr(status.cause(), chip));
    assert_non_null(std::strstr(status.cause(), "gpiodetect"));
  }
}

void what_is_no_chip_is_told(void**) {
  const Status status = initialise("/dev/null");
  assert_int_equal(status.code(), StatusCode::unavailable);
  assert_non_null(std::strstr(status.cause(), "/dev/null"));
}

// Scripted, not produced: whoever runs this may be root.
void a_missing_right_is_told(void**) {
  const Status status = cannot_open_chip("gpiochip0", EACCES);
  assert_int_equal(status.code(), StatusCode::not_permitted);
  assert_non_null(std::strstr(status.cause(), "udev rule"));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_chip_that_is_not_there_is_told),
      cmocka_unit_test(what_is_no_chip_is_told),
      cmocka_unit_test(a_missing_right_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
