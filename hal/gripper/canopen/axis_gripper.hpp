// A Gripper that is an axis of CiA 402: what its drivers, real and simulated, have in common.
#pragma once

#include "hal/gripper/canopen/gripper_axis.hpp"
#include "hal/gripper/interface/gripper.hpp"

namespace flexrf {

/// `Base`: the driver's generated base, of a Gripper on a CanBus. Its initialise() makes the plans and gives
/// them to open().
template <class Base>
class AxisGripper : public Base {
 public:
  void stop() override { control_.close(); }

  GripperCapabilities capabilities() const noexcept override {
    return {.open_width = this->configuration.open_width,
            .closed_width = this->configuration.closed_width,
            .positions = true,
            .measures_opening = true,
            .speed = tells_speed_,
            .force = limits_force_,
            .detects_object = true,
            .halts = true,
            .fastest = fastest_,
            .weakest = weakest_,
            .strongest = strongest_};
  }
  std::optional<GripperState> state() const noexcept override { return control_.state(); }
  const Status& trouble() const noexcept override { return control_.trouble(); }

  void halt() noexcept override { control_.halt(); }

 protected:
  /// What the interface's configuration says.
  canopen::GripperAxisPlan plan_from_interface() const noexcept {
    const auto& from = this->configuration;
    canopen::GripperAxisPlan plan;
    plan.open_width = from.open_width;
    plan.closed_width = from.closed_width;
    plan.speed = from.speed;
    plan.force = from.force;
    plan.travel_timeout = canopen::whole_milliseconds(from.travel_timeout);
    plan.activation_timeout = canopen::whole_milliseconds(from.activation_timeout);
    return plan;
  }
  Status open(const canopen::GripperAxisPlan& plan, const canopen::cia402::AxisPlan& axis) {
    this->begin(this->configuration);
    limits_force_ = axis.limits_torque;
    tells_speed_ = axis.tells_speed;
    fastest_ = axis.fastest;
    weakest_ = plan.weakest;
    strongest_ = plan.strongest;
    return control_.open(plan, axis, *this->bus, this->name());
  }

 private:
  void hear(const Tick& tick) noexcept override {
    control_.receive(tick);
    control_.tell_oddities(this->name());
  }
  void begin_activation() noexcept override { control_.activate(); }
  void go(const GripperGoal& goal) noexcept override { control_.command(goal); }
  bool is_ready() const noexcept override { return control_.is_active(); }
  bool is_at_rest() const noexcept override { return control_.is_at_rest(); }
  void tell(const Tick& tick, bool /*safe*/) noexcept override { control_.send(tick); }

  canopen::GripperAxis control_;
  bool limits_force_ = false;
  bool tells_speed_ = true;
  double fastest_ = 0;  // m/s
  double weakest_ = 0;  // N
  double strongest_ = 0;
};

}  // namespace flexrf
