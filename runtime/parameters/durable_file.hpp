// Files that are either the old or the new, whatever happens while they are written.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "base/status.hpp"

namespace flexrf {

/// "a file", "a folder", "a pipe", "a socket", "a device": what st_mode says.
const char* name_of_file_kind(mode_t mode) noexcept;
/// Of a path to a file; "." where it names none.
std::string folder_of(const std::string& path);
/// Where a symbolic link leads; the path itself while nothing is there.
std::string resolved_path(const std::string& path);

/// What the system says of a file (`error`: errno's value), and what to do about it: "No space left on
/// device; make room there". Any thread that is not real-time.
std::string cause_of(int error);

/// What read_file() reads at most.
inline constexpr std::size_t largest_read_file = std::size_t{16} << 20;

/// The whole file, which is a regular one. not_found when there is none; other codes say why it cannot be
/// read. At most largest_read_file. Blocks.
Result<std::string> read_file(const std::string& path);

/// Replaces the file: writes PATH.new, fsync, rename, fsync of the directory. On failure the old file is as
/// it was. A symbolic link stays and its target is replaced; permissions stay, those of a file that was not
/// there are `fresh_mode`. More than `largest` bytes are refused. Blocks.
Status replace_file(const std::string& path, std::string_view contents, mode_t fresh_mode = 0644,
                    std::size_t largest = largest_read_file);

/// Removes the file: unlink, fsync of the directory. No error if there is no such file. Blocks.
Status remove_file(const std::string& path);

}  // namespace flexrf
