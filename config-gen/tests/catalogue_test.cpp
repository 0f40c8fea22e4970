// Broken tables, each with the exact messages that a person gets. After a deliberate change of messages, run
// this test with FLEXRF_REWRITE_CATALOGUE=1 and read the difference.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "config-gen/model/file_contents.hpp"
#include "config-gen/tests/tables.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

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

struct Tally {
  std::size_t cases = 0;
  std::size_t wrong = 0;
};

Tally judge_all() {
  fs::current_path(place::tests_folder);
  const bool rewrite = std::getenv("FLEXRF_REWRITE_CATALOGUE") != nullptr;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator("catalogue")) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  Tally tally;
  for (const fs::path& folder : folders) {
    ++tally.cases;
    const Result result = read_cell(folder, Stage::emit);
    const std::string actual = shortened(result.messages, folder.generic_string() + "/");
    if (rewrite) std::ofstream(folder / "expected.txt", std::ios::binary) << actual;
    const std::string expected = contents_of(folder / "expected.txt");
    const bool only_warnings = expected.find(": error: ") == std::string::npos;
    if (actual == expected && has_hints(actual) && result.failed != only_warnings) continue;
    ++tally.wrong;
    print_difference(folder.filename().string(), expected, actual);
  }
  return tally;
}

void broken_tables_give_their_messages(void**) {
  const Tally tally = judge_all();
  assert_true(tally.cases >= 60);
  assert_int_equal(tally.wrong, 0);
}

}  // namespace
}  // namespace flexrf::config_gen::tests

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(flexrf::config_gen::tests::broken_tables_give_their_messages)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
