// What a table names of others and of the system, as it is written: for the build, which has to know what
// belongs to a target before anything is generated.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "config-gen/model/target.hpp"

namespace flexrf::config_gen {

// Letters, digits and _ . + - / : only.
bool is_build_word(std::string_view word);

// A line for each of these that the table has, "KEY WORD..." with such words only:
//   unit:        name, interfaces (classes of its devices)
//   interface:   name, class
//   driver:      name (as in drivers = [...]), class (of its interface), interfaces (that class, and its
//   bus'), ports (input,
//                output: that it has some), libraries (targets), packages (as pkg-config calls them)
//   application: units (types), drivers ("CLASS/NAME"), of all rows of the table and of the groups beside it.
//   A group's argument may
//                be each value that any instance gives it.
//                And a line "list FILE" for each list of devices, whatever letters its name has.
// Judges nothing, as a broken table is told by the run that makes something of it: what cannot be read is
// left out.
std::string list_parts(Target::Kind kind, const std::filesystem::path& table);

}  // namespace flexrf::config_gen
