// The rows of a list whose columns have names that its reader knows.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config-gen/read/csv.hpp"

namespace flexrf::config_gen {

// What readers of such lists are derived from. A column is its place among the names.
class CsvRowReader {
 protected:
  // `list` and `of_row` are words of messages: "a register map has no column 'adress'", "'u7' is no type" and
  // then `of_row`, as " of an object". All outlive the object.
  CsvRowReader(const CsvTable& table, std::span<const char* const> columns, std::string_view list,
               std::string_view of_row, Diagnostics& diagnostics)
      : table_(table), diagnostics_(diagnostics), columns_(columns), list_(list), of_row_(of_row) {}

  // False where a column is one that nobody knows, or a needed one is not there: it has been said.
  bool find_columns(std::initializer_list<std::size_t> needed);

  // Null when the list has no such column or the cell is empty.
  const CsvCell* cell(std::size_t column) const;
  // The cell, or the row's first where there is none: something to point at.
  const CsvCell& place(std::size_t column) const;
  // Which of the words stands there; nothing where none does, and another one is reported.
  // `doubt` is why its nearest is not to be taken without looking.
  std::optional<std::size_t> word(std::size_t column, const std::vector<std::string>& words,
                                  std::string_view doubt = {});

  void error(const CsvCell& cell, std::string text, Hint hint);

  const CsvTable& table_;
  Diagnostics& diagnostics_;
  const CsvRow* row_ = nullptr;  // that is being read
  bool failed_ = false;

 private:
  std::span<const char* const> columns_;
  std::string_view list_;
  std::string_view of_row_;
  std::vector<std::optional<std::size_t>> places_;
};

}  // namespace flexrf::config_gen
