// The configuration file: XML that holds those values of configuration parameters and persistent runtime
// parameters that somebody has set, and nothing else: all others follow the application's tables.
//
//   <flexrf application="keyboard" format="1" descriptor="0123456789abcdef" checksum="...">
//     <unit name="jog">
//       <runtime>
//         <step unit="m">0.02</step>
//       </runtime>
//     </unit>
//     <device name="arm" driver="simulated"> <configuration> ...
//
// Made for an engineer to edit: then checksum="edited" (or no checksum) says so. An array's elements are
// separated by blanks, a matrix's rows by ";"; a structure's members are elements of their own, with
// index="0" ... when there are several.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "runtime/core/parameter_descriptor.hpp"
#include "runtime/parameters/rename.hpp"
#include "runtime/parameters/set_marks.hpp"

namespace flexrf {

/// One component's values: what loading writes and saving reads.
struct ConfigurationComponent {
  const char* kind = "unit";  ///< or "device": its element in the file
  const char* name = "";
  const char* driver = "";  ///< the chosen one; "": it has none, as a unit
  /// The others that its table permits. Their sections are neither read nor lost.
  std::span<const char* const> other_drivers;
  const ComponentType* type = nullptr;
  void* configuration = nullptr;  ///< null where it has none
  void* runtime = nullptr;
  /// What of these somebody has set: loading marks what the file gives, saving writes what is marked. Null:
  /// nothing is, and nobody asks. Of the size of the struct.
  SetMarks* configuration_marks = nullptr;
  SetMarks* runtime_marks = nullptr;
};

struct ConfigurationIdentity {
  const char* application = "";
  std::uint64_t descriptor_hash = 0;
  std::span<const Rename> renames;
};

enum class ConfigurationSource : std::uint8_t {
  tables,    ///< there is no file, nor a previous copy: nothing was changed
  file,      ///< the file's values were taken
  previous,  ///< the file is damaged (see problems) or gone; those of FILE.previous were taken
  refused,   ///< nothing was taken and the application should not start (see problems)
};

struct ConfigurationReport {
  ConfigurationSource source = ConfigurationSource::tables;
  std::vector<std::string> problems;  ///< "FILE:line:column: error: ..." each, all at once
  std::vector<std::string> notices;   ///< what a person should know, and what was left out
};

/// Reads the file into the components' values: all of it, or nothing, in a time that grows with its size. The
/// first 50 problems and the first 50 notices are spelled out, the rest is counted. Damage (syntax, checksum,
/// truncation) or loss falls back to FILE.previous; a wrong name or value refuses the file. A file written
/// for another descriptor is taken as far as it fits, under the names that `renames` give; the rest is
/// noticed. Not real-time.
ConfigurationReport load_configuration(const std::string& path, const ConfigurationIdentity& identity,
                                       std::span<const ConfigurationComponent> components);

/// Writes the file atomically. The former one becomes FILE.previous, or FILE.damaged when it is no good, so
/// that neither a good copy nor somebody's edits are lost. Writes nothing when nothing changed, nor a file
/// that would hold nothing where there is none. Not real-time.
Status save_configuration(const std::string& path, const ConfigurationIdentity& identity,
                          std::span<const ConfigurationComponent> components);

}  // namespace flexrf
