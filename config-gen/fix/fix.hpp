// `--fix`: puts known names in the place of misspelt ones, where a message says which and there is no doubt.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <vector>

#include "config-gen/model/diagnostics.hpp"

namespace flexrf::config_gen {

struct FixSettings {
  std::vector<std::filesystem::path> folders;  // tables and lists below these may be changed, no other file
  bool dry_run = false;                        // show, and write nothing
};

struct Examined {
  Diagnostics diagnostics;
  std::vector<std::filesystem::path> files;  // all that was read
};

// Reads and judges the tables; called again after each round of changes, and throws what main() tells.
using Examine = std::function<Examined()>;

// Replaces words one by one, each an error's own (Replacement without a doubt), and judges again until
// nothing more can be replaced. A change that leads to another error of its word is taken back; a word that
// more places have than have the declared name that was meant stays, as the declaration may be wrong. All
// else in a file stays byte for byte; each file is replaced as a whole. Written to `out`: each change as
// "file:line:column: 'found' -> 'wanted'", with the place that it has in the file as it was; what could not
// be written; then all that is still to be said, and what was left alone and why. True: no error is left in
// the files.
bool fix(const FixSettings& settings, const Examine& examine, std::ostream& out);

}  // namespace flexrf::config_gen
