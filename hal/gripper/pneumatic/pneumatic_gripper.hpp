// PneumaticGripper: two valves and two reed switches on the lines of a GPIO chip.
#pragma once

#include "hal/gpio/lines/interface/digital_line.hpp"
#include "hal/gripper/pneumatic/pneumatic_control.hpp"
#include "pneumatic_gripper_driver.hpp"

namespace flexrf {

/// Owns its four lines: nobody else switches a valve, so that the two exclude each other.
class PneumaticGripper final : public PneumaticGripperDriver {
 public:
  Status initialise() override;
  void stop() override;
  Time next_event() const noexcept override;

  GripperCapabilities capabilities() const noexcept override;
  std::optional<GripperState> state() const noexcept override { return control_.state(); }
  const Status& trouble() const noexcept override { return control_.trouble(); }
  void halt() noexcept override { control_.halt(); }

 private:
  void hear(const Tick& tick) noexcept override;
  void begin_activation() noexcept override { control_.forgive(); }
  void go(const GripperGoal& goal) noexcept override;
  bool is_ready() const noexcept override { return control_.follows(); }
  bool is_at_rest() const noexcept override;
  void tell(const Tick& tick, bool safe) noexcept override;

  std::optional<pneumatic::Reeds> reeds() const noexcept;

  pneumatic::Control control_;
  DigitalLine valve_open_;
  DigitalLine valve_close_;
  DigitalLine reed_open_;
  DigitalLine reed_closed_;
};

}  // namespace flexrf
