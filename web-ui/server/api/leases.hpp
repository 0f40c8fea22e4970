// The holds that live, and whose they are.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/executive/cell.hpp"
#include "web-ui/server/api/caller.hpp"

namespace flexrf::panel {

struct Lease {
  std::uint64_t number = 0;  ///< from new_lease_number(); 0: the place is free
  Caller owner;
  ComponentIndex component = 0;
  std::uint16_t parameter = 0;
  std::uint32_t offset = 0;    ///< bytes within the parameter
  std::uint64_t sequence = 0;  ///< of the last request
};

/// The server's thread. What is not here is over, and a number never comes again.
class Leases {
 public:
  static constexpr std::size_t capacity = 64;

  /// Null: too many people hold too much.
  Lease* add(const Lease& lease) noexcept;
  Lease* find(std::uint64_t number) noexcept;
  void forget(std::uint64_t number) noexcept;
  /// Calls end(lease) for each that `is_over(lease)` is true of, and forgets it.
  template <class IsOver, class End>
  void end_if(IsOver&& is_over, End&& end) {
    for (Lease& lease : leases_) {
      if (lease.number == 0 || !is_over(lease)) continue;
      end(lease);
      lease.number = 0;
    }
  }

 private:
  std::array<Lease, capacity> leases_;
};

}  // namespace flexrf::panel
