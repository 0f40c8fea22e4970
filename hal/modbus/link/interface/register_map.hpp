// What the registers of a station mean: constants that config-gen makes from a list in CSV.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace flexrf {

// In the order of config-gen's words for them (config-gen/model/register_map.hpp).
enum class ModbusArea : std::uint8_t { coil, discrete_input, holding_register, input_register };
enum class ModbusType : std::uint8_t { boolean, i16, u16, i32, u32, f32, i64, u64, f64, text };
/// How the bytes of a 32-bit value come over the wire; A is the most significant [register-map-1]. Of a
/// 64-bit one likewise: its registers from the most significant on, or (cdab, dcba) from the least; their
/// bytes swapped in badc and dcba [register-map-2].
enum class ModbusWordOrder : std::uint8_t { abcd, cdab, badc, dcba };
enum class ModbusAccess : std::uint8_t { read, write, read_write };
/// Which of the station's periods it is read with; `once`: until the station has answered, and not again.
enum class ModbusPollGroup : std::uint8_t { fast, normal, slow, once };

/// A value of a station, in one register or several, or in a bit of one.
struct ModbusRegister {
  static constexpr std::uint8_t whole = 16;
  static constexpr std::uint16_t none = 0xFFFF;
  static constexpr std::size_t most_words = 32;

  std::string_view name;
  std::uint16_t address = 0;  ///< as in the request, from 0
  ModbusArea area = ModbusArea::holding_register;
  ModbusType type = ModbusType::u16;
  ModbusWordOrder word_order = ModbusWordOrder::abcd;
  ModbusAccess access = ModbusAccess::read;
  ModbusPollGroup poll_group = ModbusPollGroup::fast;
  double scale = 1;            ///< units per count; not 0
  std::string_view unit = {};  ///< unit of measure of the scaled value
  double safe_value = 0;       ///< scaled; of what is written
  /// Of a boolean in a register: its bit, 0 the least significant. Bits of one register are read and written
  /// together [register-map-6]; those that no row writes are written as 0.
  std::uint8_t bit = whole;
  /// Written again each time that the station's refresh period is over; else when it changes, and after it
  /// was not heard. What lies in EEPROM or flash wears with each write.
  bool refreshed = true;
  double offset = 0;  ///< in the unit: the value of a count of 0
  /// The bits by which the station says that it has no value, as 0x8000 of an i16; of what is only read.
  std::optional<std::uint64_t> missing = {};
  /// The place in the map of the register that tells a power of ten to multiply with, as SunSpec has it; of
  /// what is only read.
  std::uint16_t scale_register = none;
  std::uint16_t length = 0;  ///< of a text: its registers, two characters each; at most most_words

  constexpr bool is_read() const noexcept { return access != ModbusAccess::write; }
  constexpr bool is_written() const noexcept { return access != ModbusAccess::read; }
  constexpr bool is_bit_of_register() const noexcept { return bit != whole; }
  /// Registers (or coils) that it takes.
  constexpr std::uint16_t words() const noexcept {
    if (type == ModbusType::text) return length;
    return type >= ModbusType::i64 ? 4 : type >= ModbusType::i32 ? 2 : 1;
  }
};

struct ModbusRegisterMap {
  std::span<const ModbusRegister> registers;  ///< at most max_registers
};

inline constexpr std::size_t max_modbus_registers = 256;

/// For messages: "holding_register", ...
const char* name_of(ModbusArea area) noexcept;

/// The value in the register's words: its counts times scale and `factor`, and the offset [register-map-7].
/// Not a number where it is a text, or the station says that it has none: by the bits of `missing`, or by a
/// floating-point number that is none [register-map-8].
double decode_register(const ModbusRegister& meaning, const std::uint16_t* words, double factor = 1) noexcept;
/// The words of such a value: rounded to the nearest count [register-map-3], what does not fit becomes the
/// nearest that does; not a number becomes the bits of `missing`, or else the safe value [register-map-4]. Of
/// a bit the register's others stay as they are [register-map-5].
void encode_register(const ModbusRegister& meaning, double value, std::uint16_t* words,
                     double factor = 1) noexcept;
/// The characters of a text's words, the first in the high byte of the first word, or (badc, dcba) in its low
/// byte, up to the first that is 0, and without the blanks at its end [register-map-10].
std::string_view decode_text(const ModbusRegister& meaning, const std::uint16_t* words,
                             std::array<char, 2 * ModbusRegister::most_words>& text) noexcept;
/// The words of a text: what is longer is cut, the rest are zeros.
void encode_text(const ModbusRegister& meaning, std::string_view text, std::uint16_t* words) noexcept;
/// The factor that a scale register's value stands for: 10^exponent, from -10 to 10; not a number where it is
/// no such exponent [register-map-9].
double factor_of_exponent(double exponent) noexcept;

}  // namespace flexrf
