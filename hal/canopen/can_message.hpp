// A CANopen message as a frame on a CAN bus, and back.
#pragma once

#include "hal/can/interface/can_frame.hpp"
#include "hal/canopen/message.hpp"

namespace flexrf::canopen {

constexpr CanFrame to_frame(const Message& message) noexcept {
  CanFrame frame;
  frame.data = message.data;
  frame.identifier = message.identifier;
  frame.length = message.size;
  frame.remote = message.remote;
  return frame;
}

/// Of a frame with a standard identifier.
constexpr Message to_message(const CanFrame& frame) noexcept {
  Message message;
  message.data = frame.data;
  message.identifier = static_cast<std::uint16_t>(frame.identifier);
  message.size = frame.length;
  message.remote = frame.remote;
  return message;
}

}  // namespace flexrf::canopen
