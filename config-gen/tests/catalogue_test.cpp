// Broken tables, each with the exact messages that a person gets: a file of catalogue/ each, whose form
// catalogue_case.hpp tells. After a deliberate change of messages, run this test with
// FLEXRF_REWRITE_CATALOGUE=1 and read the difference.
//
//   config_gen_catalogue_test [NAME FOLDER]    with both: writes the whole cell of that case into the folder

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <vector>

#include "config-gen/tests/catalogue_case.hpp"
#include "config-gen/tests/lines.hpp"
#include "config-gen/tests/tables.hpp"
#include "config-gen/tests/temporary_folder.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

// Paths as seen from the case's own folder.
std::string shortened(std::string text, const std::string& folder) {
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
    text.erase(at, folder.size());
  return text;
}

void print_difference(const std::string& name, const std::string& expected, const std::string& actual) {
  const auto wanted = lines_of(expected), got = lines_of(actual);
  std::cerr << "catalogue/" << name << ":\n";
  for (const std::string& line : wanted)
    if (std::find(got.begin(), got.end(), line) == got.end()) std::cerr << "  - " << line << '\n';
  for (const std::string& line : got)
    if (std::find(wanted.begin(), wanted.end(), line) == wanted.end()) std::cerr << "  + " << line << '\n';
  if (wanted.size() == got.size() && std::is_permutation(wanted.begin(), wanted.end(), got.begin()))
    std::cerr << "  the same lines in another order\n";
}

// Every message says what to do about it.
bool has_hints(const std::string& text) {
  const auto lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool message =
        lines[i].find(": error: ") != std::string::npos || lines[i].find(": warning: ") != std::string::npos;
    if (message && (i + 1 == lines.size() || lines[i + 1].find(": hint: ") == std::string::npos))
      return false;
  }
  return !lines.empty();
}

fs::path catalogue() {
  return fs::path(place::tests_folder) / "catalogue";
}

// Where whole cells are written, and read with the tables of base/ beside them. Messages name both from here.
class Workshop {
 public:
  Workshop() {
    fs::copy(fs::path(place::tests_folder) / "base", folder_.path() / "base", fs::copy_options::recursive);
    fs::current_path(folder_.path());
  }

  Result read(const Files& files, const std::string& name) {
    const fs::path folder = fs::path("catalogue") / name;
    write_cell(files, folder);
    Result result = read_cell(folder, Stage::emit);
    result.messages = shortened(result.messages, folder.generic_string() + "/");
    return result;
  }

 private:
  TemporaryFolder folder_;
};

bool is_right(const fs::path& file, Workshop& workshop, bool rewrite) {
  const std::string name = file.stem().string();
  Case expected = read_case(file);
  const Result result = workshop.read(expected.files, name);
  if (rewrite) {
    rewrite_messages(file, result.messages);
    expected.messages = result.messages;
  }
  const bool only_warnings = expected.messages.find(": error: ") == std::string::npos;
  if (result.messages == expected.messages && has_hints(result.messages) && result.failed != only_warnings)
    return true;
  print_difference(name, expected.messages, result.messages);
  return false;
}

struct Tally {
  std::size_t cases = 0;
  std::size_t wrong = 0;
};

Tally judge_all() {
  Workshop workshop;
  const bool rewrite = std::getenv("FLEXRF_REWRITE_CATALOGUE") != nullptr;
  Tally tally;
  for (const fs::path& file : case_files(catalogue())) {
    ++tally.cases;
    try {
      if (is_right(file, workshop, rewrite)) continue;
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
    }
    ++tally.wrong;
  }
  return tally;
}

// [exec-14] [board-42]
void broken_tables_give_their_messages(void**) {
  const Tally tally = judge_all();
  assert_true(tally.cases >= 288);
  assert_int_equal(tally.wrong, 0);
}

Tally judge_bases() {
  Workshop workshop;
  Tally tally;
  for (const auto& base : fs::directory_iterator(catalogue() / "base")) {
    ++tally.cases;
    const std::string name = base.path().filename().string();
    const Result result = workshop.read(files_in(base.path()), name);
    if (result.messages.empty()) continue;
    ++tally.wrong;
    std::cerr << "catalogue/base/" << name << ":\n" << result.messages;
  }
  return tally;
}

// So that whatever is said of a case is said of its difference.
void what_the_cases_differ_from_is_good(void**) {
  const Tally tally = judge_bases();
  assert_true(tally.cases >= 10);
  assert_int_equal(tally.wrong, 0);
}

}  // namespace

int write_case(const std::string& name, const fs::path& folder) try {
  write_cell(read_case(catalogue() / (name + ".case")).files, folder);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}

}  // namespace flexrf::config_gen::tests

int main(int argument_count, char** arguments) {
  using namespace flexrf::config_gen::tests;
  if (argument_count == 3) return write_case(arguments[1], arguments[2]);
  const CMUnitTest tests[] = {cmocka_unit_test(what_the_cases_differ_from_is_good),
                              cmocka_unit_test(broken_tables_give_their_messages)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
