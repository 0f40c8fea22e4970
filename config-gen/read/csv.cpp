#include "config-gen/read/csv.hpp"

#include <algorithm>
#include <charconv>

#include "config-gen/model/source_text.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::size_t most_columns = 256;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

bool has_text(const CsvCell& cell) {
  return !cell.text.empty();
}

class Scanner {
 public:
  Scanner(std::string_view text, std::string_view file, Diagnostics& diagnostics)
      : text_(text), diagnostics_(diagnostics), place_{file, 1, 1} {
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
    if (!take_separator()) separator_ = find_separator();
  }

  // The next record that is neither a comment nor without any text, as spreadsheets write rows below a list.
  std::optional<std::vector<CsvCell>> next() {
    while (at_ < text_.size()) {
      if (peek() == '#') {
        while (at_ < text_.size() && peek() != '\n') step();
      }
      if (at_ == text_.size()) break;
      if (peek() == '\n') {
        step();
        continue;
      }
      std::vector<CsvCell> cells = record();
      if (std::any_of(cells.begin(), cells.end(), has_text)) return cells;
    }
    return std::nullopt;
  }

 private:
  // Excel's own first line, `sep=;`, by which it opens a list wherever it is.
  bool take_separator() {
    std::string_view line = text_.substr(0, text_.find('\n'));
    while (line.ends_with(' ')) line.remove_suffix(1);
    if (line.starts_with('"') && line.ends_with('"') && line.size() > 1)
      line = line.substr(1, line.size() - 2);
    if (!line.starts_with("sep=") && !line.starts_with("SEP=")) return false;
    line.remove_prefix(4);
    const bool is_one = !line.empty() && line.find_first_not_of(line.front()) == std::string_view::npos;
    constexpr std::string_view possible = ";,\t|:";
    const bool is_good = is_one && possible.find(line.front()) != std::string_view::npos;
    if (is_good) {
      separator_ = line.front();
    } else {
      diagnostics_.error(place_, quote(line) + " separates no cells",
                         "write sep=; or sep=, or remove the line: the first line of the list tells it");
    }
    while (at_ < text_.size() && peek() != '\n') step();
    return is_good;
  }

  char peek() const { return text_[at_]; }

  void step() {
    if (text_[at_] == '\n') {
      ++place_.line;
      place_.column = 1;
    } else if ((static_cast<unsigned char>(text_[at_]) & 0xC0) != 0x80) {
      ++place_.column;  // not for the further bytes of a character in UTF-8
    }
    ++at_;
  }

  bool ends_cell() const { return at_ == text_.size() || peek() == separator_ || peek() == '\n'; }

  char find_separator() const {
    bool quoted = false, comment = false, fresh = true;
    for (const char c : text_.substr(at_)) {
      if (fresh && c == '#') comment = true;
      fresh = c == '\n';
      if (fresh) comment = false;
      if (comment) continue;
      if (c == '"') quoted = !quoted;
      if (!quoted && (c == ';' || c == ',')) return c;
    }
    return ',';
  }

  std::vector<CsvCell> record() {
    std::vector<CsvCell> cells;
    while (true) {
      cells.push_back(cell());
      if (at_ == text_.size() || peek() != separator_) break;
      step();
    }
    while (at_ < text_.size() && peek() != '\n') step();
    if (at_ < text_.size()) step();
    return cells;
  }

  CsvCell cell() {
    while (at_ < text_.size() && blank(peek()) && peek() != separator_) step();
    CsvCell result{"", place_};
    if (at_ < text_.size() && peek() == '"') {
      quoted_cell(result);
      return result;
    }
    const std::size_t start = at_;
    while (!ends_cell()) step();
    result.text = trimmed(text_.substr(start, at_ - start));
    return result;
  }

  void quoted_cell(CsvCell& result) {
    step();
    while (at_ < text_.size()) {
      if (peek() == '"') {
        step();
        if (at_ == text_.size() || peek() != '"') break;
      }
      result.text += peek();
      step();
      if (at_ == text_.size())
        diagnostics_.error(result.position, "a quoted cell is never closed",
                           "add the closing quote; a quote inside is written twice");
    }
    while (!ends_cell()) {
      if (!blank(peek())) {
        diagnostics_.error(place_, "text after the closing quote of a cell",
                           "put the whole cell in quotes; a quote inside is written twice");
        while (!ends_cell()) step();
        return;
      }
      step();
    }
  }

  std::string_view text_;
  Diagnostics& diagnostics_;
  Position place_;
  std::size_t at_ = 0;
  char separator_ = ',';
};

