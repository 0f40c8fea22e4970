// Which requests a station's registers take: neighbours go together, as many as the protocol allows.
#pragma once

#include <vector>

#include "base/status.hpp"
#include "hal/modbus/link/interface/register_map.hpp"

namespace flexrf {

// As much as the images that pass between link and station hold (types/).
inline constexpr std::size_t max_modbus_reads = 64;  ///< requests
inline constexpr std::size_t max_modbus_input_words = 1024;
inline constexpr std::size_t max_modbus_output_words = 512;

/// One request.
struct ModbusBlock {
  ModbusArea area = ModbusArea::holding_register;
  ModbusPollGroup group = ModbusPollGroup::fast;  ///< of reads
  std::uint16_t address = 0;
  std::uint16_t count = 0;   ///< registers or bits
  std::uint16_t offset = 0;  ///< of its first word in the image or command
  bool refreshed = true;     ///< of writes: again each time that the station's refresh period is over
};

/// Where a register of the map lies.
struct ModbusPlace {
  static constexpr std::uint16_t none = 0xFFFF;
  std::uint16_t input = none;   ///< word in the image
  std::uint16_t read = none;    ///< its request in ModbusPlan::reads
  std::uint16_t output = none;  ///< word in the command
};

struct ModbusPlan {
  std::vector<ModbusBlock> reads;
  std::vector<ModbusBlock> writes;
  std::vector<ModbusPlace> places;  ///< in the order of the map
};

/// Registers with consecutive addresses of one area (and, read, of one poll group) share a
/// request [modbus-plan-1], up to the protocol's 125 registers or 2000 bits to read and 123 or 1968 to
/// write [modbus-plan-2] (Modbus Application Protocol V1.1b3, 6.1 to 6.4, 6.11, 6.12), and up to
/// `most_registers` of the station's [modbus-plan-5]. What is written at changes alone goes by itself
/// [modbus-plan-6]. No address is asked for that the map does not have: a station may refuse it
/// [modbus-plan-3]. Error: it takes too many requests [modbus-plan-4], or a value has more registers than one
/// may have. Lifecycle thread; allocates.
Status plan_requests(const ModbusRegisterMap& map, std::uint16_t most_registers, ModbusPlan& plan);

}  // namespace flexrf
