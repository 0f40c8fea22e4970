#include "config-gen/tests/generated_compiler.hpp"

#include <cstdlib>
#include <set>
#include <stdexcept>
#include <utility>

#include "config-gen/model/file_contents.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

std::string class_text(std::string_view space, const std::string& name, const std::string& base,
                       const std::string& body) {
  return "namespace " + std::string(space) + " {\nclass " + name + " : public " + base + " {\n public:\n" +
         body + "};\n}\n";
}

void make_file(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  write_file(file, text);
}

// As the shell takes it for one word.
std::string shell_word(const fs::path& path) {
  std::string text = "'";
  for (const char c : path.string()) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

bool is_own(const TableTree& tree, const fs::path& file) {
  const std::string place = fs::relative(file, tree.root()).generic_string();
  return place.starts_with("runtime/") || place.starts_with("hal/");
}

GeneratedCompiler::GeneratedCompiler(const TableTree& tree, Places places)
    : tree_(tree), places_(std::move(places)), folder_(tree.root() / "generated") {
  make_file(folder_ / "common.hpp",
            "#include <Eigen/Core>\n#include \"runtime/blackboard/doorbell.hpp\"\n"
            "#include \"runtime/blackboard/history.hpp\"\n#include \"runtime/blackboard/job_queue.hpp\"\n"
            "#include \"runtime/blackboard/ports.hpp\"\n#include \"runtime/blackboard/queue_ring.hpp\"\n"
            "#include \"runtime/blackboard/slot.hpp\"\n#include \"base/text.hpp\"\n"
            "#include \"runtime/core/type_descriptor.hpp\"\n#include \"runtime/device/device.hpp\"\n"
            "#include \"runtime/executive/application.hpp\"\n#include \"runtime/executive/cell_access.hpp\"\n"
            "#include \"runtime/executive/panel_record.hpp\"\n#include \"runtime/unit/unit.hpp\"\n");
  for (const auto& entry : fs::recursive_directory_iterator(tree.root() / "hal"))
    if (entry.is_directory() && entry.path().filename() == "types") make_types(entry.path());
  make_types(tree.root() / "runtime/types");
}

void GeneratedCompiler::precompile() {
  const fs::path header = folder_ / "common.hpp";
  if (!run("-x c++-header " + shell_word(header) + " -o " + shell_word(header.string() + ".gch")))
    throw std::runtime_error("the runtime's headers do not compile");
}

bool GeneratedCompiler::accepts(const Judgement& judgement, const Cell& cell) {
  const fs::path mine = folder_ / "mine";
  fs::remove_all(mine);
  make_file(mine / "all.cpp", make_sources(judgement, cell));
  return run("-fsyntax-only -Werror -include " + shell_word(folder_ / "common.hpp") + " -I" +
             shell_word(mine) + " " + shell_word(mine / "all.cpp"));
}

std::string GeneratedCompiler::messages() const {
  return contents_of(folder_ / "messages.txt");
}

std::string GeneratedCompiler::make_sources(const Judgement& judgement, const Cell& cell) const {
  const fs::path mine = folder_ / "mine";
  const Model& model = judgement.model;
  std::string sources;
  std::set<fs::path> folders;
  for (const Type& type : model.types) folders.insert(type.file.parent_path());
  for (const fs::path& folder : folders)
    if (!is_own(tree_, folder / "any.toml")) sources += make(model, {Target::Kind::types, folder}, mine);
  for (const Interface& interface : model.interfaces) {
    sources += make(model, {Target::Kind::interface, interface.file}, mine);
    const std::string base = interface.class_name + "Interface";
    make_file(mine / interface.header, "#pragma once\n#include \"" + interface.name + "_interface.hpp\"\n" +
                                           class_text(interface.space, interface.class_name, base,
                                                      "  using " + base + "::" + base + ";\n"));
  }
  for (const Driver& driver : model.drivers) {
    // Its class may be abstract here, for what it implements is made up. FlexRF's own are compiled by its
    // build.
    sources += make(model, {Target::Kind::driver, driver.file}, mine,
                    is_own(tree_, driver.file) ? ".cpp" : "_construct.cpp");
    make_file(mine / driver.header, "#pragma once\n#include \"" + driver.base_header + "\"\n" +
                                        class_text(driver.space, driver.class_name, driver.base_class, ""));
  }
  for (const UnitType& unit : model.unit_types) {
    sources += make(model, {Target::Kind::unit, unit.file}, mine);
    make_file(mine / unit.header, "#pragma once\n#include \"" + unit.base_header + "\"\n" +
                                      class_text(unit.space, unit.class_name, unit.base_class,
                                                 "  flexrf::Status initialise() override { return {}; }\n"
                                                 "  void step(const flexrf::Tick&) override {}\n"));
  }
  sources += make(model, {Target::Kind::application, cell.table}, mine);
  return sources;
}

// The files of a target; as lines that include its sources.
std::string GeneratedCompiler::make(const Model& model, const Target& target, const fs::path& folder,
                                    const std::string& but) const {
  Diagnostics diagnostics;
  std::string sources;
  for (const GeneratedFile& file : emit(model, target, diagnostics)) {
    make_file(folder / file.path, file.contents);
    const std::string name = file.path.generic_string();
    if (name.ends_with(".cpp") && !name.ends_with(but)) sources += "#include \"" + name + "\"\n";
  }
  return sources;
}

void GeneratedCompiler::make_types(const fs::path& types) const {
  if (!fs::exists(types)) return;
  SearchPaths paths = tree_.cells().front().paths;
  Diagnostics diagnostics;
  const Target target{Target::Kind::types, types};
  make(read(target, paths, diagnostics), target, folder_ / "library");
}

bool GeneratedCompiler::run(const std::string& arguments) const {
  const fs::path repository = places_.repository;
  const std::string command = shell_word(places_.compiler) + " -std=c++20 -Wall -Wno-subobject-linkage -I" +
                              shell_word(folder_ / "library") + " -I" + shell_word(repository) + " -I" +
                              shell_word(repository / "hal") + " -isystem " + shell_word(places_.eigen) +
                              " " + arguments + " > " + shell_word(folder_ / "messages.txt") + " 2>&1";
  return std::system(command.c_str()) == 0;
}

}  // namespace flexrf::config_gen::tests
