// The registers of a Modbus station, as a list in CSV names them. Enumerations are in the order of those of
// hal/modbus/link/interface/register_map.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flexrf::config_gen {

struct ModbusRegister {
  std::string name;
  std::uint16_t address = 0;   // as in the request: 40001 of a manual is 0
  std::size_t area = 0;        // into register_areas
  std::size_t type = 0;        // into register_types
  std::size_t word_order = 0;  // into register_word_orders
  std::size_t access = 0;      // into register_accesses
  std::size_t poll_group = 0;  // into register_poll_groups
  double scale = 1;
  std::string unit;
  double safe_value = 0;                      // in the unit; of what is written
  std::optional<std::uint8_t> bit;            // of a bool in a register
  bool refreshed = true;                      // written again though it did not change
  double offset = 0;                          // in the unit: the value of a count of 0
  std::optional<std::uint64_t> missing;       // the bits that say that there is no value
  std::size_t length = 0;                     // of a text: its registers
  std::optional<std::size_t> scale_register;  // into the list: what tells the power of ten
};

struct RegisterMap {
  std::vector<ModbusRegister> registers;  // in the list's order
};

// The words of the list, which are also the names of the enumerations' values in C++.
inline const std::vector<std::string> register_areas = {"coil", "discrete_input", "holding_register",
                                                        "input_register"};
inline const std::vector<std::string> register_types = {"bool", "i16", "u16", "i32", "u32",
                                                        "f32",  "i64", "u64", "f64", "text"};
inline const std::vector<std::string> register_word_orders = {"abcd", "cdab", "badc", "dcba"};
inline const std::vector<std::string> register_accesses = {"read", "write", "read_write"};
inline const std::vector<std::string> register_poll_groups = {"fast", "normal", "slow", "once"};

// As in the runtime's images: more do not fit.
inline constexpr std::size_t max_registers_of_station = 256;
inline constexpr std::size_t max_registers_of_text = 32;
inline constexpr std::size_t max_input_words_of_station = 1024;
inline constexpr std::size_t max_output_words_of_station = 512;

}  // namespace flexrf::config_gen
