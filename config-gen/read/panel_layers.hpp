// [widget.NAME.overlay.NAME], [widget.NAME.bodies.NAME] and [widget.NAME.frame.NAME].
#pragma once

#include "config-gen/read/assembly.hpp"
#include "config-gen/read/row.hpp"

namespace flexrf::config_gen {

// Of the widget's row, whose kind and device are read.
void read_layers(Assembly& assembly, Row& row, PanelWidget& widget);

}  // namespace flexrf::config_gen
