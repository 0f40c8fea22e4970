// The bytes of SDO messages (CiA 301), for client and server.
#pragma once

#include <span>

#include "hal/canopen/message.hpp"
#include "hal/canopen/object.hpp"

namespace flexrf::canopen::sdo {

// Byte 0 of what a client sends.
inline constexpr std::uint8_t read_request = 0x40;
inline constexpr std::uint8_t read_segment_request = 0x60;
inline constexpr std::uint8_t write_expedited = 0x23;  // of 4 bytes
inline constexpr std::uint8_t write_segmented = 0x21;
// Byte 0 of what a server sends.
inline constexpr std::uint8_t write_answer = 0x60;
inline constexpr std::uint8_t write_segment_answer = 0x20;
inline constexpr std::uint8_t read_answer = 0x40;
inline constexpr std::uint8_t read_expedited = 0x43;  // of 4 bytes
inline constexpr std::uint8_t read_segmented = 0x41;
inline constexpr std::uint8_t segment_answer = 0x00;
// Of both.
inline constexpr std::uint8_t abort = 0x80;

constexpr std::uint8_t expedited(std::uint8_t of_four_bytes, std::size_t size) noexcept {
  return static_cast<std::uint8_t>(of_four_bytes | ((4 - size) << 2));
}
constexpr std::uint8_t with_toggle(std::uint8_t command, bool toggle) noexcept {
  return static_cast<std::uint8_t>(command | (toggle ? 0x10 : 0x00));
}

inline Message frame(std::uint16_t identifier, std::uint8_t command, ObjectAddress object) noexcept {
  Message message{identifier, 8, {command}};
  write_number(&message.data[1], 2, object.index);
  message.data[3] = object.subindex;
  return message;
}

/// `bytes`: at most 7.
inline Message segment(std::uint16_t identifier, bool toggle, std::span<const std::uint8_t> bytes,
                       bool last) noexcept {
  Message message{identifier, 8, {}};
  message.data[0] =
      with_toggle(static_cast<std::uint8_t>(((7 - bytes.size()) << 1) | (last ? 1 : 0)), toggle);
  std::copy(bytes.begin(), bytes.end(), message.data.begin() + 1);
  return message;
}

/// The upper three bits of byte 0: what a message is.
constexpr std::uint8_t kind_of(const Message& message) noexcept {
  return static_cast<std::uint8_t>(message.data[0] & 0xE0);
}
inline ObjectAddress object_of(const Message& message) noexcept {
  return {static_cast<std::uint16_t>(read_number(&message.data[1], 2)), message.data[3]};
}
constexpr bool is_expedited(const Message& message) noexcept {
  return (message.data[0] & 0x02) != 0;
}
constexpr bool states_size(const Message& message) noexcept {
  return (message.data[0] & 0x01) != 0;
}
/// 4 when the sender does not state it.
constexpr std::size_t expedited_size(const Message& message) noexcept {
  return states_size(message) ? std::size_t{4} - ((message.data[0] >> 2) & 3U) : 4;
}
constexpr bool toggle_of(const Message& message) noexcept {
  return (message.data[0] & 0x10) != 0;
}
constexpr std::size_t segment_size(const Message& message) noexcept {
  return std::size_t{7} - ((message.data[0] >> 1) & 7U);
}
constexpr bool is_last_segment(const Message& message) noexcept {
  return (message.data[0] & 0x01) != 0;
}

}  // namespace flexrf::canopen::sdo
