#include "base/text_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace flexrf {
namespace {

struct Unit {
  const char* name;
  double size;  // in the smallest
};

/// Three significant digits, of what is below 1000.
std::string three_digits(double number, const char* unit) {
  char text[48];
  const double amount = std::fabs(number);
  const int decimals = amount < 9.995 ? 2 : amount < 99.95 ? 1 : 0;
  std::snprintf(text, sizeof(text), "%.*f %s", decimals, number, unit);
  return text;
}

template <std::size_t Count>
std::string quantity_text(double number, const std::array<Unit, Count>& units) {
  const double amount = std::fabs(number);
  // The smallest unit counts whole things.
  if (amount < units[1].size) {
    char text[48];
    std::snprintf(text, sizeof(text), "%.0f %s", number, units[0].name);
    return text;
  }
  std::size_t best = 1;
  // What would be rounded up to the next unit is shown in that.
  while (best + 1 < Count && amount >= 0.9995 * units[best + 1].size) ++best;
  return three_digits(number / units[best].size, units[best].name);
}

constexpr std::array durations{Unit{"ns", 1},  Unit{"us", 1e3},   Unit{"ms", 1e6},
                               Unit{"s", 1e9}, Unit{"min", 60e9}, Unit{"h", 3600e9}};
constexpr std::array sizes{Unit{"B", 1}, Unit{"KiB", 1024}, Unit{"MiB", 1024.0 * 1024},
                           Unit{"GiB", 1024.0 * 1024 * 1024}};

bool begins_character(char byte) noexcept {
  return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
}

}  // namespace

std::string duration_text(Duration duration) {
  return quantity_text(static_cast<double>(duration.count()), durations);
}

std::string size_text(std::uint64_t bytes) {
  return quantity_text(static_cast<double>(bytes), sizes);
}

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
