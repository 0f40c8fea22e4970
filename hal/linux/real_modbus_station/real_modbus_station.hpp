// RealModbusStation: a station that is reached over its link.
#pragma once

#include "hal/interfaces/modbus_station/linked_station.hpp"
#include "real_modbus_station_driver.hpp"

namespace flexrf {

class RealModbusStation final : public LinkedStation<RealModbusStationDriver> {};

}  // namespace flexrf
