// Emergency messages (CiA 301): what a node says when something goes wrong in it.
#pragma once

#include <optional>

#include "hal/canopen/message.hpp"

namespace flexrf::canopen {

struct Emergency {
  std::uint16_t code = 0;             ///< 0x0000: what was wrong no longer is
  std::uint8_t error_register = 0;    ///< object 1001
  std::array<std::uint8_t, 5> own{};  ///< the manufacturer's

  bool is_reset() const noexcept { return (code & 0xFF00) == 0; }
};

/// Nothing if the message is no emergency of `node`, or damaged.
std::optional<Emergency> emergency_of(const Message& message, std::uint8_t node) noexcept;
Message emergency_message(const Emergency& emergency, std::uint8_t node) noexcept;

/// What an error code (of an emergency, or of object 603F) is about: "heartbeat or life guarding lost",
/// "current", …
const char* describe_error_code(std::uint16_t code) noexcept;

}  // namespace flexrf::canopen
