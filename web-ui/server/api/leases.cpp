#include "web-ui/server/api/leases.hpp"

namespace flexrf::panel {

Lease* Leases::add(const Lease& lease) noexcept {
  for (Lease& place : leases_) {
    if (place.number != 0) continue;
    place = lease;
    return &place;
  }
  return nullptr;
}

Lease* Leases::find(std::uint64_t number) noexcept {
  for (Lease& lease : leases_) {
    if (number != 0 && lease.number == number) return &lease;
  }
  return nullptr;
}

void Leases::forget(std::uint64_t number) noexcept {
  if (Lease* lease = find(number); lease != nullptr) lease->number = 0;
}

}  // namespace flexrf::panel
