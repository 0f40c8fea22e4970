// The machine that tests of drivers run in is what they take it for: each device that docs/guest.md lists is
// there and does its work, seen through nothing but the kernel.
#include <sys/utsname.h>

#include <cstring>

#include "tests/cmocka.hpp"
#include "tests/guest/prepared_devices.hpp"

namespace {

using namespace flexrf;

void the_kernel_is_preempt_rt(void**) {
  utsname system{};
  assert_int_equal(::uname(&system), 0);
  assert_non_null(std::strstr(system.version, "PREEMPT_RT"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_kernel_is_preempt_rt),
      cmocka_unit_test(a_frame_on_the_virtual_can_reaches_another_socket),
      cmocka_unit_test(frames_cross_the_bus_between_two_can_controllers),
      cmocka_unit_test(both_can_controllers_run_at_500_kilobit_per_second),
      cmocka_unit_test(a_datagram_comes_back_over_the_loopback_network),
      cmocka_unit_test(bytes_cross_the_serial_line_both_ways),
      cmocka_unit_test(gpio_lines_bear_their_names),
      cmocka_unit_test(an_input_that_is_pulled_up_is_an_edge_and_a_level),
      cmocka_unit_test(an_output_is_seen_from_outside),
      cmocka_unit_test(the_camera_captures_and_streams),
      cmocka_unit_test(the_watchdog_is_fed_and_let_go),
      cmocka_unit_test(a_key_of_a_made_up_keyboard_is_an_event),
  };
  return cmocka_run_group_tests_name("devices of the guest", tests, nullptr, nullptr);
}
