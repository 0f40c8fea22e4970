// What the operator reads when there is no chip. Everything that needs one is in gpio_guest_test.
#include "hal/gpio/chip/linux/linux_gpio_chip.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/gpio/chip/linux/gpio_messages.hpp"
#include "hal/gpio/chip/linux/line_offset.hpp"
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

Result<unsigned> offset_of(const char* line, const std::vector<std::string>& names) {
  return offset_of_line("expander", line, static_cast<unsigned>(names.size()),
                        [&names](unsigned offset) { return names[offset]; });
}

// [gpio-chip-5]
void a_line_is_meant_by_its_name_or_its_offset(void**) {
  const std::vector<std::string> names = {"", "DOOR", "", "0", "LAMP", "LAMP"};
  assert_int_equal(*offset_of("DOOR", names), 1);
  assert_int_equal(*offset_of("2", names), 2);
  assert_int_equal(*offset_of("#2", names), 2);
  // A name goes before an offset.
  assert_int_equal(*offset_of("0", names), 3);
  assert_int_equal(*offset_of("#0", names), 0);
  assert_int_equal(*offset_of("#5", names), 5);
  for (const char* const line : {"", "#", "-1", "2x", "#2 ", "BELL", "99999999999"}) {
    const Status status = offset_of(line, names).status();
    assert_int_equal(status.code(), StatusCode::not_found);
    assert_non_null(std::strstr(status.cause(), "by its offset, as \"#3\""));
  }
  const Status beyond = offset_of("6", names).status();
  assert_int_equal(beyond.code(), StatusCode::not_found);
  assert_non_null(std::strstr(beyond.cause(), "has no line 6: it has 6, and their offsets begin at 0"));
}

// [gpio-chip-5]
void a_double_name_is_refused_with_both_offsets(void**) {
  const Status status = offset_of("LAMP", {"LAMP", "", "LAMP"}).status();
  assert_int_equal(status.code(), StatusCode::invalid_argument);
  assert_non_null(std::strstr(status.cause(), "two lines named LAMP, at the offsets 0 and 2"));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_chip_that_is_not_there_is_told),
      cmocka_unit_test(what_is_no_chip_is_told),
      cmocka_unit_test(a_missing_right_is_told),
      cmocka_unit_test(a_line_is_meant_by_its_name_or_its_offset),
      cmocka_unit_test(a_double_name_is_refused_with_both_offsets),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
