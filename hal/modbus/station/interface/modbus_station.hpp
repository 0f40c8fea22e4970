// ModbusStation: registers that are read and written by name.
#pragma once

#include <cstddef>
#include <string_view>

#include "hal/modbus/link/interface/register_map.hpp"
#include "modbus_station_interface.hpp"
#include "runtime/blackboard/item.hpp"
#include "runtime/core/status.hpp"

namespace flexrf {

/// What a register held when it was last read, or why nothing is known.
struct ModbusValue {
  double value = 0;  ///< scaled, in the register's unit; 0 or 1 for a bool
  Duration age{};    ///< since the answer came that it was in
  /// none: valid. nothing_yet: never read. Older than its poll group's period and max_age: writer_faulted
  /// when the station refuses to tell it, writer_stopped when the station does not answer, else
  /// too_old [modbus-station-1].
  NullReason reason = NullReason::nothing_yet;

  explicit operator bool() const noexcept { return reason == NullReason::none; }
};

/// input, output: any thread, from connect() on. All else: the thread the station lives in.
class ModbusStation : public ModbusStationInterface {
 public:
  const ModbusRegisterMap& register_map() const noexcept { return *registers; }

  /// The index of the register of this name, for read() or set(); to be asked once, in initialise(). It is an
  /// error when there is none, or when its access is not such [modbus-station-2].
  Result<std::size_t> input(std::string_view name) const noexcept;
  Result<std::size_t> output(std::string_view name) const noexcept;

  /// Never waits. An index that is no input: not_registered.
  virtual ModbusValue read(std::size_t index) const noexcept = 0;

  /// What the register shall hold from the end of this cycle on, in its unit, until set()
  /// again [modbus-station-3]. What does not fit the register becomes the nearest that
  /// does [modbus-station-4]; what is not a number puts the station in fault [modbus-station-5]. Without
  /// effect while is_inhibited(): the safe values are written then, and what was set is
  /// forgotten [modbus-station-6].
  virtual void set(std::size_t index, double value) noexcept = 0;
};

}  // namespace flexrf
