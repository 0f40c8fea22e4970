// Lists in CSV, as spreadsheets and vendors write them: RFC 4180 quoting, separated by ',' or ';', lines that
// begin with '#' are comments, the first line names the columns. What Excel adds is taken as it is meant: a
// line sep=; before the list, rows without any text, columns without a name and without a cell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config-gen/model/diagnostics.hpp"

namespace flexrf::config_gen {

struct CsvCell {
  std::string text;  // without quotes; blanks around unquoted text removed
  Position position;
};

struct CsvRow {
  std::vector<CsvCell> cells;  // as many as there are columns
  const CsvCell& operator[](std::size_t column) const { return cells[column]; }
};

class CsvTable {
 public:
  std::vector<CsvCell> header;
  std::vector<CsvRow> rows;

  // The column of this name; nothing when there is none.
  std::optional<std::size_t> column(std::string_view name) const;
  // The same, and a missing one is reported with the nearest.
  std::optional<std::size_t> required_column(std::string_view name, Diagnostics& diagnostics) const;

  // A cell's value; nothing when it is not such a one, which is reported. Whole numbers may be hexadecimal,
  // as 0x1F.
  static std::optional<std::int64_t> integer(const CsvCell& cell, Diagnostics& diagnostics);
  static std::optional<double> number(const CsvCell& cell, Diagnostics& diagnostics);
};

// The separator is what a line sep= tells, else the one of ';' and ',' that occurs first outside of quotes in
// the header. Nothing when the file cannot be read or is empty; rows with too many or too few cells are
// reported and left out.
std::optional<CsvTable> read_csv(const std::filesystem::path& file, Diagnostics& diagnostics);
std::optional<CsvTable> parse_csv(std::string_view text, const std::filesystem::path& file,
                                  Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
