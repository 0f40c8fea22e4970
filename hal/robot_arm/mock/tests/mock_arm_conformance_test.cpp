#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/mock/mock_arm.hpp"
#include "six_axis.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public RobotArmWorld {
 public:
  MockWorld() { initialised_ = bench_.driver().initialise().is_ok(); }
  RobotArm& arm() override { return bench_.driver(); }
  void receive(Duration elapsed) override { bench_.receive(elapsed); }
  void send() override { bench_.send(); }
  bool lose_sensors() override {
    lost_ = bench_.driver().state();
    bench_.driver().set_state(std::nullopt);
    return initialised_;
  }
  bool find_sensors() override {
    bench_.driver().set_state(lost_);
    return initialised_;
  }
  bool stick_joint() override {
    bench_.driver().set_follows(false);
    return initialised_;
  }
  bool trip_drives() override {
    bench_.driver().trip_drives();
    return initialised_;
  }

 private:
  DeviceBench<MockArm> bench_{&six_axis};
  std::optional<JointState> lost_;  // where it was
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_robot_arm_conformance(
      "mock arm", []() -> std::unique_ptr<RobotArmWorld> { return std::make_unique<MockWorld>(); });
}
