// CanLastWords: what a CAN socket says when the process crashes.
#pragma once

#include <vector>

#include "hal/can/interface/can_frame.hpp"
#include "hal/can/socket_can/can_socket.hpp"

namespace flexrf {

/// Frames in the slots of runtime/realtime/last_gasp.hpp, whose handler writes them with nothing but poll()
/// and write(): a raw socket takes one frame with each. It never waits: an interface that is down refuses at
/// once, and a full queue is tried for 10 ms, then the socket is given up.
///
/// The words of all devices leave before what is said to all of them, because a CANopen drive takes a
/// synchronous PDO at the SYNC behind it: so one SYNC stops all axes at the same time.
class CanLastWords {
 public:
  CanLastWords() = default;
  CanLastWords(const CanLastWords&) = delete;
  CanLastWords& operator=(const CanLastWords&) = delete;
  ~CanLastWords();

  // ---- the lifecycle thread

  /// A device's place; below 0: all that there are in this process are taken.
  int claim();
  /// What has no place is left alone.
  void release(int place) noexcept;
  /// Nothing is said until something is prepared again; before the socket is closed.
  void clear() noexcept;

  // ---- the bus's thread

  void prepare(int place, const CanSocket& socket, const CanFrame& word, const CanFrame& all) const noexcept;

 private:
  static constexpr int none = -1;

  std::vector<int> places_;
  int to_all_ = none;
};

}  // namespace flexrf
