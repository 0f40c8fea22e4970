// PneumaticGripper: two valves and two reed switches on the lines of a GPIO chip.
#pragma once

#include "hal/gpio/lines/interface/digital_line.hpp"
#include "hal/gripper/interface/gripper_report.hpp"
#include "hal/gripper/pneumatic/pneumatic_control.hpp"
#include "pneumatic_gripper_driver.hpp"

namespace flexrf {

/// Owns its four lines: nobody else switches a valve, so that the two exclude each other.
class PneumaticGripper final : public PneumaticGripperDriver {
 public:
  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;
  void send(const Tick& tick) noexcept override;
  bool make_safe() noexcept override;
  Time next_event() const noexcept override;

  GripperCapabilities capabilities() const noexcept override;
  std::optional<GripperState> state() const noexcept override { return control_.state(); }
  const Status& trouble() const noexcept override { return control_.trouble(); }
  void activate() noexcept override;
  void command(const GripperGoal& goal) noexcept override;
  void halt() noexcept override { control_.halt(); }

 private:
  std::optional<pneumatic::Reeds> reeds() const noexcept;
  void switch_valves() noexcept;

  pneumatic::Control control_;
  DigitalLine valve_open_;
  DigitalLine valve_close_;
  DigitalLine reed_open_;
  DigitalLine reed_closed_;
  GripperReport report_;
  Time now_{};
  bool releasing_ = false;  // on account of make_safe(), until it may move again
};

}  // namespace flexrf
