// A list in CSV, whatever it is.
#include <sstream>

#include "config-gen/read/csv.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace flexrf::fuzz {

std::vector<Bytes> seeds() {
  return {
      bytes_of(
          "name,address,type,scale\nspeed,0x1F,i16,0.1\n\"with \"\"quotes\"\", and\nlines\",2,f32,-1e3\n"),
      bytes_of("\xEF\xBB\xBF# comment\r\nname; address ;type\r\na;1;bool\r\n\r\nb;-2;u16;too;many\r\n")};
}

void take(std::span<const std::uint8_t> bytes) {
  using namespace config_gen;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Diagnostics diagnostics;
  const auto table = parse_csv(text, "fuzz.csv", diagnostics);
  expect(table.has_value() || diagnostics.failed());
  if (table) {
    static_cast<void>(table->required_column("address", diagnostics));
    for (const CsvRow& row : table->rows) {
      expect(row.cells.size() == table->header.size());
      for (const CsvCell& cell : row.cells) {
        static_cast<void>(CsvTable::integer(cell, diagnostics));
        static_cast<void>(CsvTable::number(cell, diagnostics));
      }
    }
  }
  std::ostringstream told;
  diagnostics.print(told);
}

}  // namespace flexrf::fuzz
