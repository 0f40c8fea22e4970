// The tests of guest_devices_test, in the two files that include this.
#pragma once

namespace flexrf {

// prepared_buses.cpp
void a_frame_on_the_virtual_can_reaches_another_socket(void**);
void frames_cross_the_bus_between_two_can_controllers(void**);
void both_can_controllers_run_at_500_kilobit_per_second(void**);
void a_datagram_comes_back_over_the_loopback_network(void**);
void bytes_cross_the_serial_line_both_ways(void**);

// prepared_peripherals.cpp
void gpio_lines_bear_their_names(void**);
void an_input_that_is_pulled_up_is_an_edge_and_a_level(void**);
void an_output_is_seen_from_outside(void**);
void the_camera_captures_and_streams(void**);
void the_watchdog_is_fed_and_let_go(void**);
void a_key_of_a_made_up_keyboard_is_an_event(void**);

}  // namespace flexrf
