// What the tables say of a program, and the lines that are made of what it prints.
#include <string>

#include "hal/process/interface/hosted_process.hpp"
#include "hal/process/interface/word_list.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

std::string joined(std::string_view text) {
  const Result<std::vector<std::string>> words = words_of(text);
  if (!words) return "refused";
  std::string all;
  for (const std::string& word : *words) all += "<" + word + ">";
  return all;
}

// [word-list-1]
void blanks_part_words_and_quotes_keep_them(void**) {
  assert_true(joined("") == "");
  assert_true(joined("  ") == "");
  assert_true(joined("a  b\tc") == "<a><b><c>");
  assert_true(joined("'a b' \"c d\" e' f'") == "<a b><c d><e f>");
  assert_true(joined("'' x") == "<><x>");
  assert_true(joined(R"(a\ b "\"" '\' \\)") == R"(<a b><"><\><\>)");
  assert_true(joined("$HOME *") == "<$HOME><*>");
}

// [word-list-2]
void what_is_not_closed_is_refused(void**) {
  assert_true(joined("'a") == "refused");
  assert_true(joined("\"a'") == "refused");
  assert_true(joined("a\\") == "refused");
}

std::string cause(const Result<ProcessProgram>& program) {
  return program ? "" : program.status().cause();
}

void a_program_is_checked_and_told_apart(void**) {
  assert_true(cause(process_program("cat", "", "", "/")).find("configuration.executable \"cat\"") == 0);
  assert_true(cause(process_program("", "", "", "/")).find("configuration.executable") == 0);
  assert_true(cause(process_program("/bin/cat", "", "", "x")).find("configuration.working_directory") == 0);
  assert_true(cause(process_program("/bin/cat", "'", "", "/")).find("configuration.arguments") == 0);
  assert_true(cause(process_program("/bin/cat", "", "A", "/")).find("NAME=value") != std::string::npos);
  assert_true(cause(process_program("/bin/cat", "", "=1", "/")).find("NAME=value") != std::string::npos);
}

void only_the_tables_environment_is_given(void**) {
  const Result<ProcessProgram> program = process_program("/bin/cat", "-n", "A='b c'", "/tmp");
  assert_true(program && program->environment.size() == 2 && program->environment[0] == "A=b c" &&
              program->environment[1].starts_with("PATH="));
  const Result<ProcessProgram> own = process_program("/bin/cat", "", "PATH=/x", "/");
  assert_true(own && own->environment.size() == 1 && own->environment[0] == "PATH=/x");
}

std::string taken(ProcessLines& lines) {
  std::string all;
  ProcessLine line;
  while (lines.take(line)) {
    all += line.source == ProcessSource::error ? "!" : "";
    all += std::string(line.content_view()) + (line.cut ? "~" : "") + "|";
  }
  return all;
}

ProcessLines lines;

// [process-lines-1]
void lines_come_in_pieces(void**) {
  lines.restart();
  lines.put(ProcessSource::output, "on", Time{});
  lines.put(ProcessSource::error, "err\n", Time{});
  lines.put(ProcessSource::output, "e\r\n\ntwo\nthr", Time{});
  assert_true(taken(lines) == "!err|one||two|");
  lines.put(ProcessSource::output, std::string_view("e\0e", 3), Time{});
  lines.finish(Time{});
  lines.finish(Time{});
  assert_true(taken(lines) == "thre?e|");
  assert_int_equal(lines.lines(), 5);
}

// [process-lines-2]
void long_lines_are_cut_and_many_are_dropped(void**) {
  lines.restart();
  const std::string longest(sizeof(ProcessLine::content), 'x');
  lines.put(ProcessSource::output, longest + "\n" + longest + "yz\nok\n", Time{});
  assert_true(taken(lines) == longest + "|" + longest + "~|ok|");
  assert_int_equal(lines.cut(), 1);
  for (std::size_t i = 0; i < Process::line_capacity + 3; ++i)
    lines.put(ProcessSource::output, "n\n", Time{});
  assert_int_equal(lines.dropped(), 3);
  ProcessLine line;
  for (std::size_t i = 0; i < Process::line_capacity; ++i) assert_true(lines.take(line));
  assert_false(lines.take(line));
  lines.put(ProcessSource::output, "n\n", Time{});
  // The gap is seen in the numbers.
  assert_true(lines.take(line));
  assert_int_equal(line.number, 3 + Process::line_capacity + 3 + 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(blanks_part_words_and_quotes_keep_them),
      cmocka_unit_test(what_is_not_closed_is_refused),
      cmocka_unit_test(a_program_is_checked_and_told_apart),
      cmocka_unit_test(only_the_tables_environment_is_given),
      cmocka_unit_test(lines_come_in_pieces),
      cmocka_unit_test(long_lines_are_cut_and_many_are_dropped),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
