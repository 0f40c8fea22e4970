// SimulatedDigitalIo: a line of a simulated chip.
#pragma once

#include "hal/gpio/lines/interface/line_driver.hpp"
#include "simulated_digital_io_driver.hpp"

namespace flexrf {

class SimulatedDigitalIo final : public LineDriver<SimulatedDigitalIoDriver> {};

}  // namespace flexrf
