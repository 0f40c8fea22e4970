#include "hal/interfaces/digital_io/conformance/virtual_world.hpp"
#include "hal/simulated/simulated_digital_io/simulated_digital_io.hpp"
#include "hal/simulated/simulated_gpio_chip/simulated_gpio_chip.hpp"

int main() {
  using namespace flexrf;
  return run_digital_io_conformance("simulated digital io", []() -> std::unique_ptr<DigitalIoWorld> {
    return std::make_unique<VirtualDigitalIoWorld<SimulatedGpioChip, SimulatedDigitalIo>>();
  });
}
