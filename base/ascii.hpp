// Letters of ASCII whatever the locale is: names in protocols and files are compared so.
#pragma once

#include <algorithm>
#include <string_view>

namespace flexrf {

/// Others than A to Z stay as they are.
constexpr char lower_case(char character) noexcept {
  return character >= 'A' && character <= 'Z' ? static_cast<char>(character - 'A' + 'a') : character;
}

/// 0 to 15; -1 of what is no hexadecimal digit.
constexpr int hexadecimal_digit(char character) noexcept {
  if (character >= '0' && character <= '9') return character - '0';
  const char lower = lower_case(character);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

constexpr bool equal_without_case(std::string_view one, std::string_view other) noexcept {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](char a, char b) { return lower_case(a) == lower_case(b); });
}

}  // namespace flexrf
