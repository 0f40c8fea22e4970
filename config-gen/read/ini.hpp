// Files of sections and keys, as vendors' EDS files are: "[section]", "key=value", lines that begin with ';'
// are comments. Vendors write them in many ways: what can be understood is read, what cannot is told.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config-gen/model/diagnostics.hpp"

namespace flexrf::config_gen {

struct IniEntry {
  std::string key;
  std::string value;  // without blanks around it
  Position key_position;
  Position position;
};

struct IniSection {
  std::string name;
  Position position;
  std::vector<IniEntry> entries;

  // Whether in capitals or not; the first of several. Null when there is none.
  const IniEntry* find(std::string_view key) const;
};

std::string in_small_letters(std::string_view text);

// Nothing when the file cannot be read or is no such file at all, which is reported. Lines that are neither
// section nor key are left out with a warning.
std::optional<std::vector<IniSection>> read_ini(const std::filesystem::path& file, Diagnostics& diagnostics);
std::optional<std::vector<IniSection>> parse_ini(std::string_view text, const std::filesystem::path& file,
                                                 Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
