// The far end of a simulated link: registers in memory, and a wire that can fail.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/interfaces/modbus_link/modbus_transport.hpp"

namespace flexrf {

/// What goes wrong with every request from now on.
enum class ModbusWireFault : std::uint8_t {
  none,
  silent,        ///< no answer
  refused,       ///< an exception
  damaged,       ///< the answer is not to be made sense of
  disconnected,  ///< requests fail at once, and it cannot be opened
};

/// Allocates in add() only. Time goes on while a request waits, so that the same cell in virtual time has the
/// same delays.
class SimulatedRegisters final : public ModbusTransport {
 public:
  void configure(Duration delay, Duration response_timeout) noexcept {
    delay_ = delay;
    response_timeout_ = response_timeout;
  }
  /// Registers for all addresses of the map, all 0; what is there already stays.
  void add(std::uint8_t unit_id, const ModbusRegisterMap& map);
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
  ModbusReply write(std::uint8_t unit_id, const ModbusBlock& block,
                    const std::uint16_t* words) noexcept override;
  void resynchronise() noexcept override {}
  Time now() const noexcept override { return now_; }

 private:
  struct Station {
    std::uint8_t unit_id = 0;
    std::array<std::vector<std::uint16_t>, 4> areas;
  };
  /// The registers of the request, or null and why not in `reply`.
  std::uint16_t* answer(std::uint8_t unit_id, const ModbusBlock& block, ModbusReply& reply) noexcept;

  std::vector<Station> stations_;
  ModbusWireFault fault_ = ModbusWireFault::none;
  Duration delay_{};
  Duration response_timeout_{};
  Time now_{};
  bool open_ = false;
};

}  // namespace flexrf
