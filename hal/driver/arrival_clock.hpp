// ArrivalClock: when a datagram arrived, by the kernel's time stamp, on the clock of the cycles.
#pragma once

#include <sys/socket.h>

#include <algorithm>
#include <cstring>
#include <ctime>

#include "base/time.hpp"

namespace flexrf {

/// The kernel stamps datagrams by the wall's clock. Never blocks, never allocates; one thread, but for
/// enable(): the lifecycle thread.
class ArrivalClock {
 public:
  /// Room that recvmsg() needs beside a datagram, bytes.
  static constexpr std::size_t control_bytes = CMSG_SPACE(sizeof(timespec));

  /// Has the kernel stamp what arrives at this socket. False: it does not; errno says why.
  static bool enable(int socket) noexcept {
    constexpr int on = 1;
    return setsockopt(socket, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof(on)) == 0;
  }

  /// Before time_of(), once a cycle. Both clocks are read without a system call. A wall's clock that is set
  /// just now makes a time wrong once, and never later than now. A thread that was held up between the two
  /// readings keeps what the cycle before knew.
  void compare() noexcept {
    constexpr Duration longest_reading = std::chrono::microseconds(50);
    const Time before = MonotonicClock::now();
    timespec wall{};
    clock_gettime(CLOCK_REALTIME, &wall);
    if (to_monotonic_ != 0 && MonotonicClock::now() - before > longest_reading) return;
    to_monotonic_ = nanoseconds(before) - nanoseconds_of(wall);
  }

  /// Of a datagram that recvmsg() took in the cycle of `now`: at most `now`, which it is without a stamp.
  Time time_of(msghdr& header, Time now) const noexcept {
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
      if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
      timespec wall{};
      std::memcpy(&wall, CMSG_DATA(part), sizeof(wall));
      return std::min(now, Time{Duration{nanoseconds_of(wall) + to_monotonic_}});
    }
    return now;
  }

 private:
  static std::int64_t nanoseconds_of(const timespec& time) noexcept {
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  }

  std::int64_t to_monotonic_ = 0;  // ns, from the wall's clock; 0: not known yet
};

}  // namespace flexrf
