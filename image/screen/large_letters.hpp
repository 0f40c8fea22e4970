// Letters that are read from two metres away, for a console of text.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace flexrf::screen {

inline constexpr std::size_t rows_of_letter = 7;
inline constexpr std::size_t columns_of_letter = 6;  ///< with the gap behind it

/// Digits, letters (all as capitals), dashes and dots, each five columns of blocks (U+2588) wide; anything
/// else is a gap.
std::array<std::string, rows_of_letter> large_letters(std::string_view text);

}  // namespace flexrf::screen
