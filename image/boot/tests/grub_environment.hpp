// GRUB's environment blocks as its manual and its own code have them: written without a look at ours, to
// judge ours by.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace flexrf::boot {

/// What `load_env` finds; nothing where it refuses the file.
std::optional<std::map<std::string, std::string>> grub_variables(const std::string& block);

/// What `save_env` does with one variable. False where it refuses, for lack of room or of an end to the text.
bool grub_set(std::string& block, const std::string& name, const std::string& value);

}  // namespace flexrf::boot
