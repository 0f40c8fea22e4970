#include "hal/operator/evdev/evdev_nodes.hpp"

#include <dirent.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <memory>
#include <optional>

namespace flexrf {
namespace {

template <class Number>
std::optional<Number> number_in(std::string_view text, int base) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number, base);
  if (text.empty() || error != std::errc{} || rest != end) return std::nullopt;
  return number;
}

std::string first_line(const std::string& file) {
  std::string line;
  std::getline(std::ifstream(file), line);
  return line;
}

std::uint16_t identifier_in(const std::string& file) {
  return number_in<std::uint16_t>(first_line(file), 16).value_or(0);
}

}  // namespace

std::vector<EvdevNode> list_evdev_nodes(const char* folder) {
  std::vector<EvdevNode> nodes;
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(opendir(folder), closedir);
  if (entries == nullptr) return nodes;
  constexpr std::string_view prefix = "event";
  while (const dirent* const entry = readdir(entries.get())) {
    const std::string_view file = entry->d_name;
    if (!file.starts_with(prefix)) continue;
    const auto number = number_in<int>(file.substr(prefix.size()), 10);
    if (!number) continue;
    const std::string device = std::string(folder) + '/' + entry->d_name + "/device/";
    nodes.push_back({.number = *number,
                     .name = first_line(device + "name"),
                     .phys = first_line(device + "phys"),
                     .vendor = identifier_in(device + "id/vendor"),
                     .product = identifier_in(device + "id/product")});
  }
  std::sort(nodes.begin(), nodes.end(),
            [](const EvdevNode& a, const EvdevNode& b) { return a.number < b.number; });
  return nodes;
}

bool is_meant(const EvdevNode& node, std::string_view wanted) {
  if (wanted.empty()) return false;
  if (wanted == node.name || wanted == node.phys) return true;
  if (wanted.size() != 9 || wanted[4] != ':') return false;
  const auto vendor = number_in<std::uint16_t>(wanted.substr(0, 4), 16);
  const auto product = number_in<std::uint16_t>(wanted.substr(5), 16);
  return vendor && product && *vendor == node.vendor && *product == node.product;
}

}  // namespace flexrf