// A spreadsheet keeps columns that were used once: without a name, and without a cell.
void leave_out_empty_columns(CsvTable& table) {
  for (std::size_t i = table.header.size(); i-- > 0;) {
    const auto is_used = [i](const CsvRow& row) { return has_text(row[i]); };
    if (has_text(table.header[i]) || std::any_of(table.rows.begin(), table.rows.end(), is_used)) continue;
    const auto place = static_cast<std::ptrdiff_t>(i);
    table.header.erase(table.header.begin() + place);
    for (CsvRow& row : table.rows) row.cells.erase(row.cells.begin() + place);
  }
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  for (std::size_t i = 0; i < header.size(); ++i)
    if (header[i].text == name) return i;
  return std::nullopt;
}

std::optional<std::size_t> CsvTable::required_column(std::string_view name, Diagnostics& diagnostics) const {
  if (const auto found = column(name)) return found;
  std::vector<std::string> known;
  for (const CsvCell& cell : header) known.push_back(cell.text);
  diagnostics.error(header.front().position, "this list has no column " + quote(name),
                    // The name that is asked for is right: what stands there may be a column of its own.
                    suggest(name, known, "columns", "add it to the first line").text);
  return std::nullopt;
}

std::optional<std::int64_t> CsvTable::integer(const CsvCell& cell, Diagnostics& diagnostics) {
  std::string_view digits = cell.text;
  const bool negative = digits.starts_with('-');
  if (negative) digits.remove_prefix(1);
  const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
  if (hexadecimal) digits.remove_prefix(2);
  std::int64_t value = 0;
  const auto [end, failed] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 10);
  if (failed == std::errc{} && end == digits.data() + digits.size() && !digits.starts_with('-'))
    return negative ? -value : value;
  diagnostics.error(cell.position, quote(cell.text) + " is not a whole number", "write it as 31 or 0x1F");
  return std::nullopt;
}

std::optional<double> CsvTable::number(const CsvCell& cell, Diagnostics& diagnostics) {
  double value = 0;
  const auto [end, failed] = std::from_chars(cell.text.data(), cell.text.data() + cell.text.size(), value);
  if (failed == std::errc{} && end == cell.text.data() + cell.text.size()) return value;
  diagnostics.error(cell.position, quote(cell.text) + " is not a number",
                    cell.text.find(',') != std::string::npos ? "write the fraction after a point, as 1.5"
                                                             : "write it as 1.5 or 2e-3");
  return std::nullopt;
}

std::optional<CsvTable> parse_csv(std::string_view text, const std::filesystem::path& file,
                                  Diagnostics& diagnostics) {
  const std::string_view name = intern(file.generic_string());
  if (!check_utf8(text, name, diagnostics)) return std::nullopt;
  const std::string plain = with_plain_line_ends(text);
  Scanner scanner(plain, name, diagnostics);
  CsvTable table;
  auto header = scanner.next();
  if (!header) {
    diagnostics.error({name, 1, 1}, "this list is empty", "its first line names the columns");
    return std::nullopt;
  }
  table.header = std::move(*header);
  if (table.header.size() > most_columns) {
    diagnostics.error({name, 1, 1},
                      "the first line of this list has " + std::to_string(table.header.size()) + " columns",
                      "it names the columns, at most " + std::to_string(most_columns) +
                          ": look for a cell whose quotes are never closed");
    return std::nullopt;
  }
  for (std::size_t i = 0; i < table.header.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (has_text(table.header[i]) && table.header[i].text == table.header[k].text)
        diagnostics.error(table.header[i].position,
                          "the column " + quote(table.header[i].text) + " is there twice",
                          "rename one; the other is at " + to_string(table.header[k].position));
  const std::size_t columns = table.header.size();
  std::size_t named = columns;
  while (!has_text(table.header[named - 1])) --named;
  while (auto cells = scanner.next()) {
    while (cells->size() > columns && !has_text(cells->back())) cells->pop_back();
    while (cells->size() >= named && cells->size() < columns) cells->push_back({"", cells->back().position});
    if (cells->size() == columns) {
      table.rows.push_back({std::move(*cells)});
      continue;
    }
    diagnostics.error(cells->front().position,
                      "this row has " + std::to_string(cells->size()) + " cells, but there are " +
                          std::to_string(columns) + " columns",
                      "put cells that contain the separator in double quotes");
  }
  leave_out_empty_columns(table);
  return table;
}

std::optional<CsvTable> read_csv(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const auto text = read_source(file, diagnostics);
  return text ? parse_csv(*text, file, diagnostics) : std::nullopt;
}

}  // namespace flexrf::config_gen
