// RobotiqDriver: a driver of Gripper over a generated base, on a Modbus link. What differs between drivers is
// the link they are on.
#pragma once

#include "hal/gripper/interface/gripper_report.hpp"
#include "hal/gripper/robotiq/robotiq_control.hpp"
#include "hal/modbus/station/interface/linked_station.hpp"
#include "types/gripper_safe_state.hpp"

namespace flexrf::robotiq {

/// The gripper's end of its exchange with the link. The thread the gripper lives in, but for attach() and
/// detach(): the lifecycle thread.
class RobotiqEnd {
 public:
  Status attach(ModbusLink& link, const char* name, std::uint8_t unit_id, Duration max_age);
  void detach() noexcept { end_.detach(); }

  void receive(Control& control, Time now) noexcept;
  void send(Control& control, bool safe) noexcept;

 private:
  StationEnd end_;
  StationOutputs outputs_;
};

/// Error: the configuration makes no sense.
Status check(const ControlPlan& plan) noexcept;

template <class Base>
class RobotiqDriver : public Base {
 public:
  Status initialise() override {
    const auto& set = this->configuration;
    ControlPlan plan;
    plan.open_width = set.open_width;
    plan.closed_width = set.closed_width;
    plan.open_count = set.open_count;
    plan.closed_count = set.closed_count;
    plan.slowest = set.slowest;
    plan.fastest = set.fastest;
    plan.weakest = set.weakest;
    plan.strongest = set.strongest;
    plan.speed = set.speed;
    plan.force = set.force;
    plan.travel_timeout = duration_of(set.travel_timeout);
    plan.activation_timeout = duration_of(set.activation_timeout);
    if (const Status status = check(plan); !status) return status;
    control_.begin(plan);
    report_.reset();
    releasing_ = false;
    return end_.attach(*this->bus, this->name(), set.unit_id, duration_of(set.max_age));
  }
  void stop() override { end_.detach(); }

  void receive(const Tick& tick) noexcept override {
    end_.receive(control_, tick.now);
    report_.fill(this->name(), this->feedback, control_.state(), control_.trouble());
  }

  void send(const Tick& /*tick*/) noexcept override {
    const bool safe = this->is_inhibited() || !this->fault().is_ok();
    if (!safe) releasing_ = false;
    if (safe && !releasing_) control_.halt();
    end_.send(control_, safe);
  }

  bool make_safe() noexcept override {
    if (this->configuration.safe_state == GripperSafeState::hold || !(releasing_ || control_.is_active())) {
      control_.halt();
    } else if (!releasing_) {
      control_.command({.opening = this->configuration.open_width});
      releasing_ = true;
    }
    end_.send(control_, true);
    return control_.is_at_rest();
  }

  GripperCapabilities capabilities() const noexcept override {
    return {.open_width = this->configuration.open_width,
            .closed_width = this->configuration.closed_width,
            .positions = true,
            .measures_opening = true,
            .speed = true,
            .force = true,
            .detects_object = true,
            .halts = true,
            .slowest = this->configuration.slowest,
            .fastest = this->configuration.fastest,
            .weakest = this->configuration.weakest,
            .strongest = this->configuration.strongest};
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

 private:
  Control control_;
  RobotiqEnd end_;
  GripperReport report_;
  bool releasing_ = false;  // on account of make_safe(), until it may move again
};

}  // namespace flexrf::robotiq
