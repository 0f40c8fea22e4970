// panel.cpp: what the tables say to the panel, and the files that the application carries for it.
#include <algorithm>

#include "config-gen/emit/application_parts.hpp"
#include "config-gen/emit/emit.hpp"
#include "config-gen/emit/plain_struct.hpp"
#include "config-gen/model/file_contents.hpp"

namespace flexrf::config_gen {
namespace {

// Lines of a text, pieces of what has none: a compiler's limit on the length of a line is no limit here.
void emit_bytes(std::string_view bytes, Text& out) {
  constexpr std::size_t most = 120;
  while (!bytes.empty()) {
    const std::string_view piece = bytes.substr(0, std::min(bytes.substr(0, most).find('\n'), most - 1) + 1);
    out << "    " << string_literal(piece) << "\n";
    bytes.remove_prefix(piece.size());
  }
}

}  // namespace

std::string panel_source(const Model& model) {
  const Panel& panel = model.panel;
  Text out, files;
  out << generated_note(model.application->file) << include_lines({}, {"runtime/executive/panel_record.hpp"})
      << "\nnamespace flexrf::application {\nnamespace {\n";
  for (std::size_t i = 0; i < panel.files.size(); ++i) {
    const PanelFile& file = panel.files[i];
    const std::string name = "file_" + std::to_string(i);
    out << "\n// " << comment_text(short_path(file.file)) << "\nconstexpr char " << name
        << "[] =\n    \"\"\n";
    emit_bytes(contents_of(file.file), out);
    out << "    ;\n";
    files << "    {" << string_literal(file.path) << ", " << string_literal(file.content_type) << ", {"
          << name << ", sizeof(" << name << ") - 1}},\n";
  }
  if (!panel.files.empty()) out << "\nconstexpr PanelFile files[] = {\n" << files.str() << "};\n";
  emit_array("constexpr const char*", "local",
             list_of(panel.local, [](const std::string& address) { return string_literal(address); }), out);
  out << "\n}  // namespace\n\nextern const PanelRecord panel_record;\nconstinit const PanelRecord "
         "panel_record{\n"
      << "    .connections = " << panel.connections
      << ",\n    .local = " << (panel.local.empty() ? "{}" : "local")
      << ",\n    .loopback_is_local = " << bool_literal(panel.loopback_is_local)
      << ",\n    .session_timeout = " << duration_literal(panel.session_timeout)
      << ",\n    .session_length = " << duration_literal(panel.session_length)
      << ",\n    .files = " << (panel.files.empty() ? "{}" : "files") << ",\n};\n"
      << "\n}  // namespace flexrf::application\n";
  return out.take();
}

// What is enforced at run time: the panel is not asked.
void emit_ranges(const Model& model, Text& out) {
  std::string list;
  const auto bound = [](const Literal& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value.value))
      return double_literal(static_cast<double>(*integer));
    const auto* real = std::get_if<double>(&value.value);
    return double_literal(real == nullptr ? 0.0 : *real);
  };
  const auto add = [&](std::size_t component, const std::vector<ParameterOverride>& changes) {
    for (const ParameterOverride& change : changes) {
      if (!change.low || !change.high) continue;
      const char* kind = change.kind == Parameter::Kind::configuration ? "configuration" : "runtime";
      list += "\n    {" + std::to_string(component) + ", ParameterKind::" + kind + ", \"" + change.parameter +
              "\", " + bound(*change.low) + ", " + bound(*change.high) + "},";
    }
  };
  for (std::size_t i = 0; i < model.units.size(); ++i) add(i, model.units[i].overrides);
  for (std::size_t i = 0; i < model.devices.size(); ++i)
    add(model.units.size() + i, model.devices[i].overrides);
  if (!list.empty()) out << "constexpr NarrowedRange ranges_table[] = {" << list << "\n};\n";
}

}  // namespace flexrf::config_gen
