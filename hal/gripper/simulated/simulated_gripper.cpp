#include "hal/gripper/simulated/simulated_gripper.hpp"

#include "hal/modbus/link/simulated/simulated_modbus_link.hpp"

namespace flexrf {

Status SimulatedGripper::initialise() {
  auto* const link = dynamic_cast<SimulatedModbusLink*>(bus);
  if (link == nullptr) {
    return Status::error(
        StatusCode::invalid_argument,
        "a simulated gripper is on a simulated link, and this link is real; choose both alike "
        "with --hardware");
  }
  robotiq::ModelPlan plan;
  plan.open_width = configuration.open_width;
  plan.closed_width = configuration.closed_width;
  plan.open_count = configuration.open_count;
  plan.closed_count = configuration.closed_count;
  plan.slowest = configuration.slowest;
  plan.fastest = configuration.fastest;
  plan.object_width = configuration.object_width;
  // Initialised again it is the same gripper, as it was left.
  if (model_ == nullptr) {
    model_ = std::make_shared<robotiq::RobotiqModel>(plan);
    link->registers().set_model(configuration.unit_id, model_);
  }
  return RobotiqDriver::initialise();
}

void SimulatedGripper::hear(const Tick& tick) noexcept {
  model_->want_stuck(runtime.stuck);
  if (runtime.take_object > 0) model_->want_taken();
  if (runtime.overload > 0) model_->want_fault(0x0E);
  RobotiqDriver::hear(tick);
}

}  // namespace flexrf
