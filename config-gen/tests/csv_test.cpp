#include "config-gen/read/csv.hpp"

#include <sys/stat.h>

#include <cstring>
#include <sstream>

#include "config-gen/tests/temporary_folder.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::csv_test {
namespace {

struct Parsed {
  std::optional<CsvTable> table;
  std::string messages;
  Diagnostics diagnostics;
};

Parsed parse(std::string_view text) {
  Parsed parsed;
  parsed.table = parse_csv(text, "list.csv", parsed.diagnostics);
  std::ostringstream out;
  parsed.diagnostics.print(out);
  parsed.messages = out.str();
  return parsed;
}

// All cells of all rows, as "a|b\n".
std::string cells(const Parsed& parsed) {
  std::string text;
  for (const CsvRow& row : parsed.table->rows) {
    for (const CsvCell& cell : row.cells) text += cell.text + "|";
    text += "\n";
  }
  return text;
}

// Reading it would not end before somebody has written.
void a_pipe_is_no_list(void**) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path pipe = folder.path() / "list.csv";
  assert_int_equal(mkfifo(pipe.c_str(), 0600), 0);
  Diagnostics diagnostics;
  assert_false(read_csv(pipe, diagnostics).has_value());
  std::ostringstream out;
  diagnostics.print(out);
  assert_non_null(
      std::strstr(out.str().c_str(), "this is a pipe, and no file that could be read as a whole"));
}

void both_separators(void**) {
  assert_string_equal(cells(parse("name,address\ndoor, 1 \nlamp,2\n")).c_str(), "door|1|\nlamp|2|\n");
  assert_string_equal(cells(parse("name;address\ndoor;1,5\n")).c_str(), "door|1,5|\n");
  assert_string_equal(cells(parse("\"a,b\";c\n1;2\n")).c_str(), "1|2|\n");
}

void quotes(void**) {
  assert_string_equal(cells(parse("a,b\n\"x, y\",\"say \"\"no\"\"\"\n")).c_str(), "x, y|say \"no\"|\n");
  assert_string_equal(cells(parse("a,b\n\"two\nlines\",  \"\"\n")).c_str(), "two\nlines||\n");
}

void comments_and_line_ends(void**) {
  assert_string_equal(cells(parse("\xEF\xBB\xBF# made by hand, today\r\na;b\r\n\r\n# more\r\n1;2")).c_str(),
                      "1|2|\n");
  assert_string_equal(cells(parse("a,b\n1,\n,2\n")).c_str(), "1||\n|2|\n");
}

void as_excel_writes_it(void**) {
  const char* const lists[] = {"sep=;\r\na;b\r\n1,5;2\r\n",
                               "\xEF\xBB\xBFsep=;\na;b\n1,5;2\n",
                               "\"sep=;\"\na;b\n1,5;2\n",
                               "sep=;;;\na;b;;\n1,5;2;;\n",
                               "sep=\t\na\tb\n1,5\t2\n",
                               "# made by hand\na;b\n;\n1,5;2\n;\n;;;\n",
                               "a;b;\n1,5;2;\n",
                               "a;b;\n1,5;2\n"};
  for (const char* const list : lists) {
    const Parsed parsed = parse(list);
    assert_true(parsed.table.has_value());
    assert_string_equal(parsed.messages.c_str(), "");
    assert_string_equal(cells(parsed).c_str(), "1,5|2|\n");
  }
  // Places are those of the file; a column without a name that has cells is the reader's to judge.
  const Parsed used = parse("sep=;\na;;b\n1;tag;2\n");
  assert_string_equal(cells(used).c_str(), "1|tag|2|\n");
  assert_int_equal(used.table->rows[0][1].position.line, 3);
  assert_string_equal(
      parse("sep=x\na,b\n").messages.c_str(),
      "list.csv:1:1: error: 'x' separates no cells\n"
      "list.csv:1:1: hint: write sep=; or sep=, or remove the line: the first line of the list "
      "tells it\n");
  assert_false(parse("sep=;\n;;\n").table.has_value());
}

