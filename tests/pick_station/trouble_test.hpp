// What goes wrong with the station: the cases of pick_station_test in trouble_test.cpp.
#pragma once

#include "tests/pick_station/hardware.hpp"

namespace flexrf::pick_station {

template <Hardware hardware>
void an_emergency_stop_in_mid_pick_is_recovered_from();
template <Hardware hardware>
void a_drive_that_faults_in_motion_is_initialised_and_homed();
/// On simulated hardware: the mocks have no identity.
void a_drive_of_another_vendor_is_refused_until_the_right_one_is_connected();
template <Hardware hardware>
void a_station_that_falls_silent_is_waited_for();
template <Hardware hardware>
void a_part_that_is_lost_on_the_way_is_a_fault();
/// On mocks: the simulated gripper has a part between its fingers wherever it is.
void a_part_that_is_not_where_it_should_be_is_a_fault();

}  // namespace flexrf::pick_station
