#include "hal/interfaces/device_bench.hpp"
#include "hal/interfaces/servo_drive/conformance/servo_drive_conformance.hpp"
#include "hal/mock/mock_servo_drive/mock_servo_drive.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public ServoDriveWorld {
 public:
  explicit MockWorld(bool takes_velocities) {
    auto& configuration = bench_.configuration();
    configuration.takes_velocities = takes_velocities;
    configuration.lowest = -10;
    configuration.highest = 10;
    configuration.fastest = 20;
    initialised_ = bench_.driver().initialise().is_ok();
    bench_.driver().set_state(ServoState{.position = 1});
  }
  ServoDrive& drive() override { return bench_.driver(); }
  void receive(Duration elapsed) override { bench_.receive(elapsed); }
  void send() override { bench_.send(); }
  bool lose_drive() override {
    bench_.driver().set_state(std::nullopt);
    return initialised_;
  }
  bool trip_drive() override {
    bench_.driver().trip();
    return initialised_;
  }

 private:
  DeviceBench<MockServoDrive> bench_{nullptr};
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_servo_drive_conformance("mock servo drive",
                                     [](bool takes_velocities) -> std::unique_ptr<ServoDriveWorld> {
                                       return std::make_unique<MockWorld>(takes_velocities);
                                     });
}
