// What one run of config-gen is asked to make, and the stages that make it: read, check, emit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

// The build runs config-gen once per folder of types, unit, interface, driver and application.
struct Target {
  enum class Kind { types, unit, interface, driver, application };
  Kind kind = Kind::application;
  std::filesystem::path file;  // the table; for types the folder
};

struct SearchPaths {  // folders; unit tables are DIR/NAME/NAME.toml, all others as in docs/tables.md
  std::vector<std::filesystem::path> types;
  std::vector<std::filesystem::path> units;
  std::vector<std::filesystem::path> interfaces;
  std::vector<std::filesystem::path> drivers;
  std::vector<std::filesystem::path>
      library;  // where FlexRF's own tables lie: what is made of them is in flexrf
};

struct GeneratedFile {
  std::filesystem::path path;  // relative to the output folder
  std::string contents;
};

// Reads every table that the target needs and resolves it into a Model (config-gen/read).
Model read(const Target& target, const SearchPaths& paths, Diagnostics& diagnostics);

// Judges the whole (config-gen/check); completes what is computed by judging, as the response times.
void check(Model& model, Diagnostics& diagnostics);

// Makes all files of the target (config-gen/emit), in a fixed order. Is called only without errors so far and
// may add some (of how threads read). main() writes those whose contents changed, and the depfile; with
// --check-only nothing.
//   types: every Type whose `file` lies in target.file; unit, interface, driver: the one whose `file` is
//   target.file.
std::vector<GeneratedFile> emit(const Model& model, const Target& target, Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
