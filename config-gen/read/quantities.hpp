// Durations, sizes and units of measure, as people write them in tables.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace flexrf::config_gen {

// "7 ms", "300 us", "1.5 s", "250 ns" in nanoseconds; nothing when it is not one of these or has a part of
// one.
std::optional<std::int64_t> parse_duration(std::string_view text);

// "8 MiB", "64 KiB", "1 GiB", "512 B" in bytes; a fraction must come out whole.
std::optional<std::size_t> parse_size(std::string_view text);

// Empty when `unit` is a unit of measure in SI, as "m/s^2", "N*m", "1"; else what to write instead. Decimal
// multiples ("mm", "ns") are for integers only, which often hold what a device counts. "rad|m" is of one or
// of the other, as the device's row says of each joint.
std::string judge_unit(std::string_view unit, bool multiples);

// The unit with one symbol replaced wherever it stands: "axis/s^2" with "m" for "axis" is "m/s^2".
std::string replace_symbol(std::string_view unit, std::string_view symbol, std::string_view by);

// Whether a number of this name has a dimension: its last word is a physical quantity, as in
// "homing_velocity". A part or a multiple of one says so by its last word: "velocity_share",
// "velocity_factor".
bool names_quantity(std::string_view name);

}  // namespace flexrf::config_gen
