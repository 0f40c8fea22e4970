// SimulatedGpioChip: a chip with contacts that bounce and with wires from its outputs to its inputs.
#pragma once

#include <array>
#include <cstddef>

#include "hal/gpio/chip/interface/virtual_chip.hpp"
#include "simulated_gpio_chip_driver.hpp"

namespace flexrf {

class SimulatedGpioChip final : public SimulatedGpioChipDriver {
 public:
  Status initialise() override;
  void receive(const Tick& tick) noexcept override;
  Result<GpioLine*> request(const GpioLineSettings& settings) override;
  void release(GpioLine* line) noexcept override { chip_.release(line); }

  /// A person at a contact, a cylinder at its reed switch: drives inputs, sees outputs. Any thread.
  VirtualLine& line(std::string_view line_name) { return *chip_.line(line_name); }
  /// Any thread.
  void unplug() noexcept { chip_.set_present(false); }
  void plug_in() noexcept { chip_.set_present(true); }

 private:
  VirtualChip chip_;
  std::array<VirtualLine*, VirtualChip::capacity> blocked_{};
  std::size_t blocked_count_ = 0;  // since it was initialised
};

}  // namespace flexrf
