#pragma once

#include <linux/can.h>

#include <cstdint>
#include <optional>

#include "types/can_bus_state.hpp"

namespace flexrf {

/// What an error frame of SocketCAN (linux/can/error.h) says.
struct CanErrorReport {
  std::optional<CanBusState> state;  ///< bus_off, error_passive or error_active, if it says
  bool bus_error = false;            ///< something went wrong on the wire, or nobody acknowledged
  bool arbitration_lost = false;
  bool receive_overflow = false;  ///< the controller lost frames, because nobody fetched them in time
  bool has_counters = false;      ///< the following are told
  std::uint8_t transmit_errors = 0;
  std::uint8_t receive_errors = 0;
};

/// `frame.can_id` has CAN_ERR_FLAG. Any thread.
CanErrorReport read_error_frame(const can_frame& frame) noexcept;

}  // namespace flexrf
