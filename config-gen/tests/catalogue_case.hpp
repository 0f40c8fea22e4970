// A case of the catalogue: one file that holds what differs from a good cell, and what config-gen says of it.
//
//   base: station                    the good cell, a folder of catalogue/base; without this line the
//                                    case writes all files itself
//   --- change cell.toml             tables and keys, as they differ from the base's file:
//   [device.station]
//   drivers = ["mock"]               a key with another value, or one more
//   - register_map                   a key that is left out
//   - [thread.main]                  a table that is left out
//   [thread.slow]                    one that the base does not have comes at the end
//   trigger = { period = "1 s" }
//
//   --- write types/a.toml           a whole file, new or instead of the base's
//   --- write a.csv in UTF-16        so encoded, with its mark, or in UTF-16BE, without one
//   --- append a.csv for n = 0..9    lines at the end of a file. `for` repeats a section, of any kind, with
//   row <n>, before <n+1>            the number for <n>, and the next for <n+1>
//
//   --- remove six-axis.urdf
//
//   --- messages                     all that config-gen says, with places as in the whole cell
//
// Empty lines at a section's end do not count. \xDF is that byte: the cases are good UTF-8 themselves, with
// plain ends of lines, whatever their cells are. What changes nothing, or has nothing to change, is an error.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace flexrf::config_gen::tests {

using Files = std::map<std::string, std::string>;  // contents by path, from the cell's folder

struct Case {
  Files files;  // of the whole cell
  std::string messages;
};

/// Throws std::runtime_error with the file and the reason when the case is not as above.
Case read_case(const std::filesystem::path& file);

/// With those messages instead.
void rewrite_messages(const std::filesystem::path& file, const std::string& messages);

/// What lies in a folder, as a base does.
Files files_in(const std::filesystem::path& folder);

/// The cases of a catalogue, by name.
std::vector<std::filesystem::path> case_files(const std::filesystem::path& catalogue);

void write_cell(const Files& files, const std::filesystem::path& folder);

}  // namespace flexrf::config_gen::tests
