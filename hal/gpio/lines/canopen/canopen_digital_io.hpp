// CanopenDigitalIo: a line of a CiA 401 module on a CAN bus.
#pragma once

#include "canopen_digital_io_driver.hpp"
#include "hal/gpio/lines/interface/line_driver.hpp"

namespace flexrf {

class CanopenDigitalIo final : public LineDriver<CanopenDigitalIoDriver> {};

}  // namespace flexrf
