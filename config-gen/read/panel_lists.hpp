// Rows [widget.N] of the kinds `population` and `timeline`: what they name is looked for in the slot's type,
// in populations and units.
#pragma once

#include "config-gen/read/assembly.hpp"
#include "config-gen/read/row.hpp"

namespace flexrf::config_gen {

// After everything else of the row was read.
void check_population_row(Assembly& assembly, Row& row, const PanelWidget& widget);
void check_timeline_row(Assembly& assembly, Row& row);

}  // namespace flexrf::config_gen
