// A Gripper that is an axis of CiA 402: what its drivers, real and simulated, have in common.
#pragma once

#include "hal/gripper/canopen/gripper_axis.hpp"
#include "hal/gripper/interface/gripper_report.hpp"
#include "types/gripper_safe_state.hpp"

namespace flexrf {

/// `Base`: the driver's generated base, of a Gripper on a CanBus. Its initialise() makes the plans and gives
/// them to open().
template <class Base>
class AxisGripper : public Base {
 public:
  void stop() override { control_.close(); }

  void receive(const Tick& tick) noexcept override {
    control_.receive(tick);
    control_.tell_own_ramps(this->name());
    report_.fill(this->name(), this->feedback, control_.state(), control_.trouble());
  }

  void send(const Tick& tick) noexcept override {
    const bool safe = this->is_inhibited() || !this->fault().is_ok();
    if (!safe) releasing_ = false;
    if (safe && !releasing_) control_.halt();
    control_.send(tick);
  }

  bool make_safe() noexcept override {
    if (this->configuration.safe_state == GripperSafeState::hold || !(releasing_ || control_.is_active())) {
      control_.halt();
    } else if (!releasing_) {
      control_.command({.opening = this->configuration.open_width});
      releasing_ = true;
    }
    return control_.is_at_rest();
  }

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

  void activate() noexcept override {
    if (!this->is_inhibited()) control_.activate();
  }
  void command(const GripperGoal& goal) noexcept override {
    if (this->is_inhibited()) return;
    if (const Status status = check_goal(goal, capabilities()); !status) return this->fail(status);
    this->restrain(restraint_of(goal, capabilities()));
    control_.command({within_reach(goal.opening, capabilities()), goal.speed, goal.force});
  }
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
    report_.reset();
    releasing_ = false;
    limits_force_ = axis.limits_torque;
    tells_speed_ = axis.tells_speed;
    fastest_ = axis.fastest;
    weakest_ = plan.weakest;
    strongest_ = plan.strongest;
    return control_.open(plan, axis, *this->bus);
  }

 private:
  canopen::GripperAxis control_;
  GripperReport report_;
  bool releasing_ = false;  // on account of make_safe(), until it may move again
  bool limits_force_ = false;
  bool tells_speed_ = true;
  double fastest_ = 0;  // m/s
  double weakest_ = 0;  // N
  double strongest_ = 0;
};

}  // namespace flexrf
