// A file gets other contents as a whole or not at all, whatever ends the process meanwhile.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace flexrf::config_gen {

// Why the file, or what a link of this name leads to, cannot be replaced: "it is read-only". Empty: it can
// be.
std::string obstacle_to_replacing(const std::filesystem::path& file);

// A link is followed and stays. Mode and owner stay. Nothing is changed, and the reason returned, where the
// file is no longer `expected` or cannot be written; empty: done, and on the disk.
std::string replace_file(const std::filesystem::path& file, std::string_view expected,
                         std::string_view contents);

}  // namespace flexrf::config_gen
