// Text in aligned columns, and quantities as people read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"

namespace flexrf {

/// Three significant digits with the unit that keeps the number below 1000: "850 ns", "12.3 us", "1.00 ms",
/// "45.0 s", "12.5 min", "100 h". Allocates, as everything here.
std::string duration_text(Duration duration);
/// "512 B", "1.50 KiB", "8.00 MiB".
std::string size_text(std::uint64_t bytes);
/// At most so many characters (not bytes) of UTF-8; what is cut ends in "...".
std::string cut_text(std::string_view text, std::size_t characters);
/// Characters of UTF-8 text.
std::size_t text_width(std::string_view text) noexcept;

/// Rows of cells; each column is as wide as its widest cell. The first column is aligned to the left, as are
/// the ones so marked; the others are numbers, aligned to the right.
class TextTable {
 public:
  /// Each title is a column; one that begins with '<' (not shown) is aligned to the left.
  explicit TextTable(std::vector<std::string> titles);

  /// Missing cells are empty; further ones are left out.
  void add(std::vector<std::string> cells);
  bool is_empty() const noexcept { return rows_.size() == 1; }
  std::size_t row_count() const noexcept { return rows_.size() - 1; }

  /// Title and rows, each line with this indent and a line feed, columns two blanks apart.
  std::string text(std::string_view indent) const;

 private:
  std::vector<std::vector<std::string>> rows_;
  std::vector<bool> left_;
};

}  // namespace flexrf
