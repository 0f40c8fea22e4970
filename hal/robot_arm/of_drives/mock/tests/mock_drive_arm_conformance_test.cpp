#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/of_drives/mock/mock_drive_arm.hpp"
#include "six_axis.hpp"

namespace {

using namespace flexrf;

class MockDrivesWorld final : public RobotArmWorld {
 public:
  MockDrivesWorld() {
    initialised_ = bench_.driver().initialise().is_ok();
    for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
      bench_.driver().drive(i).set_state(ServoState{.position = six_axis.joints[i].home});
    }
    for (int i = 0; i < 10 && !bench_.driver().is_ready(); ++i) {
      bench_.receive(std::chrono::milliseconds(7));
      bench_.send();
    }
  }
  RobotArm& arm() override { return bench_.driver(); }
  void receive(Duration elapsed) override { bench_.receive(elapsed); }
  void send() override { bench_.send(); }
  bool lose_sensors() override {
    bench_.driver().drive(2).set_state(std::nullopt);
    return initialised_;
  }
  bool stick_joint() override {
    bench_.driver().drive(0).set_sticks(true);
    return initialised_;
  }
  bool trip_drives() override {
    bench_.driver().drive(2).trip();
    return initialised_;
  }

 private:
  DeviceBench<MockDriveArm> bench_{&six_axis};
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_robot_arm_conformance("arm of mock drives", []() -> std::unique_ptr<RobotArmWorld> {
    return std::make_unique<MockDrivesWorld>();
  });
}
