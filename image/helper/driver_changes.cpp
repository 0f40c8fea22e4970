#include "image/helper/driver_changes.hpp"

#include <algorithm>
#include <utility>

namespace flexrf::helper {
namespace {

using Choice = std::pair<std::string_view, std::string_view>;  // device, driver

std::vector<Choice> choices_in(std::string_view text) {
  std::vector<Choice> choices;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view part = text.substr(0, comma);
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
    const std::size_t sign = part.find('=');
    if (sign != std::string_view::npos) choices.emplace_back(part.substr(0, sign), part.substr(sign + 1));
  }
  return choices;
}

/// Empty: the device is not there.
std::string_view driver_of(const std::vector<Choice>& choices, std::string_view device) {
  const auto found =
      std::find_if(choices.begin(), choices.end(), [&](const Choice& one) { return one.first == device; });
  return found == choices.end() ? std::string_view{} : found->second;
}

}  // namespace

std::vector<DriverChange> driver_changes(std::string_view running, std::string_view other) {
  const std::vector<Choice> here = choices_in(running);
  const std::vector<Choice> there = choices_in(other);
  std::vector<DriverChange> changes;
  for (const auto& [device, driver] : here) {
    const std::string_view to = driver_of(there, device);
    if (to != driver) changes.push_back({std::string{device}, std::string{driver}, std::string{to}});
  }
  for (const auto& [device, driver] : there) {
    if (driver_of(here, device).empty()) changes.push_back({std::string{device}, {}, std::string{driver}});
  }
  return changes;
}

std::string text_of(const std::vector<DriverChange>& changes) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(changes.size(), most); ++i) {
    const DriverChange& change = changes[i];
    text += (i == 0 ? "" : ", ") + change.device + ": " + (change.from.empty() ? "none" : change.from) +
            " -> " + (change.to.empty() ? "none" : change.to);
  }
  if (changes.size() > most) text += ", and " + std::to_string(changes.size() - most) + " more";
  return text;
}

}  // namespace flexrf::helper
