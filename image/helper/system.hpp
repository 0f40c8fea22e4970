// What the helper asks of the system that it runs on.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "base/time.hpp"

namespace flexrf::helper {

/// Runs the program and waits for its end. Empty: it ended with 0; else why not, in one line. Any thread.
std::string run_program(const std::string& program, const std::vector<std::string>& arguments);
/// Runs the program and returns what it writes to its standard output. timeout: it had not ended after
/// `wait`, and was killed; out_of_range: it wrote more than `most` bytes, and was killed; unavailable: it
/// cannot be run, or failed. Blocks. Any thread.
Result<std::string> output_of(const std::string& program, const std::vector<std::string>& arguments,
                              Duration wait, std::size_t most);
/// Free space of the file system that the folder is in, for root, bytes; 0 also if it cannot be told. Any
/// thread.
std::uint64_t free_bytes(const std::string& folder);
/// None: there is no such user. One thread.
std::optional<uid_t> id_of_user(const std::string& name);

}  // namespace flexrf::helper
