// Which names of tables would be replaced by macros: words.cpp lists them, and the headers have them.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "config-gen/model/file_contents.hpp"
#include "config-gen/model/words.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

// Other people's headers that the parts include which generated code is made with; not those of their tests.
Names included(const std::vector<std::string>& endings) {
  static const std::regex not_beside("/(tests|conformance|simulator)/|_(test|stress)\\.cpp$");
  static const std::regex line("(?:^|\n) *# *include (<[^>\n]+>)");
  Names headers;
  for (const char* const part : {"base", "runtime", "hal", "units", "apps"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(place::repository) / part)) {
      const std::string file = entry.path().generic_string();
      if (std::find(endings.begin(), endings.end(), entry.path().extension()) == endings.end() ||
          std::regex_search(file, not_beside))
        continue;
      const std::string text = contents_of(entry.path());
      for (auto found = std::sregex_iterator(text.begin(), text.end(), line); found != std::sregex_iterator();
           ++found)
        headers.insert((*found)[1]);
    }
  return headers;
}

bool can_be_a_name(const std::string& word) {
  return is_snake_case(word) || is_camel_case(word);
}

// Those that replace a name of a table wherever it stands: neither with arguments nor by themselves.
Names macros_of(const Names& headers) {
  std::string name = (fs::temp_directory_path() / "flexrf-macros-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder");
  const fs::path folder = name;
  {
    std::ofstream source(folder / "all.cpp");
    for (const std::string& header : headers) source << "#include " << header << "\n";
  }
  std::string command = std::string(place::compiler) + " -std=c++20 -dM -E";
  command += " -isystem " + std::string(place::eigen);
  std::istringstream folders(THIRD_PARTY_FOLDERS);
  for (std::string one; std::getline(folders, one, ':');) command += " -isystem " + one;
  command += " " + (folder / "all.cpp").string() + " > " + (folder / "macros").string();
  const bool done = std::system(command.c_str()) == 0;
  Names names;
  std::istringstream lines(contents_of(folder / "macros"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string define, macro, value;
    words >> define >> macro >> value;
    if (can_be_a_name(macro) && value != macro) names.insert(macro);
  }
  fs::remove_all(folder);
  if (!done) throw std::runtime_error("the headers do not compile");
  return names;
}

// What generated code sees is in the list, or written as a macro is: else a table is accepted that does not
// compile.
void what_replaces_a_name_is_known(void**) {
  const Names macros = macros_of(included({".hpp"}));
  assert_true(macros.size() > 10);
  bool all = true;
  for (const std::string& macro : macros) {
    if (is_macro(macro) || is_keyword(macro)) continue;
    all = false;
    std::cerr << "a header has a macro '" << macro
              << "': add it to `macros` in config-gen/model/words.cpp, so that no table has such a name\n";
  }
  assert_true(all);
}

// Nor does the list refuse names for which there is no reason.
void what_is_known_replaces_a_name(void**) {
  const Names macros = macros_of(included({".hpp", ".cpp"}));
  bool all = true;
  for (const std::string_view known : known_macros()) {
    if (macros.contains(std::string(known))) continue;
    all = false;
    std::cerr << "no header has a macro '" << known
              << "': take it out of `macros` in config-gen/model/words.cpp\n";
  }
  assert_true(all);
}

}  // namespace
}  // namespace flexrf::config_gen

int main() {
  using namespace flexrf::config_gen;
  const CMUnitTest tests[] = {cmocka_unit_test(what_replaces_a_name_is_known),
                              cmocka_unit_test(what_is_known_replaces_a_name)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
