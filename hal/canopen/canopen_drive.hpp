// A ServoDrive over CANopen: what its drivers, real and simulated, have in common.
#pragma once

#include "hal/canopen/axis_on_bus.hpp"

namespace flexrf {

/// `Base`: the driver's generated base, of a ServoDrive on a CanBus, whose table has the feedback that
/// tell_as_it_came() fills. Its initialise() makes the plan and gives it to open().
template <class Base>
class CanopenDrive : public Base {
 public:
  void stop() override { link_.close(); }

  std::optional<ServoState> state() const noexcept override { return link_.state(); }
  const Status& homing_problem() const noexcept override { return link_.axis().homing_problem(); }
  void halt() noexcept override { link_.axis().halt(); }

 protected:
  /// What the interface's configuration says.
  canopen::cia402::AxisPlan plan_from_interface() const noexcept {
    const auto& from = this->configuration;
    canopen::cia402::AxisPlan plan;
    plan.mode = canopen::mode_of(from.mode);
    plan.lowest = from.lowest;
    plan.highest = from.highest;
    plan.endless = from.endless;
    plan.modulo = from.modulo;
    plan.fastest = from.fastest;
    plan.acceleration = from.acceleration;
    plan.homing_method = from.homing_method;
    plan.homing_speed = from.homing_speed;
    plan.homing_timeout = canopen::whole_milliseconds(from.homing_timeout);
    return plan;
  }
  Status open(const canopen::cia402::AxisPlan& plan) { return link_.open(plan, *this->bus, this->name()); }

 private:
  void take_in(const Tick& tick) noexcept override {
    link_.receive(tick);
    link_.tell_oddities(this->name());
    auto& told = this->feedback;
    told.homing = link_.homing();
    const canopen::Node& node = link_.axis().node();
    told.bring_ups = node.times_operational();
    told.resets = node.resets();
    told.silences = node.silences();
    told.emergencies = node.emergencies();
    tell_as_it_came(node);
    const Status& trouble = node.problem();
    const bool was_told = told.trouble[0] != '\0';
    if (was_told || !trouble.is_ok()) told.set_trouble(trouble.is_ok() ? "" : trouble.cause());
    const auto& state = link_.axis().state();
    told.enabled = state && state->enabled;
    told.target_reached = state && state->target_reached;
    if (!state) return;
    told.position = state->position;
    told.velocity = state->velocity;
    told.following_error = state->following_error;
    told.at_internal_limit = state->at_internal_limit;
    this->supervise(this->configuration, link_.axis().asked_velocity(), link_.axis().profile_target(),
                    tick.now);
  }

  void tell_as_it_came(const canopen::Node& node) noexcept {
    auto& told = this->feedback;
    told.status_word = link_.axis().statusword();
    told.mode_display = static_cast<std::int8_t>(link_.axis().mode_shown());
    const auto& emergency = node.emergency();
    told.emergency_code = emergency ? emergency->code : std::uint16_t{0};
    told.error_register = emergency ? emergency->error_register : std::uint8_t{0};
  }

  // An axis that may not move forgets by itself what it was commanded.
  void forget() noexcept override {}
  void act(const Tick& tick) noexcept override { exchange(tick, true); }
  void rest(const Tick& tick) noexcept override { exchange(tick, false); }
  void exchange(const Tick& tick, bool may_move) noexcept {
    link_.send(tick, may_move);
    if (link_.axis().is_restrained()) this->restrain(link_.axis().take_restraint());
    if (!link_.axis().fault().is_ok()) this->fail(link_.axis().fault());
  }

  bool become_safe() noexcept override { return link_.axis().is_off(); }

  void follow_position(double position) noexcept override { link_.axis().command_position(position); }
  void follow_velocity(double velocity) noexcept override { link_.axis().command_velocity(velocity); }
  void begin_move(double position, double speed) noexcept override { link_.axis().move_to(position, speed); }
  void begin_homing() noexcept override { link_.axis().home(); }

  canopen::AxisOnBus link_;
};

}  // namespace flexrf
