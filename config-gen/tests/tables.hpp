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

// The application `folder`/cell.toml, with the tables of base/ and those in the folder itself. Paths in
// messages are as given here, so tests run in the folder of the tests.
inline Result read_cell(const std::filesystem::path& folder) {
  SearchPaths paths;
  paths.types = {"base/types"};
  paths.units = {"base/units"};
  paths.interfaces = {"base/hal/interfaces", folder / "hal/interfaces"};
  paths.drivers = {"base/hal/linux", "base/hal/simulated", folder / "hal/drivers"};
  Diagnostics diagnostics;
  Result result;
  result.model = read({Target::Kind::application, folder / "cell.toml"}, paths, diagnostics);
  check(result.model, diagnostics);
  std::ostringstream text;
  diagnostics.print(text);
  result.messages = text.str();
  result.failed = diagnostics.failed();
  return result;
}

}  // namespace flexrf::config_gen::tests
