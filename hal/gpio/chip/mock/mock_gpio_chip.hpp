// MockGpioChip: a chip whose lines a test drives.
#pragma once

#include "hal/gpio/chip/interface/virtual_chip.hpp"
#include "mock_gpio_chip_driver.hpp"

namespace flexrf {

class MockGpioChip final : public MockGpioChipDriver {
 public:
  void receive(const Tick& /*tick*/) noexcept override {
    const bool present = chip_.is_present();
    if (feedback.present && !present) feedback.losses += feedback.lines;
    feedback.present = present;
    feedback.lines = chip_.requested();
  }
  Result<GpioLine*> request(const GpioLineSettings& settings) override {
    if (!refusal_.is_ok()) return refusal_;
    return chip_.request(settings, name());
  }
  void release(GpioLine* line) noexcept override { chip_.release(line); }

  // ---- for tests

  /// Any line, to drive it or to see what it drives: any thread. To script its edges: before it runs.
  VirtualLine& line(std::string_view line_name) { return *chip_.line(line_name); }
  /// Any thread.
  void unplug() noexcept { chip_.set_present(false); }
  void plug_in() noexcept { chip_.set_present(true); }
  /// What each request() from now on fails with; ok: none does. Before initialise() of the lines.
  void refuse(const Status& cause) noexcept { refusal_ = cause; }

 private:
  VirtualChip chip_;
  Status refusal_;
};

}  // namespace flexrf
