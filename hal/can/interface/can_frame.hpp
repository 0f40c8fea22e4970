// CanFrame: what goes over a CAN bus, and who is heard before whom.
#pragma once

#include <array>
#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

/// A frame of classical CAN (ISO 11898-1).
struct CanFrame {
  static constexpr std::uint8_t most_bytes = 8;

  Time time{};  ///< of a received frame: when it had come, on the clock of Tick::now
                ///< [can-frame-1]; to send: not looked at
  std::array<std::uint8_t, 8> data{};
  std::uint32_t identifier = 0;  ///< 11 bits, or 29 when extended
  std::uint8_t length = 0;       ///< bytes of data, 0 to 8
  bool extended = false;         ///< 29-bit identifier
  bool remote = false;           ///< asks for data and carries none (RTR)
  std::uint8_t unused = 0;       ///< so that it ends with a whole word, by which it is copied

  /// Whether a controller would take it.
  constexpr bool is_valid() const noexcept {
    return length <= most_bytes && identifier <= (extended ? 0x1FFF'FFFFU : 0x7FFU);
  }
};
static_assert(sizeof(CanFrame) == 24, "frames are copied by the batch");

/// Which frames somebody wants.
struct CanIdentifier {
  std::uint32_t value = 0;  ///< 11 bits, or 29 when extended
  bool extended = false;
  friend bool operator==(const CanIdentifier&, const CanIdentifier&) = default;
  constexpr bool is_valid() const noexcept { return value <= (extended ? 0x1FFF'FFFFU : 0x7FFU); }
};

/// The bits that the wire arbitrates by, in their order: the lower value is sent first [can-frame-2]. Of a
/// valid frame.
constexpr std::uint32_t arbitration_key(const CanFrame& frame) noexcept {
  const std::uint32_t remote = frame.remote ? 1U : 0U;
  if (!frame.extended) return frame.identifier << 21U | remote << 20U;
  // Eleven bits, a recessive SRR and IDE where the shorter frame has RTR and a dominant IDE, the other 18.
  return (frame.identifier >> 18U) << 21U | 3U << 19U | (frame.identifier & 0x3FFFFU) << 1U | remote;
}

}  // namespace flexrf
