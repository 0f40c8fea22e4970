// Values in tables (defaults, ranges, `configuration.P = v`) against the field they are for.
#pragma once

#include <optional>
#include <string>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/model.hpp"
#include "config-gen/read/row.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

// The value as the field's type, shape and capacity demand; nothing when it is not, which is reported with
// `what`
// ("the default of 'step'"). One value where an array is asked for fills the whole array; a list of fewer
// records than an array of records holds leaves zeros for the others.
std::optional<Literal> read_literal(const Model& model, const Field& field, const Node& value,
                                    const std::string& what, Diagnostics& diagnostics);

// Zeroed memory as a literal of the field.
Literal zero_literal(const Model& model, const Field& field, const Position& position);

// As read_literal, and inside the parameter's range.
std::optional<Literal> read_parameter_value(const Model& model, const Parameter& parameter, const Node& value,
                                            const std::string& what, Diagnostics& diagnostics);

// Whether a range has numbers inside, and bounds that the runtime, which keeps them as f64, can compare any
// 64-bit value with. What is wrong is reported with `what` ("the range of 'step'").
bool check_range(const Literal& low, const Literal& high, const Position& position, const std::string& what,
                 Diagnostics& diagnostics);

// `step` of a row that says how the panel changes this parameter: a number above 0, in its unit.
std::optional<Literal> read_step(const Model& model, Row& row, const Parameter& parameter,
                                 Diagnostics& diagnostics);

double number_of(const Literal& literal);  // of a bool, an integer or a real
// Of two of one type: exact for 64-bit integers, too.
bool is_below(const Literal& one, const Literal& other);
std::string literal_text(const Literal& literal);
// "[0.001, 0.1] m"
std::string range_text(const Parameter& parameter);

}  // namespace flexrf::config_gen
