#include "hal/modbus/link/interface/register_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

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

// Place of the register that has the value's i-th sixteen bits, from the most significant on.
std::size_t place_of(const ModbusRegister& meaning, std::size_t i) {
  return swaps_words(meaning.word_order) ? meaning.words() - 1 - i : i;
}

std::uint64_t joined(const ModbusRegister& meaning, const std::uint16_t* words) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < meaning.words(); ++i) {
    const std::uint16_t word = words[place_of(meaning, i)];
    value = (value << 16) | (swaps_bytes(meaning.word_order) ? swapped(word) : word);
  }
  return value;
}

void split(const ModbusRegister& meaning, std::uint64_t value, std::uint16_t* words) {
  for (std::size_t i = meaning.words(); i-- > 0; value >>= 16) {
    const auto word = static_cast<std::uint16_t>(value & 0xFFFF);
    words[place_of(meaning, i)] = swaps_bytes(meaning.word_order) ? swapped(word) : word;
  }
}

// Compared before it is converted: the greatest 64-bit numbers are no doubles, and what is over them is no
// integer.
template <class Integer>
Integer rounded(double raw) {
  constexpr Integer least = std::numeric_limits<Integer>::min();
  constexpr Integer most = std::numeric_limits<Integer>::max();
  const double nearest = std::round(raw);
  if (nearest <= static_cast<double>(least)) return least;
  if (nearest >= static_cast<double>(most)) return most;
  return static_cast<Integer>(nearest);
}

double counts_of(ModbusType type, std::uint64_t bits) {
  switch (type) {
    case ModbusType::i16:
      return static_cast<std::int16_t>(bits);
    case ModbusType::i32:
      return static_cast<std::int32_t>(bits);
    case ModbusType::i64:
      return static_cast<double>(static_cast<std::int64_t>(bits));
    case ModbusType::f32:
      return double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
    case ModbusType::f64:
      return std::bit_cast<double>(bits);
    case ModbusType::boolean:
    case ModbusType::u16:
    case ModbusType::u32:
    case ModbusType::u64:
    case ModbusType::text:
      break;
  }
  return static_cast<double>(bits);
}

void set_bit(const ModbusRegister& meaning, bool value, std::uint16_t& word) {
  const auto mask = static_cast<std::uint16_t>(1U << meaning.bit);
  word = static_cast<std::uint16_t>(value ? word | mask : word & ~mask);
}

}  // namespace

const char* name_of(ModbusArea area) noexcept {
  constexpr const char* names[] = {"coil", "discrete_input", "holding_register", "input_register"};
  return names[static_cast<std::size_t>(area)];
}

double decode_register(const ModbusRegister& meaning, const std::uint16_t* words, double factor) noexcept {
  if (meaning.type == ModbusType::text) return std::numeric_limits<double>::quiet_NaN();
  if (meaning.type == ModbusType::boolean)
    return (meaning.is_bit_of_register() ? words[0] >> meaning.bit & 1 : words[0]) != 0 ? 1 : 0;
  const std::uint64_t bits = joined(meaning, words);
  if (meaning.missing == bits) return std::numeric_limits<double>::quiet_NaN();
  return counts_of(meaning.type, bits) * (meaning.scale * factor) + meaning.offset;
}

std::string_view decode_text(const ModbusRegister& meaning, const std::uint16_t* words,
                             std::array<char, 2 * ModbusRegister::most_words>& text) noexcept {
  const std::size_t size = 2 * std::min<std::size_t>(meaning.length, ModbusRegister::most_words);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint16_t word = swaps_bytes(meaning.word_order) ? swapped(words[i / 2]) : words[i / 2];
    text[i] = static_cast<char>(i % 2 == 0 ? word >> 8 : word & 0xFF);
  }
  const std::string_view whole{text.data(), size};
  std::string_view told = whole.substr(0, whole.find('\0'));
  while (told.ends_with(' ')) told.remove_suffix(1);
  return told;
}

void encode_text(const ModbusRegister& meaning, std::string_view text, std::uint16_t* words) noexcept {
  const auto byte = [text](std::size_t at) {
    return at < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[at])) : 0U;
  };
  for (std::size_t i = 0; i < meaning.length; ++i) {
    const auto word = static_cast<std::uint16_t>(byte(2 * i) << 8 | byte(2 * i + 1));
    words[i] = swaps_bytes(meaning.word_order) ? swapped(word) : word;
  }
}

double factor_of_exponent(double exponent) noexcept {
  constexpr double most = 10;
  return std::abs(exponent) <= most ? std::pow(10.0, exponent) : std::numeric_limits<double>::quiet_NaN();
}

void encode_register(const ModbusRegister& meaning, double value, std::uint16_t* words,
                     double factor) noexcept {
  if (std::isnan(value) && meaning.missing) {
    split(meaning, *meaning.missing, words);
    return;
  }
  if (std::isnan(value)) value = meaning.safe_value;
  const double raw = (value - meaning.offset) / (meaning.scale * factor);
  switch (meaning.type) {
    case ModbusType::boolean:
      if (meaning.is_bit_of_register()) {
        set_bit(meaning, raw != 0, words[0]);
      } else {
        words[0] = raw != 0 ? 1 : 0;
      }
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
    case ModbusType::i64:
      split(meaning, static_cast<std::uint64_t>(rounded<std::int64_t>(raw)), words);
      break;
    case ModbusType::u64:
      split(meaning, rounded<std::uint64_t>(raw), words);
      break;
    case ModbusType::f64: {
      constexpr double most = std::numeric_limits<double>::max();
      split(meaning, std::bit_cast<std::uint64_t>(std::clamp(raw, -most, most)), words);
      break;
    }
    case ModbusType::text:
      break;  // which is no number
  }
}

}  // namespace flexrf
