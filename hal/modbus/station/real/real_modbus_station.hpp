// RealModbusStation: a station that is reached over its link.
#pragma once

#include "hal/modbus/station/interface/linked_station.hpp"
#include "real_modbus_station_driver.hpp"

namespace flexrf {

class RealModbusStation final : public LinkedStation<RealModbusStationDriver> {};

}  // namespace flexrf