void places(void**) {
  const Parsed parsed = parse("# c\na,b\n\"x\ny\",ä,z\n");
  assert_string_equal(parsed.messages.c_str(),
                      "list.csv:3:1: error: this row has 3 cells, but there are 2 columns\n"
                      "list.csv:3:1: hint: put cells that contain the separator in double quotes\n");
  const Parsed wide = parse("a,b,c\nä, x,  7\n");
  const Position last = wide.table->rows[0][2].position;
  assert_int_equal(last.line, 2);
  assert_int_equal(last.column, 8);
}

void line_ends_of_carriage_returns(void**) {
  const Parsed parsed = parse("name,address\r# a comment\rdoor,1\r\r\"two\rlines\",2");
  assert_false(parsed.diagnostics.failed());
  assert_int_equal(parsed.table->header.size(), 2);
  assert_int_equal(parsed.table->rows.size(), 2);
  assert_string_equal(parsed.table->rows[0][0].text.c_str(), "door");
  assert_string_equal(parsed.table->rows[1][0].text.c_str(), "two\nlines");
  assert_int_equal(parsed.table->rows[1][1].position.line, 6);
}

void mistakes(void**) {
  assert_string_equal(
      parse("").messages.c_str(),
      "list.csv:1:1: error: this list is empty\nlist.csv:1:1: hint: its first line names the columns\n");
  assert_false(parse("# only a comment\n").table.has_value());
  assert_string_equal(parse("a,a\n").messages.c_str(),
                      "list.csv:1:3: error: the column 'a' is there twice\n"
                      "list.csv:1:3: hint: rename one; the other is at list.csv:1:1\n");
  assert_non_null(
      strstr(parse("a,b\n\"x,1\n").messages.c_str(), "list.csv:2:1: error: a quoted cell is never closed"));
  assert_non_null(
      strstr(parse("a,b\n\"x\"y,1\n").messages.c_str(), "list.csv:2:4: error: text after the closing quote"));
}

void values(void**) {
  Parsed parsed = parse("name,address\ndoor,0x1F\nlamp,-12\nbell,\"1,5\"\n");
  const CsvTable& table = *parsed.table;
  assert_int_equal(CsvTable::integer(table.rows[0][1], parsed.diagnostics).value_or(0), 31);
  assert_int_equal(CsvTable::integer(table.rows[1][1], parsed.diagnostics).value_or(0), -12);
  assert_true(CsvTable::number(table.rows[1][1], parsed.diagnostics) == -12.0);
  assert_false(parsed.diagnostics.failed());
  assert_false(CsvTable::number(table.rows[2][1], parsed.diagnostics).has_value());
  assert_false(CsvTable::integer(table.rows[0][0], parsed.diagnostics).has_value());
  assert_int_equal(table.required_column("address", parsed.diagnostics).value_or(9), 1);
  assert_false(table.required_column("adress", parsed.diagnostics).has_value());
  std::ostringstream out;
  parsed.diagnostics.print(out);
  assert_string_equal(out.str().c_str(),
                      "list.csv:1:1: error: this list has no column 'adress'\n"
                      "list.csv:1:1: hint: did you mean 'address'?\n"
                      "list.csv:2:1: error: 'door' is not a whole number\n"
                      "list.csv:2:1: hint: write it as 31 or 0x1F\n"
                      "list.csv:4:6: error: '1,5' is not a number\n"
                      "list.csv:4:6: hint: write the fraction after a point, as 1.5\n");
}

}  // namespace
}  // namespace flexrf::config_gen::csv_test

int main() {
  using namespace flexrf::config_gen::csv_test;
  const CMUnitTest tests[] = {cmocka_unit_test(a_pipe_is_no_list),
                              cmocka_unit_test(both_separators),
                              cmocka_unit_test(quotes),
                              cmocka_unit_test(comments_and_line_ends),
                              cmocka_unit_test(as_excel_writes_it),
                              cmocka_unit_test(places),
                              cmocka_unit_test(line_ends_of_carriage_returns),
                              cmocka_unit_test(mistakes),
                              cmocka_unit_test(values)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
