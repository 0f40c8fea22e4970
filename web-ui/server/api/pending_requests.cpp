#include "web-ui/server/api/pending_requests.hpp"

namespace flexrf::panel {

std::uint64_t PendingRequests::add(const PendingRequest& request) noexcept {
  for (Place& place : places_) {
    if (place.correlation != 0) continue;
    place.correlation = ++last_;
    place.request = request;
    ++count_;
    return place.correlation;
  }
  return 0;
}

bool PendingRequests::take(std::uint64_t correlation, PendingRequest& request) noexcept {
  for (Place& place : places_) {
    if (correlation == 0 || place.correlation != correlation) continue;
    request = place.request;
    place.correlation = 0;
    --count_;
    return true;
  }
  return false;
}

bool PendingRequests::take_overdue(Time now, PendingRequest& request) noexcept {
  if (count_ == 0) return false;
  for (const Place& place : places_) {
    if (place.correlation != 0 && now >= place.request.overdue_at) return take(place.correlation, request);
  }
  return false;
}

}  // namespace flexrf::panel
