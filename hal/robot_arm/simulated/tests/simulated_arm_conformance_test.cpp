#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/simulated/simulated_arm.hpp"
#include "six_axis.hpp"

namespace {

using namespace flexrf;

class SimulatedWorld final : public RobotArmWorld {
 public:
  SimulatedWorld() { initialised_ = bench_.driver().initialise().is_ok(); }
  RobotArm& arm() override { return bench_.driver(); }
  void receive(Duration elapsed) override { bench_.receive(elapsed); }
  void send() override { bench_.send(); }
  double noise() const override { return 2e-4; }  // ten standard deviations
  bool lose_sensors() override {
    bench_.driver().inject(SimulatedArm::Fault::sensors_lost);
    return initialised_;
  }
  bool stick_joint() override {
    bench_.driver().inject(SimulatedArm::Fault::joint_sticks);
    return initialised_;
  }
  bool trip_drives() override {
    bench_.driver().inject(SimulatedArm::Fault::drives_trip);
    return initialised_;
  }

 private:
  DeviceBench<SimulatedArm> bench_{&six_axis};
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_robot_arm_conformance(
      "simulated arm", []() -> std::unique_ptr<RobotArmWorld> { return std::make_unique<SimulatedWorld>(); });
}
