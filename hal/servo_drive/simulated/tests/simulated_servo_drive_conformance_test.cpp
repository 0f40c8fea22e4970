#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/conformance/servo_drive_conformance.hpp"
#include "hal/servo_drive/simulated/simulated_servo_drive.hpp"

namespace {

using namespace flexrf;

class SimulatedWorld final : public ServoDriveWorld {
 public:
  explicit SimulatedWorld(const ServoDriveSetup& setup) {
    auto& configuration = drive_.configuration();
    configuration.mode = setup.mode;
    configuration.endless = setup.endless;
    configuration.modulo = setup.modulo;
    configuration.lowest = -10;
    configuration.highest = 10;
    configuration.fastest = 20;
    configuration.acceleration = 100;
    configuration.homing_method = setup.needs_home ? 33 : 0;
    configuration.homing_speed = 2;
    configuration.node = 3;
    configuration.increments_per_unit = -2000;  // it counts the other way
    configuration.first_position = 1;
    initialised_ = bus_.driver().initialise().is_ok() && drive_.driver().initialise().is_ok();
  }
  ~SimulatedWorld() override {
    drive_.driver().stop();
    bus_.driver().stop();
  }

  ServoDrive& drive() override { return drive_.driver(); }
  void receive(Duration elapsed) override {
    bus_.receive(elapsed);
    drive_.receive(elapsed);
  }
  void send() override {
    drive_.send();
    bus_.send();
  }
  bool lose_drive() override {
    if (initialised_) drive_.driver().far_end().drive().power_off();
    return initialised_;
  }
  bool find_drive() override {
    if (initialised_) drive_.driver().far_end().drive().power_on(bus_.now());
    return initialised_;
  }
  bool move_by_hand(double way) override {
    if (initialised_) drive_.driver().far_end().drive().be_moved(-2000 * way);
    return initialised_;
  }
  bool stick_axis() override {
    if (!initialised_) return false;
    // Between two obstacles, against which it presses.
    SimulatedCia402Drive& far_end = drive_.driver().far_end().drive();
    far_end.block(far_end.motion().position(), far_end.motion().position());
    return true;
  }
  bool trip_drive() override {
    if (initialised_) {
      DriveOnCan& far_end = drive_.driver().far_end();
      far_end.drive().trip(0x2310, false, far_end.said());
    }
    return initialised_;
  }
  bool lose_home() override {
    if (initialised_) drive_.driver().far_end().drive().lose_home(true);
    return initialised_;
  }

 private:
  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<SimulatedServoDrive> drive_{nullptr, {}, &bus_.driver()};
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_servo_drive_conformance("simulated servo drive",
                                     [](const ServoDriveSetup& setup) -> std::unique_ptr<ServoDriveWorld> {
                                       return std::make_unique<SimulatedWorld>(setup);
                                     });
}
