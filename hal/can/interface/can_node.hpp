// CanNode: a simulated device at the far end of a CAN bus.
#pragma once

#include "hal/can/interface/can_frame.hpp"

namespace flexrf {

/// Where a node sends. The node's thread.
class CanPort {
 public:
  /// Waits its turn on the wire, behind this node's frames of the same or a higher priority. False: the
  /// node's queue is full or its controller is off the bus; nothing was sent.
  virtual bool send(const CanFrame& frame) noexcept = 0;

 protected:
  ~CanPort() = default;
};

/// What a simulated device implements to be on a bus, in virtual or in real time: in process, attached to
/// CanBus::wire(), or as a program of its own on a real interface. It reads no clock: it is told what time it
/// is, and says when it next wants to be told. Everything: one thread, that of the bus it is attached to.
class CanNode {
 public:
  /// A frame of another node has been on the wire, complete at frame.time. May send.
  virtual void on_frame(const CanFrame& frame, CanPort& port) noexcept = 0;
  /// When it next does something by itself (a heartbeat, an event timer, the end of a delay); Time::max():
  /// never. Asked again after each call of the other functions.
  virtual Time next_event() const noexcept = 0;
  /// That time has come; `now` may be later. May send. Afterwards next_event() lies behind `now`. Also the
  /// first call of all, right after the node was attached: so it learns what time it is.
  virtual void on_time(Time now, CanPort& port) noexcept = 0;

 protected:
  ~CanNode() = default;
};

}  // namespace flexrf
