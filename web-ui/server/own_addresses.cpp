#include "web-ui/server/own_addresses.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>

#include <array>
#include <memory>

namespace flexrf::panel {

std::vector<std::string> own_addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, &freeifaddrs);
  std::vector<std::string> addresses;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET ||
        (one->ifa_flags & IFF_LOOPBACK) != 0)
      continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* const address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size()) != nullptr)
      addresses.emplace_back(text.data());
  }
  return addresses;
}

std::vector<std::string> reachable_hosts(const ListenAddress& listen,
                                         const std::vector<std::string>& declared,
                                         const std::vector<std::string>& own) {
  if (!listen.is_any()) return {listen.address};
  std::vector<std::string> hosts = declared;
  std::vector<std::string> of_the_link;
  for (const std::string& address : own)
    (address.starts_with("169.254.") ? of_the_link : hosts).push_back(address);
  return hosts.empty() ? of_the_link : hosts;
}

}  // namespace flexrf::panel
