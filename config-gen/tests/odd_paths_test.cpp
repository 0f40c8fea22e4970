// Folders may have any name: what is made of the tables in them is C++ all the same, paths that it cites
// included.
#include <filesystem>
#include <iostream>

#include "config-gen/tests/generated_compiler.hpp"
#include "config-gen/tests/mutation_judge.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* odd_name = "we\"ird \\ folder";

// An application with types, units, interfaces and drivers of its own, each kind in a folder of that name.
Cell move_to_odd_folders(const TableTree& tree) {
  const fs::path place = tree.root() / "tests/generator";
  Cell cell = tree.cells().front();
  const auto move = [](const fs::path& from, const fs::path& folder) {
    fs::create_directories(folder);
    fs::rename(from, folder / odd_name);
    return folder / odd_name;
  };
  cell.paths.interfaces.push_back(move(place / "interfaces", place / "with_interfaces"));
  cell.paths.drivers.push_back(move(place / "drivers", place / "with_drivers"));
  cell.paths.units.push_back(move(place / "cell/units", place / "with_units"));
  // This one is in no #include, where a line cannot be broken.
  const fs::path application = place / (std::string(odd_name) + "\nof two lines??");
  fs::rename(place / "cell", application);
  cell.table = application / "generated_cell.toml";
  return cell;
}

bool compiles() {
  const TableTree tree(place::repository);
  const Cell cell = move_to_odd_folders(tree);
  const Judgement judgement = judge(cell);
  if (!judgement.accepted) {
    std::cerr << "the tables are not accepted: " << judgement.wrong << '\n';
    return false;
  }
  bool cites = false;
  for (const GeneratedFile& file : judgement.files)
    cites = cites || file.contents.find("we\\\"ird \\\\ folder") != std::string::npos;
  GeneratedCompiler compiler(tree, {place::compiler, place::repository, place::eigen});
  const bool accepted = compiler.accepts(judgement, cell);
  if (!accepted) std::cerr << compiler.messages().substr(0, 4000);
  return accepted && cites;
}

void an_application_in_a_folder_of_any_name_compiles(void**) {
  assert_true(compiles());
}

}  // namespace
}  // namespace flexrf::config_gen::tests

int main() {
  using namespace flexrf::config_gen::tests;
  const CMUnitTest tests[] = {cmocka_unit_test(an_application_in_a_folder_of_any_name_compiles)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
