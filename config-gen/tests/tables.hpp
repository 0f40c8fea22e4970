// Tables for tests: read and checked as config-gen does it, with the message as people see them.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>

#include "config-gen/model/target.hpp"

namespace flexrf::config_gen::tests {

struct Result {
  Model model;
  std::string messages;
  bool failed = false;
};

enum class Stage { check, emit };

// The application `folder`/cell.toml as far as to that stage, with the tables of base/ and those in the
// folder itself. Paths in messages are as given here, so tests run in the folder of the tests.
inline Diagnostics judge_cell(const std::filesystem::path& folder, Stage last, Model& model) {
  SearchPaths paths;
  paths.types = {"base/types"};
  paths.units = {"base/units"};
  paths.interfaces = {"base/hal/interfaces", folder / "hal/interfaces"};
  paths.drivers = {"base/hal/linux", "base/hal/simulated", folder / "hal/drivers"};
  const Target target{Target::Kind::application, folder / "cell.toml"};
  Diagnostics diagnostics;
  model = read(target, paths, diagnostics);
  check(model, diagnostics);
  if (last == Stage::emit && !diagnostics.failed()) emit(model, target, diagnostics);
  return diagnostics;
}

inline Result read_cell(const std::filesystem::path& folder, Stage last = Stage::check) {
  Result result;
  const Diagnostics diagnostics = judge_cell(folder, last, result.model);
  std::ostringstream text;
  diagnostics.print(text);
  result.messages = text.str();
  result.failed = diagnostics.failed();
  return result;
}

}  // namespace flexrf::config_gen::tests
