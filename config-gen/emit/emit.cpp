#include "config-gen/emit/emit.hpp"

#include <algorithm>

#include "config-gen/emit/component.hpp"
#include "config-gen/emit/text.hpp"
#include "config-gen/model/target.hpp"

namespace flexrf::config_gen {
namespace {

using Files = std::vector<GeneratedFile>;

// A row whose table is the one that was asked for, however its path is written.
bool is_at(const std::filesystem::path& file, const std::filesystem::path& wanted) {
  return file.lexically_normal() == wanted.lexically_normal();
}

template <class Rows>
const auto* at(const Rows& rows, const std::filesystem::path& file) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return is_at(row.file, file); });
  return found == rows.end() ? nullptr : &*found;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  const std::filesystem::path normal = path.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

void emit_types(const Model& model, const std::filesystem::path& folder, Files& files) {
  for (const Type& type : model.types) {
    if (!is_at(type.file.parent_path(), folder_of(folder))) continue;
    files.push_back({"types/" + type.stem + ".hpp", type_header_text(model, type)});
    files.push_back({"types/" + type.stem + ".cpp", type_source_text(model, type)});
  }
}

void emit_unit(const Model& model, const UnitType& unit, Files& files) {
  files.push_back({unit.base_header, unit_base_header(model, unit)});
  files.push_back({unit.name + "_unit.cpp", unit_base_source(model, unit)});
  files.push_back({unit.name + "_construct.cpp", unit_construct_source(unit)});
  files.push_back({"reference.md", unit_reference(model, unit)});
}

void emit_interface(const Model& model, const Interface& interface, Files& files) {
  files.push_back({interface.name + "_interface.hpp", interface_base_header(model, interface)});
  files.push_back({interface.name + "_interface.cpp", interface_base_source(model, interface)});
  files.push_back({"reference.md", interface_reference(model, interface)});
}

void emit_driver(const Model& model, const Driver& driver, Files& files) {
  files.push_back({driver.base_header, driver_base_header(model, driver)});
  files.push_back({driver.stem + "_driver.cpp", driver_base_source(model, driver)});
  files.push_back({driver.stem + "_construct.cpp", driver_construct_source(model, driver)});
  files.push_back({"reference.md", driver_reference(model, driver)});
}

void emit_application(const Model& model, Diagnostics& diagnostics, Files& files) {
  files.push_back({"application.cpp", application_source(model, diagnostics)});
  files.push_back({"descriptor.cpp", descriptor_source(model)});
  files.push_back({"panel.cpp", panel_source(model)});
  files.push_back({"main.cpp", main_source(model)});
  files.push_back({"descriptor.json", descriptor_text(model).json});
  files.push_back({"reference.md", application_reference(model)});
  files.push_back({"diagram.dot", diagram_dot(model)});
  files.push_back({"diagram.mmd", diagram_mermaid(model)});
  files.push_back({"memory_map.txt", memory_map_text(model)});
}

}  // namespace

std::string main_source(const Model& model) {
  return generated_note(model.application->file) +
         "#include \"runtime/run/run_application.hpp\"\n"
         "#ifdef FLEXRF_WITH_PANEL\n"
         "#include \"web-ui/server/panel.hpp\"\n"
         "#endif\n\n"
         "namespace flexrf::application {\n"
         "extern const Application application;\n"
         "}  // namespace flexrf::application\n\n"
         "int main(int argument_count, char** arguments) {\n"
         "#ifdef FLEXRF_WITH_PANEL\n"
         "  if (const auto code = flexrf::panel::run_helper(argument_count, arguments)) return *code;\n"
         "  constexpr const flexrf::ObserverPart* observer = &flexrf::panel::observer;\n"
         "#else\n"
         "  constexpr const flexrf::ObserverPart* observer = nullptr;\n"
         "#endif\n"
         "  return flexrf::run_application(flexrf::application::application, argument_count, arguments, "
         "observer);\n"
         "}\n";
}

std::vector<GeneratedFile> emit(const Model& model, const Target& target, Diagnostics& diagnostics) {
  Files files;
  switch (target.kind) {
    case Target::Kind::types:
      emit_types(model, target.file, files);
      break;
    case Target::Kind::unit:
      if (const UnitType* unit = at(model.unit_types, target.file)) emit_unit(model, *unit, files);
      break;
    case Target::Kind::interface:
      if (const Interface* interface = at(model.interfaces, target.file))
        emit_interface(model, *interface, files);
      break;
    case Target::Kind::driver:
      if (const Driver* driver = at(model.drivers, target.file)) emit_driver(model, *driver, files);
      break;
    case Target::Kind::application:
      if (model.application) emit_application(model, diagnostics, files);
      break;
  }
  return files;
}

}  // namespace flexrf::config_gen
