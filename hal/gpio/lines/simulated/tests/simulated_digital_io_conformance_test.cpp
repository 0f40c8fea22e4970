#include "hal/gpio/chip/simulated/simulated_gpio_chip.hpp"
#include "hal/gpio/lines/conformance/virtual_world.hpp"
#include "hal/gpio/lines/simulated/simulated_digital_io.hpp"

int main() {
  using namespace flexrf;
  return run_digital_io_conformance("simulated digital io", []() -> std::unique_ptr<DigitalIoWorld> {
    return std::make_unique<VirtualDigitalIoWorld<SimulatedGpioChip, SimulatedDigitalIo>>();
  });
}
