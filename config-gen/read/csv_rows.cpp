#include "config-gen/read/csv_rows.hpp"

#include <algorithm>
#include <utility>

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {

bool CsvRowReader::find_columns(std::initializer_list<std::size_t> needed) {
  const std::vector<std::string> known(columns_.begin(), columns_.end());
  for (const CsvCell& one : table_.header) {
    if (one.text.empty()) {
      error(one, std::string(list_) + " has a column without a name, and cells in it",
            "name it in the first line, one of " + listed(known));
    } else if (std::find(known.begin(), known.end(), one.text) == known.end()) {
      error(one, std::string(list_) + " has no column " + quote(one.text),
            suggest(one.text, known, "columns", "remove it"));
    }
  }
  for (const char* const column : columns_) places_.push_back(table_.column(column));
  for (const std::size_t column : needed) {
    if (!table_.required_column(columns_[column], diagnostics_)) failed_ = true;
  }
  return !failed_;
}

const CsvCell* CsvRowReader::cell(std::size_t column) const {
  if (!places_[column]) return nullptr;
  const CsvCell& found = (*row_)[*places_[column]];
  return found.text.empty() ? nullptr : &found;
}

const CsvCell& CsvRowReader::place(std::size_t column) const {
  return places_[column] ? (*row_)[*places_[column]] : row_->cells.front();
}

std::optional<std::size_t> CsvRowReader::word(std::size_t column, const std::vector<std::string>& words,
                                              std::string_view doubt) {
  const CsvCell* const found = cell(column);
  if (found == nullptr) return std::nullopt;
  const auto known = std::find(words.begin(), words.end(), found->text);
  if (known != words.end()) return static_cast<std::size_t>(known - words.begin());
  Hint hint = suggest(found->text, words, "ones", "write one of " + listed(words));
  if (!doubt.empty()) hint = std::move(hint).doubted(std::string(doubt));
  error(*found, quote(found->text) + " is no " + columns_[column] + std::string(of_row_), std::move(hint));
  return std::nullopt;
}

void CsvRowReader::error(const CsvCell& cell, std::string text, Hint hint) {
  failed_ = true;
  diagnostics_.error(cell.position, std::move(text), std::move(hint));
}

}  // namespace flexrf::config_gen
