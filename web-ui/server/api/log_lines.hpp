// The recent lines of the log as JSON.
#pragma once

#include <cstdint>

#include "base/json_writer.hpp"

namespace flexrf::panel {

/// Writes `[{"number", "text"}, ...]` of the lines after `after`.
/// @returns the number of the last line so far.
std::uint64_t write_log_lines(JsonWriter& json, std::uint64_t after);

/// Number of the last line so far.
std::uint64_t last_log_line() noexcept;

}  // namespace flexrf::panel
