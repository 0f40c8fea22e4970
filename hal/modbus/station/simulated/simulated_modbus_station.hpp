// SimulatedModbusStation: a station behind a simulated link.
#pragma once

#include "hal/modbus/station/interface/linked_station.hpp"
#include "simulated_modbus_station_driver.hpp"

namespace flexrf {

class SimulatedModbusStation final : public LinkedStation<SimulatedModbusStationDriver> {};

}  // namespace flexrf
