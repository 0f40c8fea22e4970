#include "image/helper/interfaces.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <utility>

namespace flexrf::helper {
namespace {

template <class Address>
Address as(const sockaddr* address) {
  Address copy{};
  std::memcpy(&copy, address, sizeof copy);
  return copy;
}

std::string text_of_mac(const sockaddr_ll& address) {
  std::array<char, 18> text{};
  const unsigned char* const byte = address.sll_addr;
  std::snprintf(text.data(), text.size(), "%02x:%02x:%02x:%02x:%02x:%02x", byte[0], byte[1], byte[2], byte[3],
                byte[4], byte[5]);
  return text.data();
}

std::string text_of(const ifaddrs& entry) {
  std::array<char, INET_ADDRSTRLEN> text{};
  const auto address = as<sockaddr_in>(entry.ifa_addr);
  if (inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size()) == nullptr) return {};
  const auto mask = entry.ifa_netmask == nullptr ? sockaddr_in{} : as<sockaddr_in>(entry.ifa_netmask);
  return std::string{text.data()} + '/' + std::to_string(std::popcount(mask.sin_addr.s_addr));
}

}  // namespace

std::vector<Interface> wired_interfaces() {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(all, &freeifaddrs);
  std::map<std::string, Interface> found;
  for (const ifaddrs* entry = all; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_PACKET) continue;
    const auto link = as<sockaddr_ll>(entry->ifa_addr);
    if (link.sll_hatype != ARPHRD_ETHER) continue;
    found[entry->ifa_name] = {entry->ifa_name, text_of_mac(link), (entry->ifa_flags & IFF_RUNNING) != 0, {}};
  }
  for (const ifaddrs* entry = all; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    if (const auto at = found.find(entry->ifa_name); at != found.end())
      at->second.addresses.push_back(text_of(*entry));
  }
  std::vector<Interface> interfaces;
  for (auto& [name, interface] : found) interfaces.push_back(std::move(interface));
  return interfaces;
}

}  // namespace flexrf::helper
