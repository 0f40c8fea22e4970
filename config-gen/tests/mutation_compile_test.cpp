// Of tables changed at random those that config-gen accepts make C++ that a compiler accepts, too: names of
// the runtime, of the standard library and of C++ among them, and texts that C++ takes for something else.
// Classes that an author writes are made up here, for their own text is not what is judged.
//
//   config_gen_mutation_compile_test [COUNT [FIRST]]    default: 300 0
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>

#include "config-gen/model/file_contents.hpp"
#include "config-gen/tests/mutation_judge.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

std::uint64_t first = 0;
std::uint64_t count = 300;

void write_file(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

// FlexRF's own tables stay as they are, for the runtime's C++ is written for them.
bool is_own(const TableTree& tree, const fs::path& file) {
  const std::string place = fs::relative(file, tree.root()).generic_string();
  return place.starts_with("runtime/") || place.starts_with("hal/");
}

std::string class_text(std::string_view space, const std::string& name, const std::string& base,
                       const char* body) {
  return "namespace " + std::string(space) + " {\nclass " + name + " : public " + base + " {\n public:\n" +
         body + "};\n}\n";
}

class Compiler {
 public:
  explicit Compiler(const TableTree& tree) : tree_(tree), folder_(tree.root() / "generated") {
    // What is included by all is read once.
    write_file(
        folder_ / "common.hpp",
        "#include <Eigen/Core>\n#include \"runtime/blackboard/doorbell.hpp\"\n"
        "#include \"runtime/blackboard/history.hpp\"\n#include \"runtime/blackboard/job_queue.hpp\"\n"
        "#include \"runtime/blackboard/ports.hpp\"\n#include \"runtime/blackboard/queue_ring.hpp\"\n"
        "#include \"runtime/blackboard/slot.hpp\"\n#include \"runtime/core/text.hpp\"\n"
        "#include \"runtime/core/type_descriptor.hpp\"\n#include \"runtime/device/device.hpp\"\n"
        "#include \"runtime/executive/application.hpp\"\n#include \"runtime/executive/cell_access.hpp\"\n"
        "#include \"runtime/executive/panel_record.hpp\"\n#include \"runtime/unit/unit.hpp\"\n");
    for (const auto& entry : fs::directory_iterator(tree.root() / "hal/interfaces"))
      make_types(entry.path() / "types");
    make_types(tree.root() / "runtime/types");
    if (!run("-x c++-header " + (folder_ / "common.hpp").string() + " -o " +
             (folder_ / "common.hpp.gch").string()))
      throw std::runtime_error("the runtime's headers do not compile");
  }

  // Everything that is generated for the application and what it uses, as one source.
  bool accepts(const Judgement& judgement, const Cell& cell) {
    const fs::path mine = folder_ / "mine";
    fs::remove_all(mine);
    const Model& model = judgement.model;
    std::string sources;
    std::set<fs::path> folders;
    for (const Type& type : model.types) folders.insert(type.file.parent_path());
    for (const fs::path& folder : folders)
      if (!is_own(tree_, folder / "any.toml")) sources += make(model, {Target::Kind::types, folder}, mine);
    for (const Interface& interface : model.interfaces) {
      sources += make(model, {Target::Kind::interface, interface.file}, mine);
      write_file(
          mine / author_header(interface.file, interface.name + ".hpp"),
          "#pragma once\n#include \"" + interface.name + "_interface.hpp\"\n" +
              class_text(interface.space, interface.class_name, interface.class_name + "Interface", ""));
    }
    for (const Driver& driver : model.drivers) {
      // Its class may be abstract here, for what it implements is made up. FlexRF's own are compiled by its
      // build.
      sources += make(model, {Target::Kind::driver, driver.file}, mine,
                      is_own(tree_, driver.file) ? ".cpp" : "_construct.cpp");
      write_file(mine / author_header(driver.file, driver.header),
                 "#pragma once\n#include \"" + driver.base_header + "\"\n" +
                     class_text(driver.space, driver.class_name, driver.base_class, ""));
    }
    for (const UnitType& unit : model.unit_types) {
      sources += make(model, {Target::Kind::unit, unit.file}, mine);
      write_file(mine / author_header(unit.file, unit.header),
                 "#pragma once\n#include \"" + unit.base_header + "\"\n" +
                     class_text(unit.space, unit.class_name, unit.base_class,
                                "  flexrf::Status initialise() override { return {}; }\n"
                                "  void step(const flexrf::Tick&) override {}\n"));
    }
    sources += make(model, {Target::Kind::application, cell.table}, mine);
    write_file(mine / "all.cpp", sources);
    return run("-fsyntax-only -Werror -include " + (folder_ / "common.hpp").string() + " -I" + mine.string() +
               " " + (mine / "all.cpp").string());
  }

  std::string messages() const { return contents_of(folder_ / "messages.txt"); }

 private:
  static fs::path author_header(const fs::path& table, const std::string& header) {
    const fs::path folder = table.parent_path();
    return folder.parent_path().filename() / folder.filename() / header;
  }

  // The files of a target; as lines that include its sources.
  std::string make(const Model& model, const Target& target, const fs::path& folder,
                   const std::string& but = "-") {
    Diagnostics diagnostics;
    std::string sources;
    for (const GeneratedFile& file : emit(model, target, diagnostics)) {
      write_file(folder / file.path, file.contents);
      const std::string name = file.path.generic_string();
      if (name.ends_with(".cpp") && !name.ends_with(but)) sources += "#include \"" + name + "\"\n";
    }
    return sources;
  }

  void make_types(const fs::path& types) {
    if (!fs::exists(types)) return;
    SearchPaths paths = tree_.cells().front().paths;
    Diagnostics diagnostics;
    const Target target{Target::Kind::types, types};
    make(read(target, paths, diagnostics), target, folder_ / "library");
  }

  bool run(const std::string& arguments) {
    const std::string command = std::string(place::compiler) + " -std=c++20 -Wall -Wno-subobject-linkage -I" +
                                (folder_ / "library").string() + " -I" + place::repository + " -I" +
                                place::repository + "/hal -isystem " + place::eigen + " " + arguments +
                                " > " + (folder_ / "messages.txt").string() + " 2>&1";
    return std::system(command.c_str()) == 0;
  }

  const TableTree& tree_;
  fs::path folder_;
};

std::size_t wrong_sources() {
  const TableTree tree(place::repository);
  Compiler compiler(tree);
  std::size_t compiled = 0, wrong = 0;
  constexpr std::size_t large = 6, most_shown = 10;
  for (std::uint64_t number = first; compiled < count; ++number) {
    Dice dice(~number);
    const Cell& cell = tree.cells()[dice.below(large)];
    const Mutation mutation(tree, cell, number, [&](const fs::path& file) { return !is_own(tree, file); });
    if (mutation.empty()) continue;
    const Judgement judgement = judge(cell);
    if (!judgement.accepted) continue;
    ++compiled;
    if (compiler.accepts(judgement, cell)) continue;
    if (++wrong <= most_shown)
      std::cerr << "mutation " << number << " of " << cell.table.string()
                << " is accepted and does not compile:\n"
                << mutation.description() << compiler.messages().substr(0, 2000) << '\n';
  }
  std::cout << compiled << " accepted mutations compiled, " << wrong << " not accepted by the compiler\n";
  return wrong;
}

void what_is_accepted_compiles(void**) {
  assert_int_equal(wrong_sources(), 0);
}

}  // namespace
}  // namespace flexrf::config_gen::tests

int main(int argument_count, char** arguments) {
  using namespace flexrf::config_gen::tests;
  if (argument_count > 1) count = std::strtoull(arguments[1], nullptr, 10);
  if (argument_count > 2) first = std::strtoull(arguments[2], nullptr, 10);
  const CMUnitTest tests[] = {cmocka_unit_test(what_is_accepted_compiles)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
