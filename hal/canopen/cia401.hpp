// The profile of generic I/O modules (CiA 401): the objects of digital inputs and outputs.
#pragma once

#include "hal/canopen/object.hpp"

namespace flexrf::canopen::cia401 {

inline constexpr std::uint32_t profile_number = 401;  ///< lower half of object 1000
/// Bytes of lines in each direction that one PDO holds; the profile's default PDOs have no more.
inline constexpr std::uint8_t most_bytes = 8;
inline constexpr std::uint8_t all_lines = 0xFF;  ///< of a byte

/// `byte`, from 1, is that of eight lines; the first of them is its lowest bit.
namespace objects {
constexpr ObjectAddress input(std::uint8_t byte) noexcept {
  return {0x6000, byte};
}
/// 1: the line is turned round.
constexpr ObjectAddress input_polarity(std::uint8_t byte) noexcept {
  return {0x6002, byte};
}
/// bool: changes of inputs send PDOs.
inline constexpr ObjectAddress interrupts{0x6005, 0};
/// 1: either change of the line sends a PDO.
constexpr ObjectAddress interrupt_mask(std::uint8_t byte) noexcept {
  return {0x6006, byte};
}
constexpr ObjectAddress output(std::uint8_t byte) noexcept {
  return {0x6200, byte};
}
constexpr ObjectAddress output_polarity(std::uint8_t byte) noexcept {
  return {0x6202, byte};
}
/// 1: in an error the line takes its error value; 0: it stays as it is.
constexpr ObjectAddress error_mode(std::uint8_t byte) noexcept {
  return {0x6206, byte};
}
constexpr ObjectAddress error_value(std::uint8_t byte) noexcept {
  return {0x6207, byte};
}
/// 1: the line follows what is written; 0: it stays as it is.
constexpr ObjectAddress output_mask(std::uint8_t byte) noexcept {
  return {0x6208, byte};
}
}  // namespace objects

}  // namespace flexrf::canopen::cia401
