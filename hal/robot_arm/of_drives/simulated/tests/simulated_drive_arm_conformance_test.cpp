#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/of_drives/simulated/simulated_drive_arm.hpp"
#include "six_axis.hpp"

namespace {

using namespace flexrf;

class SimulatedDrivesWorld final : public RobotArmWorld {
 public:
  SimulatedDrivesWorld() {
    arm_.configuration().increments_per_unit.fill(increments);
    arm_.configuration().homing_methods[5] = 35;  // at home where it is
    initialised_ = bus_.driver().initialise().is_ok() && arm_.driver().initialise().is_ok();
    for (int i = 0; i < 1000 && initialised_ && !arm_.driver().is_ready(); ++i) {
      receive(std::chrono::milliseconds(7));
      send();
    }
  }
  ~SimulatedDrivesWorld() override {
    if (initialised_) arm_.driver().stop();
    bus_.driver().stop();
  }

  RobotArm& arm() override { return arm_.driver(); }
  void receive(Duration elapsed) override {
    bus_.receive(elapsed);
    arm_.receive(elapsed);
  }
  void send() override {
    arm_.send();
    bus_.send();
  }
  double noise() const override { return 1 / increments; }
  bool lose_sensors() override {
    if (initialised_) arm_.driver().drive(2).far_end().drive().power_off();
    return initialised_;
  }
  bool stick_joint() override {
    if (initialised_) arm_.driver().drive(0).far_end().drive().cut_motor(true);
    return initialised_;
  }
  bool trip_drives() override {
    if (initialised_) {
      DriveOnCan& far_end = arm_.driver().drive(2).far_end();
      far_end.drive().trip(0x2310, false, far_end.said());
    }
    return initialised_;
  }

 private:
  static constexpr double increments = 100'000;

  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<SimulatedDriveArm> arm_{&six_axis, {}, &bus_.driver()};
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_robot_arm_conformance("arm of simulated drives", []() -> std::unique_ptr<RobotArmWorld> {
    return std::make_unique<SimulatedDrivesWorld>();
  });
}
