#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/conformance/servo_drive_conformance.hpp"
#include "hal/servo_drive/mock/mock_servo_drive.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public ServoDriveWorld {
 public:
  explicit MockWorld(const ServoDriveSetup& setup) {
    auto& configuration = bench_.configuration();
    configuration.mode = setup.mode;
    configuration.endless = setup.endless;
    configuration.modulo = setup.modulo;
    configuration.acceleration = 100;
    configuration.homing_method = setup.needs_home ? 33 : 0;
    configuration.homing_speed = 2;
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
    if (const auto state = bench_.driver().state()) at_ = *state;
    at_.enabled = false;
    bench_.driver().set_state(std::nullopt);
    return initialised_;
  }
  bool find_drive() override {
    if (!bench_.driver().state()) bench_.driver().set_state(at_);
    return initialised_;
  }
  bool move_by_hand(double way) override {
    const auto state = bench_.driver().state();
    if (state && state->enabled) return true;
    at_ = state.value_or(at_);
    at_.position += way;
    if (state) bench_.driver().set_state(at_);
    return initialised_;
  }
  bool stick_axis() override {
    bench_.driver().set_sticks(true);
    return initialised_;
  }
  bool trip_drive() override {
    bench_.driver().trip();
    return initialised_;
  }
  bool lose_home() override {
    bench_.driver().fail_homing();
    return initialised_;
  }

 private:
  DeviceBench<MockServoDrive> bench_{nullptr};
  ServoState at_{.position = 1};  // while it is not heard
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_servo_drive_conformance("mock servo drive",
                                     [](const ServoDriveSetup& setup) -> std::unique_ptr<ServoDriveWorld> {
                                       return std::make_unique<MockWorld>(setup);
                                     });
}
