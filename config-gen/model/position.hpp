// Where in the tables something was said, so that every message can cite it.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace flexrf::config_gen {

struct Position {
  std::string_view file;   // an interned name, valid until the program ends
  std::uint32_t line = 0;  // from 1; 0: the file as a whole
  std::uint32_t column = 0;

  auto operator<=>(const Position&) const = default;
  explicit operator bool() const { return !file.empty(); }
};

// The one stored copy of a file's name, as it was given or found (relative names stay relative).
std::string_view intern(std::string_view file);

// "file:line:column", or "file" for a file as a whole.
std::string to_string(const Position& position);

}  // namespace flexrf::config_gen
