// Text in plain structs: a fixed number of characters, zero-terminated unless full.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace flexrf {

/// The characters before the first zero, or all.
template <std::size_t Capacity>
constexpr std::string_view text_view(const std::array<char, Capacity>& text) noexcept {
  const auto* end = std::find(text.data(), text.data() + Capacity, '\0');
  return {text.data(), static_cast<std::size_t>(end - text.data())};
}

/// Cuts what does not fit; the rest becomes zero, so that equal texts are equal bytes.
template <std::size_t Capacity>
constexpr void set_text(std::array<char, Capacity>& text, std::string_view value) noexcept {
  const std::size_t size = std::min(value.size(), Capacity);
  std::copy_n(value.data(), size, text.data());
  std::fill(text.begin() + static_cast<std::ptrdiff_t>(size), text.end(), '\0');
}

/// Cuts what does not fit; always zero-terminated.
template <std::size_t Capacity>
constexpr void copy_text(char (&to)[Capacity], std::string_view text) noexcept {
  const std::size_t size = std::min(text.size(), Capacity - 1);
  std::copy_n(text.data(), size, to);
  to[size] = '\0';
}

}  // namespace flexrf
