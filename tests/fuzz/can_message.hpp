// Messages of CANopen out of the input.
#pragma once

#include "hal/canopen/message.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace flexrf::fuzz {

/// A size of at most 8, as a controller has it, and any identifier of 11 bits.
inline canopen::Message message_from(Source& source) {
  canopen::Message message;
  const std::uint16_t word = source.word();
  message.identifier = word & 0x7FF;
  message.remote = (word & 0x8000) != 0;
  message.size = static_cast<std::uint8_t>(source.byte() % 9);
  for (std::uint8_t i = 0; i < message.size; ++i) message.data[i] = source.byte();
  return message;
}

inline void append(Bytes& bytes, const canopen::Message& message) {
  bytes.push_back(static_cast<std::uint8_t>(message.identifier & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(message.identifier >> 8 | (message.remote ? 0x80 : 0)));
  bytes.push_back(message.size);
  bytes.insert(bytes.end(), message.data.begin(), message.data.begin() + message.size);
}

}  // namespace flexrf::fuzz
