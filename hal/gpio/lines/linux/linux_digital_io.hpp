// LinuxDigitalIo: a line of a chip of the machine, through the kernel's GPIO interface.
#pragma once

#include "hal/gpio/lines/interface/line_driver.hpp"
#include "linux_digital_io_driver.hpp"

namespace flexrf {

class LinuxDigitalIo final : public LineDriver<LinuxDigitalIoDriver> {};

}  // namespace flexrf
