// Units of measure, as people write them in tables: one list of them for all tables and lists.
#pragma once

#include <string>
#include <string_view>

namespace flexrf::config_gen {

// Which units are taken where.
enum class UnitUse {
  si,         // of floating-point numbers
  multiples,  // of integers, which often hold what a device counts: decimal multiples too, as "mm" and "ns"
  device,     // of a device's registers: beside those what devices are read in, as "bar", "degC" and "%"
};

// Empty when `unit` is a unit of measure, as "m/s^2", "N*m", "1"; else what to write instead. "rad|m" is of
// one or of the other, as the device's row says of each joint.
std::string judge_unit(std::string_view unit, UnitUse use);

// The unit with one symbol replaced wherever it stands: "axis/s^2" with "m" for "axis" is "m/s^2".
std::string replace_symbol(std::string_view unit, std::string_view symbol, std::string_view by);

// Whether a number of this name has a dimension: its last word is a physical quantity, as in
// "homing_velocity". A part or a multiple of one says so by its last word: "velocity_share",
// "velocity_factor".
bool names_quantity(std::string_view name);

// For a unit that does not measure the quantity at the end of the name: the units that do, as "\"m/s\",
// \"rad/s\" or \"px/s\"". Empty where the unit fits, and where the name ends in no quantity, or in the
// denominator of a ratio ("counts_per_force"). `unit`: one that judge_unit() takes.
std::string units_instead(std::string_view name, std::string_view unit);

}  // namespace flexrf::config_gen
