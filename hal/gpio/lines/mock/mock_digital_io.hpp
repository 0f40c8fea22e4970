// MockDigitalIo: a line of a chip that a test drives.
#pragma once

#include "hal/gpio/lines/interface/line_driver.hpp"
#include "mock_digital_io_driver.hpp"

namespace flexrf {

class MockDigitalIo final : public LineDriver<MockDigitalIoDriver> {};

}  // namespace flexrf
