#pragma once

#include "hal/can/interface/can_frame.hpp"

namespace flexrf {

/// Recessive bits between two frames (ISO 11898-1: intermission).
inline constexpr unsigned intermission_bits = 3;
/// An error flag, one that answers it, and the delimiter, at their longest.
inline constexpr unsigned error_frame_bits = 6 + 6 + 8;
/// What a transmitter that is error passive waits beside the intermission.
inline constexpr unsigned suspend_bits = 8;
/// What a controller must see of a quiet bus before it takes part again: 128 times 11 recessive bits.
inline constexpr unsigned recovery_bits = 128 * 11;

/// Bits from the start of frame to its end, with as many stuff bits as any contents can need: one after the
/// first five bits and then after each four, from the start of frame to the checksum.
constexpr unsigned bit_count(const CanFrame& frame) noexcept {
  const unsigned data = frame.remote ? 0U : 8U * frame.length;
  const unsigned stuffed = (frame.extended ? 54U : 34U) + data;
  constexpr unsigned not_stuffed = 1 + 2 + 7;  // checksum delimiter, acknowledgement, end of frame
  return stuffed + (stuffed - 1) / 4 + not_stuffed;
}

}  // namespace flexrf
