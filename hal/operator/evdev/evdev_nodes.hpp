// Which input devices the kernel has, as its files in /sys say: to know them takes no right to read them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace flexrf {

struct EvdevNode {
  int number = 0;  ///< of /dev/input/eventN
  std::string name;
  std::string phys;  ///< where it is plugged in; empty: the kernel does not say
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;

  std::string path() const { return "/dev/input/event" + std::to_string(number); }
};

/// By their numbers. Lifecycle thread or a thread that may wait.
std::vector<EvdevNode> list_evdev_nodes(const char* folder = "/sys/class/input");

/// Whether `wanted` means it: its name, its phys, or "vendor:product" in hexadecimal, as lsusb shows them.
bool is_meant(const EvdevNode& node, std::string_view wanted);

}  // namespace flexrf
