// LinuxGpioChip: a chip of the machine, through the kernel's GPIO interface (libgpiod).
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "hal/driver/helper_thread.hpp"
#include "hal/gpio/chip/linux/linux_gpio_line.hpp"
#include "linux_gpio_chip_driver.hpp"

namespace flexrf {

/// A chip that goes away takes its lines with it; a thread of its own, the keeper, asks for them again until
/// the chip is back.
class LinuxGpioChip final : public LinuxGpioChipDriver {
 public:
  ~LinuxGpioChip() override;

  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;

  Result<GpioLine*> request(const GpioLineSettings& settings) override;
  void release(GpioLine* line) noexcept override;

 private:
  void keep();
  void look_after_lines();

  GpioLineCounters counters_;
  std::string chip_;
  std::mutex mutex_;  // of what follows; never taken in a cycle
  std::vector<std::unique_ptr<LinuxGpioLine>> lines_;
  Status trouble_;  // why a line that was lost cannot be had, as last told
  HelperThread keeper_;
};

}  // namespace flexrf
