// What the emitter makes of a model, file by file. `emit` in config-gen/model/target.hpp puts them together.
#pragma once

#include <string>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

std::string type_header_text(const Model& model, const Type& type);
std::string type_source_text(const Model& model, const Type& type);

// The application's memory and tables (application.cpp). A thread whose readers cannot be placed is an error
// in `diagnostics`.
std::string application_source(const Model& model, Diagnostics& diagnostics);

// Everything that a panel, a recording or a configuration file needs to know, as JSON; carries its own hash.
struct DescriptorText {
  std::string json;
  std::uint64_t hash = 0;
};
DescriptorText descriptor_text(const Model& model);
std::string descriptor_source(const Model& model);  // descriptor.cpp, which embeds it

std::string panel_source(const Model& model);  // panel.cpp: settings and files for the panel
std::string main_source(const Model& model);   // main.cpp

std::string unit_reference(const Model& model, const UnitType& unit);  // Markdown
std::string interface_reference(const Model& model, const Interface& interface);
std::string driver_reference(const Model& model, const Driver& driver);
std::string application_reference(const Model& model);
std::string diagram_dot(const Model& model);      // for Graphviz
std::string diagram_mermaid(const Model& model);  // for Markdown
std::string memory_map_text(const Model& model);

}  // namespace flexrf::config_gen
