#include "hal/driver/simulator/command_line.hpp"

#include <algorithm>
#include <cstdlib>

namespace flexrf {

bool is_number(const char* text, double least, double most, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value >= least && value <= most;
}

const char* CommandLine::word(std::string_view option) {
  const std::vector<const char*> taken = take(option, 1);
  return taken.size() == 2 ? taken[1] : nullptr;
}

void CommandLine::number(std::string_view option, double least, double most, double& value) {
  const char* const text = word(option);
  if (text != nullptr && !is_number(text, least, most, value)) is_well_ = false;
}

const char* CommandLine::word_and_number(std::string_view option, double least, double most, double& value) {
  const std::vector<const char*> taken = take(option, 2);
  if (taken.size() < 3) return nullptr;
  if (!is_number(taken[2], least, most, value)) is_well_ = false;
  return taken[1];
}

std::vector<const char*> CommandLine::take(std::string_view option, std::ptrdiff_t behind) {
  std::vector<const char*> taken;
  for (auto at = words_.begin(); (at = std::find(at, words_.end(), option)) != words_.end();) {
    if (words_.end() - at <= behind) is_well_ = false;
    const auto end = at + std::min(behind + 1, words_.end() - at);
    taken.assign(at, end);
    at = words_.erase(at, end);
  }
  return taken;
}

}  // namespace flexrf
