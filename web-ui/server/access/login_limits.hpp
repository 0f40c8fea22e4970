// How often a password may be tried.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/time.hpp"
#include "web-ui/server/access/address.hpp"

namespace flexrf::panel {

/// Growing delays after failures: per address (of IPv6 per network of 64 bits), and over all addresses
/// together. People at the machine have a short longest delay and none on account of others: whoever attacks
/// over the network cannot lock them out, nor take more processor time than one attempt per shared delay.
/// Memory is taken by the constructor. The server's thread.
class LoginLimits {
 public:
  static constexpr std::size_t places = 64;
  static constexpr unsigned free_failures = 3;          ///< of one address, before the first delay of 1 s
  static constexpr unsigned shared_free_failures = 10;  ///< of all addresses together
  static constexpr Duration longest = std::chrono::minutes{5};
  static constexpr Duration longest_at_machine = std::chrono::seconds{2};
  static constexpr Duration longest_shared = std::chrono::seconds{2};
  static constexpr Duration forgotten = std::chrono::minutes{15};  ///< after the last attempt's delay

  LoginLimits() : entries_(places) {}

  /// Zero: the attempt may be made, and counts as failed unless succeeded() or could_not_be_checked()
  /// follows. Else nothing is counted, and this is how long to wait.
  Duration admit(const Address& address, bool at_machine, Time now) noexcept;
  void succeeded(const Address& address) noexcept;
  /// The attempt tested no password, so it is no failure of its address. It still counts in the shared delay,
  /// because it took processor time.
  void could_not_be_checked(const Address& address, Time now) noexcept;

 private:
  struct Entry {
    Address address;
    unsigned failures = 0;  // 0: free
    Time not_before{};
  };

  Entry* find(const Address& address) noexcept;
  Entry& place_for(const Address& address) noexcept;

  std::vector<Entry> entries_;
  Entry shared_;
};

/// As Retry-After says it: whole seconds, at least 1.
constexpr unsigned seconds_to_wait(Duration wait) noexcept {
  return static_cast<unsigned>(
      std::max<std::int64_t>(std::chrono::ceil<std::chrono::seconds>(wait).count(), 1));
}

}  // namespace flexrf::panel
