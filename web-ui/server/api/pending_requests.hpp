// Requests that a component's thread has not answered yet, and who waits for each.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/executive/cell.hpp"
#include "web-ui/server/api/caller.hpp"

namespace flexrf::panel {

enum class Purpose : std::uint8_t {
  values,   ///< answered with the values in force
  plain,    ///< answered with that it is done
  hold,     ///< begins a lease
  refresh,  ///< answered only when the lease is over
};

struct PendingRequest {
  Caller caller;
  ComponentIndex component = 0;
  Purpose purpose = Purpose::plain;
  std::uint64_t lease = 0;
  Time overdue_at{};
};

/// The server's thread.
class PendingRequests {
 public:
  /// As many as the answer queue holds, so that none is lost.
  static constexpr std::size_t capacity = AnswerQueue::capacity;

  /// The request's correlation; 0: there is no place.
  std::uint64_t add(const PendingRequest& request) noexcept;
  /// False when nobody waits for this (any longer).
  bool take(std::uint64_t correlation, PendingRequest& request) noexcept;
  /// One that is overdue; false: none is.
  bool take_overdue(Time now, PendingRequest& request) noexcept;

 private:
  struct Place {
    std::uint64_t correlation = 0;  // 0: free
    PendingRequest request;
  };
  std::array<Place, capacity> places_;
  std::size_t count_ = 0;
  std::uint64_t last_ = 0;
};

}  // namespace flexrf::panel
