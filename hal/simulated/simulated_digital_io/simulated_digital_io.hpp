// SimulatedDigitalIo: a line of a simulated chip.
#pragma once

#include "hal/interfaces/digital_io/line_driver.hpp"
#include "simulated_digital_io_driver.hpp"

namespace flexrf {

class SimulatedDigitalIo final : public LineDriver<SimulatedDigitalIoDriver> {};

}  // namespace flexrf
