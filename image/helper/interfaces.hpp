// The PC's wired interfaces, as the kernel tells of them.
#pragma once

#include <string>
#include <vector>

namespace flexrf::helper {

struct Interface {
  std::string name;  ///< "enp0s2"
  std::string mac;   ///< "52:54:00:12:34:56"
  bool has_link = false;
  std::vector<std::string> addresses;  ///< IPv4, as "192.168.1.10/24"
};

/// Those of Ethernet, by name; none if the kernel does not tell. Any thread.
std::vector<Interface> wired_interfaces();

}  // namespace flexrf::helper
