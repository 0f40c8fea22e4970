#include "hal/interfaces/modbus_link/register_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace flexrf {
namespace {

constexpr std::uint16_t swapped(std::uint16_t word) {
  return static_cast<std::uint16_t>((word << 8) | (word >> 8));
}

bool swaps_words(ModbusWordOrder order) {
  return order == ModbusWordOrder::cdab || order == ModbusWordOrder::dcba;
}
bool swaps_bytes(ModbusWordOrder order) {
  return order == ModbusWordOrder::badc || order == ModbusWordOrder::dcba;
}

std::uint32_t joined(const ModbusRegister& meaning, const std::uint16_t* words) {
  std::uint16_t high = words[0];
  std::uint16_t low = words[1];
  if (swaps_words(meaning.word_order)) std::swap(high, low);
  if (swaps_bytes(meaning.word_order)) {
    high = swapped(high);
    low = swapped(low);
  }
  return (std::uint32_t{high} << 16) | low;
}

void split(const ModbusRegister& meaning, std::uint32_t value, std::uint16_t* words) {
  auto high = static_cast<std::uint16_t>(value >> 16);
  auto low = static_cast<std::uint16_t>(value & 0xFFFF);
  if (swaps_bytes(meaning.word_order)) {
    high = swapped(high);
    low = swapped(low);
  }
  if (swaps_words(meaning.word_order)) std::swap(high, low);
  words[0] = high;
  words[1] = low;
}

template <class Integer>
Integer rounded(double raw) {
  return static_cast<Integer>(std::clamp(std::round(raw), double{std::numeric_limits<Integer>::min()},
                                         double{std::numeric_limits<Integer>::max()}));
}

}  // namespace

const char* name_of(ModbusArea area) noexcept {
  constexpr const char* names[] = {"coil", "discrete_input", "holding_register", "input_register"};
  return names[static_cast<std::size_t>(area)];
}

double decode_register(const ModbusRegister& meaning, const std::uint16_t* words) noexcept {
  switch (meaning.type) {
    case ModbusType::boolean:
      return words[0] != 0 ? 1 : 0;
    case ModbusType::i16:
      return static_cast<std::int16_t>(words[0]) * meaning.scale;
    case ModbusType::u16:
      return words[0] * meaning.scale;
    case ModbusType::i32:
      return static_cast<std::int32_t>(joined(meaning, words)) * meaning.scale;
    case ModbusType::u32:
      return joined(meaning, words) * meaning.scale;
    case ModbusType::f32:
      return double{std::bit_cast<float>(joined(meaning, words))} * meaning.scale;
  }
  return 0;
}

void encode_register(const ModbusRegister& meaning, double value, std::uint16_t* words) noexcept {
  if (std::isnan(value)) value = meaning.safe_value;
  const double raw = value / meaning.scale;
  switch (meaning.type) {
    case ModbusType::boolean:
      words[0] = raw != 0 ? 1 : 0;
      break;
    case ModbusType::i16:
      words[0] = static_cast<std::uint16_t>(rounded<std::int16_t>(raw));
      break;
    case ModbusType::u16:
      words[0] = rounded<std::uint16_t>(raw);
      break;
    case ModbusType::i32:
      split(meaning, static_cast<std::uint32_t>(rounded<std::int32_t>(raw)), words);
      break;
    case ModbusType::u32:
      split(meaning, rounded<std::uint32_t>(raw), words);
      break;
    case ModbusType::f32: {
      constexpr double most = std::numeric_limits<float>::max();
      split(meaning, std::bit_cast<std::uint32_t>(static_cast<float>(std::clamp(raw, -most, most))), words);
      break;
    }
  }
}

}  // namespace flexrf
