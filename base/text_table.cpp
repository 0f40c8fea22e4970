#include "base/text_table.hpp"

#include <algorithm>

namespace flexrf {
namespace {

bool begins_character(char byte) noexcept {
  return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
}

}  // namespace

std::size_t text_width(std::string_view text) noexcept {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

std::string cut_text(std::string_view text, std::size_t characters) {
  if (text_width(text) <= characters) return std::string{text};
  const std::size_t kept = characters > 3 ? characters - 3 : 0;
  std::size_t bytes = 0;
  for (std::size_t seen = 0; bytes < text.size(); ++bytes) {
    if (begins_character(text[bytes]) && seen++ == kept) break;
  }
  return std::string{text.substr(0, bytes)} + std::string(characters - kept, '.');
}

TextTable::TextTable(std::vector<std::string> titles) {
  for (std::string& title : titles) {
    const bool left = left_.empty() || title.starts_with('<');
    if (title.starts_with('<')) title.erase(0, 1);
    left_.push_back(left);
  }
  rows_.push_back(std::move(titles));
}

void TextTable::add(std::vector<std::string> cells) {
  cells.resize(left_.size());
  rows_.push_back(std::move(cells));
}

std::string TextTable::text(std::string_view indent) const {
  std::vector<std::size_t> widths(left_.size());
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], text_width(row[i]));
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line{indent};
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (widths[i] == 0) continue;
      if (line.size() > indent.size() || i > 0) line += "  ";
      const std::size_t fill = widths[i] - text_width(row[i]);
      if (!left_[i]) line.append(fill, ' ');
      line += row[i];
      if (left_[i]) line.append(fill, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace flexrf
