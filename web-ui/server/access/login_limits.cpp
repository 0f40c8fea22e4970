#include "web-ui/server/access/login_limits.hpp"

#include <algorithm>

namespace flexrf::panel {
namespace {

/// 1 s after the first failure that is not free, doubled with each further one.
Duration delay_after(unsigned failures, unsigned free, Duration longest) noexcept {
  if (failures <= free) return Duration::zero();
  const unsigned doublings = std::min(failures - free - 1, 20U);
  return std::min(Duration{std::chrono::seconds{1}} * (std::int64_t{1} << doublings), longest);
}

}  // namespace

LoginLimits::Entry* LoginLimits::find(const Address& address) noexcept {
  for (Entry& entry : entries_) {
    if (entry.failures > 0 && entry.address == address) return &entry;
  }
  return nullptr;
}

LoginLimits::Entry& LoginLimits::place_for(const Address& address) noexcept {
  if (Entry* const known = find(address)) return *known;
  // Whose delay is over soonest is forgotten soonest; the shared delay holds whatever is forgotten here.
  Entry& place =
      *std::min_element(entries_.begin(), entries_.end(), [](const Entry& one, const Entry& other) {
        return (one.failures == 0 ? Time{} : one.not_before) <
               (other.failures == 0 ? Time{} : other.not_before);
      });
  place = {address, 0, Time{}};
  return place;
}

Duration LoginLimits::admit(const Address& address, bool at_machine, Time now) noexcept {
  const auto wait = [now](const Entry& entry) { return std::max(entry.not_before - now, Duration::zero()); };
  const Address party = address.neighbourhood();
  Entry* const known = find(party);
  if (known != nullptr && now - known->not_before > forgotten) known->failures = 0;
  if (now - shared_.not_before > forgotten) shared_.failures = 0;
  const Duration own = known != nullptr && known->failures > 0 ? wait(*known) : Duration::zero();
  const Duration shared = at_machine || shared_.failures == 0 ? Duration::zero() : wait(shared_);
  if (const Duration longer = std::max(own, shared); longer > Duration::zero()) return longer;

  const auto count = [now](Entry& entry, unsigned free, Duration longest_delay) {
    ++entry.failures;
    entry.not_before = now + delay_after(entry.failures, free, longest_delay);
  };
  count(place_for(party), free_failures, at_machine ? longest_at_machine : longest);
  if (!at_machine) count(shared_, shared_free_failures, longest_shared);
  return Duration::zero();
}

void LoginLimits::succeeded(const Address& address) noexcept {
  if (Entry* const known = find(address.neighbourhood())) known->failures = 0;
}

void LoginLimits::could_not_be_checked(const Address& address, Time now) noexcept {
  Entry* const known = find(address.neighbourhood());
  if (known == nullptr || known->failures == 0) return;  // a log-in that succeeded meanwhile has forgiven it
  --known->failures;
  known->not_before = std::min(known->not_before, now);
}

}  // namespace flexrf::panel
