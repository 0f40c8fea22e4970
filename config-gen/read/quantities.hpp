// Units of measure, as people write them in tables.
#pragma once

#include <string>
#include <string_view>

namespace flexrf::config_gen {

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
