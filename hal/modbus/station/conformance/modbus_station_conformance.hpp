// What every driver of ModbusStation must do. A driver's test makes a world, which is the driver, its link
// and its far end, and runs the cases in it.
#pragma once

#include <memory>
#include <string_view>

#include "hal/modbus/station/interface/modbus_station.hpp"

namespace flexrf {

/// What the far end does from now on.
enum class ModbusFarEnd : std::uint8_t {
  well,
  silent,        ///< does not answer
  slow,          ///< answers, but too late
  refuses,       ///< answers with an exception
  damaged,       ///< answers with bytes that are no answer
  truncated,     ///< its answers end early
  other_unit,    ///< answers as another unit
  disconnected,  ///< the connection is cut, and the station is switched off: its registers are 0 afterwards
  cut,           ///< every connection is ended as soon as it has come about
};

class ModbusStationWorld {
 public:
  virtual ~ModbusStationWorld() = default;

  /// Before start(): how long an answer may take; so long that only what hangs exceeds it, unless it is told.
  /// Without effect where nobody answers.
  virtual void set_response_timeout(double /*seconds*/) {}
  /// Initialises the station, unit 1, whose poll groups fast and normal are read as fast as can be, slow once
  /// an hour; it may not move yet. `map` outlives the world.
  virtual Status start(const ModbusRegisterMap& map) = 0;
  virtual ModbusStation& station() = 0;
  /// The thread's cycle: receive, then what the unit does, then send.
  virtual void receive() = 0;
  virtual void send() = 0;
  virtual Time now() const = 0;
  /// Its clock is virtual, or the guest's, which counts: what the machine does otherwise is not seen in it,
  /// so that a bound in time can be a pass mark.
  virtual bool has_counted_time() const { return true; }
  /// It passes with receive() alone.
  virtual bool has_virtual_time() const { return true; }

  /// A register of the far end; `index` of the map.
  virtual void put(std::size_t index, double value) = 0;
  virtual void put_text(std::size_t index, std::string_view text) = 0;
  virtual double held(std::size_t index) = 0;
  /// False: cannot be made to happen with this driver.
  virtual bool make(ModbusFarEnd behaviour) = 0;
  /// Requests that reached the far end; −1: there are none with this driver.
  virtual int requests() { return -1; }
};

using MakeModbusStationWorld = std::unique_ptr<ModbusStationWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_modbus_station_conformance(const char* driver, MakeModbusStationWorld make);

}  // namespace flexrf
