// What happens to the station when a cable is pulled out, or a device at its end gives up: the cases of
// pick_station_test in cable_test.cpp. Of each: what the operator reads, what the axes and the gripper do,
// and that it goes on once the cause is gone.
#pragma once

#include "tests/pick_station/hardware.hpp"

namespace flexrf::pick_station {

template <Hardware hardware>
void a_can_cable_that_is_pulled_out_in_motion_stops_the_axes();
template <Hardware hardware>
void a_gripper_that_is_not_heard_any_more_is_a_fault();
template <Hardware hardware>
void a_gripper_with_a_fault_of_its_own_is_activated_again();
template <Hardware hardware>
void an_io_connection_that_is_cut_is_waited_for();
template <Hardware hardware>
void a_camera_that_is_unplugged_is_waited_for_where_it_is_asked();
template <Hardware hardware>
void a_camera_that_is_not_asked_may_be_unplugged();
template <Hardware hardware>
void parts_are_taken_only_when_the_camera_sees_them();
template <Hardware hardware>
void a_box_that_is_unplugged_is_an_emergency_stop();

}  // namespace flexrf::pick_station
