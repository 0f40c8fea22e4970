// What the helper asks of the system that it runs on.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flexrf::helper {

/// Runs the program and waits for its end. Empty: it ended with 0; else why not, in one line. Any thread.
std::string run_program(const std::string& program, const std::vector<std::string>& arguments);
/// For whom has no privileges; 0 also when it cannot be told. Any thread.
std::uint64_t free_bytes(const std::string& folder);
/// None: there is no such user. One thread.
std::optional<uid_t> id_of_user(const std::string& name);

}  // namespace flexrf::helper
