// The far end of a simulated link: registers in memory, and a wire that can fail.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "hal/modbus/link/interface/modbus_station_model.hpp"
#include "hal/modbus/link/interface/modbus_transport.hpp"

namespace flexrf {

/// What goes wrong with every request from now on.
enum class ModbusWireFault : std::uint8_t {
  none,
  silent,        ///< no answer
  refused,       ///< an exception
  damaged,       ///< the answer is not to be made sense of
  disconnected,  ///< requests fail at once, and it cannot be opened
};

/// Allocates in add() and set_model() only, which the lifecycle thread calls while the link's thread serves
/// other stations; all else is the link's thread's. Time goes on while a request waits, so that the same cell
/// in virtual time has the same delays.
class SimulatedRegisters final : public ModbusTransport {
 public:
  void configure(Duration delay, Duration response_timeout) noexcept {
    delay_ = delay;
    response_timeout_ = response_timeout;
  }
  /// Registers for all addresses of the map, all 0; what is there already stays.
  void add(std::uint8_t unit_id, const ModbusRegisterMap& map);
  /// The station does something with its registers, from now on.
  void set_model(std::uint8_t unit_id, std::shared_ptr<ModbusStationModel> model);
  /// Null when there is no such station or register.
  std::uint16_t* find(std::uint8_t unit_id, ModbusArea area, std::uint16_t address) noexcept;
  /// Every register becomes 0: the station was switched off.
  void clear() noexcept;

  void set_fault(ModbusWireFault fault) noexcept { fault_ = fault; }
  /// False while a request still waits at `now`.
  bool advance(Time now) noexcept;

  Status open() noexcept override;
  void close() noexcept override { open_ = false; }
  bool is_open() const noexcept override { return open_; }
  ModbusReply read(std::uint8_t unit_id, const ModbusBlock& block, std::uint16_t* words) noexcept override;
  ModbusReply write(std::uint8_t unit_id, const ModbusBlock& block, const std::uint16_t* words,
                    bool multiple) noexcept override;
  /// It waits in its own time.
  Duration longest_wait(const ModbusBlock& /*block*/, bool /*writes*/) const noexcept override { return {}; }
  void resynchronise() noexcept override {}
  Time now() const noexcept override { return now_; }

 private:
  struct Station {
    std::uint8_t unit_id = 0;
    std::array<std::vector<std::uint16_t>, 4> areas;
    std::shared_ptr<ModbusStationModel> model;  // or null
  };
  Station& station(std::uint8_t unit_id);
  void follow(std::uint8_t unit_id) noexcept;
  /// The registers of the request, or null and why not in `reply`.
  std::uint16_t* answer(std::uint8_t unit_id, const ModbusBlock& block, ModbusReply& reply) noexcept;

  std::mutex mutex_;  // of stations_
  std::vector<Station> stations_;
  ModbusWireFault fault_ = ModbusWireFault::none;
  Duration delay_{};
  Duration response_timeout_{};
  Time now_{};
  bool open_ = false;
};

}  // namespace flexrf
