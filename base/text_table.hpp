// Text in aligned columns.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flexrf {

/// At most so many characters (not bytes) of UTF-8; what is cut ends in "...". Allocates, as
/// TextTable does.
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
