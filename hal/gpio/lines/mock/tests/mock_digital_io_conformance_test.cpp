#include "hal/gpio/chip/mock/mock_gpio_chip.hpp"
#include "hal/gpio/lines/conformance/virtual_world.hpp"
#include "hal/gpio/lines/mock/mock_digital_io.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public VirtualDigitalIoWorld<MockGpioChip, MockDigitalIo> {
 public:
  bool forbid() override {
    chip().refuse(Status::error(StatusCode::not_permitted, "scripted: this user may not open the chip"));
    return true;
  }
  void permit() override { chip().refuse({}); }
};

}  // namespace

int main() {
  return run_digital_io_conformance(
      "mock digital io", []() -> std::unique_ptr<DigitalIoWorld> { return std::make_unique<MockWorld>(); });
}
