#include "hal/servo_drive/simulated/simulated_servo_drive.hpp"

#include <cmath>

#include "hal/can/in_process/can_wire.hpp"

namespace flexrf {
namespace {

constexpr double motor_reserve = 1.5;     // it can go faster than it may
constexpr double quick_stop_reserve = 2;  // and stops quicker than its profiles do

}  // namespace

Status SimulatedServoDrive::initialise() {
  CanWire* wire = bus->wire();
  if (wire == nullptr) {
    return Status::error(
        StatusCode::invalid_argument,
        "%s is a simulated drive on the bus %s, which is not simulated: choose the bus's driver "
        "'in_process' with it",
        name(), bus->name());
  }
  if (far_end_) wire->detach(*far_end_);
  canopen::cia402::AxisPlan plan = plan_from_interface();
  plan.node = configuration.node;
  plan.vendor = configuration.vendor;
  plan.product = configuration.product;
  plan.period = canopen::whole_milliseconds(configuration.period);
  plan.increments_per_unit = configuration.increments_per_unit;
  plan.quick_stop_deceleration = quick_stop_reserve * configuration.acceleration;
  const double increments = configuration.increments_per_unit;
  const double first = far_end_ ? far_end_->drive().motion().position()
                                : std::round(configuration.first_position * increments);
  far_end_.emplace(
      SimulatedCia402Drive::Options{.node = plan.node,
                                    .boot_delay = canopen::whole_milliseconds(configuration.boot_delay),
                                    .brake_delay = canopen::whole_milliseconds(configuration.brake_delay),
                                    .fastest = motor_reserve * configuration.fastest * std::abs(increments),
                                    .first_position = first},
      Time{});
  const CanIdentifier heard[] = {
      {canopen::nmt_identifier},
      {canopen::sync_identifier},
      {canopen::receive_pdo_identifier(1, plan.node)},
      {canopen::receive_pdo_identifier(2, plan.node)},
      {canopen::identifier_of(canopen::sdo_request_base, plan.node)},
      {canopen::identifier_of(canopen::heartbeat_base, plan.master)},
  };
  if (wire->attach(*far_end_, heard) == nullptr) {
    return Status::error(StatusCode::busy, "the bus %s has no place for another drive, %s", bus->name(),
                         name());
  }
  return open(plan);
}

void SimulatedServoDrive::stop() {
  CanopenDrive::stop();
  if (far_end_) bus->wire()->detach(*far_end_);
}

}  // namespace flexrf
