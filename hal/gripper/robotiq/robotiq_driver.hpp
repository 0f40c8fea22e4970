// RobotiqDriver: a driver of Gripper over a generated base, on a Modbus link. What differs between drivers is
// the link they are on.
#pragma once

#include "hal/gripper/interface/gripper.hpp"
#include "hal/gripper/robotiq/robotiq_control.hpp"
#include "hal/modbus/station/interface/linked_station.hpp"

namespace flexrf::robotiq {

/// The gripper's end of its exchange with the link. The thread the gripper lives in, but for attach() and
/// detach(): the lifecycle thread.
class RobotiqEnd {
 public:
  Status attach(ModbusLink& link, const char* name, std::uint8_t unit_id, Duration max_age);
  void detach() noexcept { end_.detach(); }

  /// What it said, as it came; nothing while it is not heard.
  std::optional<Words> receive(Control& control, Time now) noexcept;
  void send(Control& control, bool safe) noexcept;

 private:
  StationEnd end_;
  StationOutputs outputs_;
};

/// Error: the configuration makes no sense.
Status check(const ControlPlan& plan) noexcept;

/// `Base`: of a driver whose table has the feedback that report() fills.
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
    this->begin(set);
    return end_.attach(*this->bus, this->name(), set.unit_id, duration_of(set.max_age));
  }
  void stop() override { end_.detach(); }

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

  void halt() noexcept override { control_.halt(); }

 protected:
  void hear(const Tick& tick) noexcept override {
    if (const std::optional<Words> words = end_.receive(control_, tick.now); words) report(*words);
  }

 private:
  /// What it tells beside its state. While it is not heard, what it told last stays.
  void report(const Words& words) noexcept {
    const Told told = decode(words);
    this->feedback.status_byte = status_byte(words);
    this->feedback.fault_code = told.fault;
    this->feedback.position_count = told.position;
    this->feedback.motor_current = told.current * current_step;
  }
  void begin_activation() noexcept override { control_.activate(); }
  void go(const GripperGoal& goal) noexcept override { control_.command(goal); }
  bool is_ready() const noexcept override { return control_.is_active(); }
  bool is_at_rest() const noexcept override { return control_.is_at_rest(); }
  void tell(const Tick& /*tick*/, bool safe) noexcept override { end_.send(control_, safe); }

  Control control_;
  RobotiqEnd end_;
};

}  // namespace flexrf::robotiq
