// A case of the conformance suite that needs many worlds.
#pragma once

#include "hal/modbus/station/conformance/modbus_station_conformance.hpp"
#include "tests/verdict.hpp"

namespace flexrf {

/// [modbus-station-12] Skipped where time is not virtual: the orders are too many.
Verdict no_order_of_events_writes_what_nobody_set(MakeModbusStationWorld make);

}  // namespace flexrf
