#include "hal/gripper/simulated_axis/simulated_axis_gripper.hpp"

#include <cmath>

#include "hal/can/in_process/can_wire.hpp"

namespace flexrf {
namespace {

constexpr double fastest_fingers = 1;      // m/s
constexpr double finger_acceleration = 2;  // m/s^2
constexpr double weakest_share = 0.01;     // of the strongest

}  // namespace

Status SimulatedAxisGripper::initialise() {
  CanWire* wire = bus->wire();
  if (wire == nullptr) {
    return Status::error(
        StatusCode::invalid_argument,
        "%s is a simulated gripper on the bus %s, which is not simulated: choose the bus's driver "
        "'in_process' with it",
        name(), bus->name());
  }
  if (far_end_) wire->detach(*far_end_);
  canopen::GripperAxisPlan plan = plan_from_interface();
  plan.strongest = plan.rated_force = configuration.strongest;
  plan.weakest = weakest_share * configuration.strongest;
  canopen::cia402::AxisPlan axis;
  axis.node = configuration.node;
  axis.period = canopen::whole_milliseconds(configuration.period);
  axis.increments_per_unit = increments;
  axis.fastest = fastest_fingers;
  axis.acceleration = axis.quick_stop_deceleration = finger_acceleration;
  axis.limits_torque = axis.tells_torque = axis.may_be_blocked = true;
  const double first =
      far_end_ ? far_end_->drive().motion().position() : std::round(configuration.open_width * increments);
  far_end_.emplace(
      SimulatedCia402Drive::Options{.node = axis.node,
                                    .boot_delay = canopen::whole_milliseconds(configuration.boot_delay),
                                    .first_position = first},
      Time{});
  if (configuration.object_width > 0) {
    far_end_->drive().block(configuration.object_width * increments, std::nullopt);
  }
  const CanIdentifier heard[] = {
      {canopen::nmt_identifier},
      {canopen::sync_identifier},
      {canopen::receive_pdo_identifier(1, axis.node)},
      {canopen::receive_pdo_identifier(2, axis.node)},
      {canopen::identifier_of(canopen::sdo_request_base, axis.node)},
      {canopen::identifier_of(canopen::heartbeat_base, axis.master)},
  };
  if (wire->attach(*far_end_, heard) == nullptr) {
    return Status::error(StatusCode::busy, "the bus %s has no place for another drive, %s", bus->name(),
                         name());
  }
  return open(plan, axis);
}

void SimulatedAxisGripper::stop() {
  AxisGripper::stop();
  if (far_end_) bus->wire()->detach(*far_end_);
}

}  // namespace flexrf
