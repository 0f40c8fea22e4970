// The real driver, its messages on a simulated bus, and a simulated drive at the other end.
#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"
#include "hal/servo_drive/canopen/simulator/drive_on_can.hpp"
#include "hal/servo_drive/conformance/servo_drive_conformance.hpp"

namespace {

using namespace flexrf;

class CanopenWorld final : public ServoDriveWorld {
 public:
  explicit CanopenWorld(const ServoDriveSetup& setup, bool interpolates) {
    auto& configuration = drive_.configuration();
    configuration.mode = setup.mode;
    configuration.interpolates = interpolates && setup.mode == ServoMode::cyclic_position;
    configuration.endless = setup.endless;
    configuration.modulo = setup.modulo;
    configuration.acceleration = 100;
    configuration.homing_method = setup.needs_home ? 33 : 0;
    configuration.homing_speed = 2;
    configuration.lowest = -10;
    configuration.highest = 10;
    configuration.fastest = 20;
    configuration.node = node;
    configuration.vendor = 0x123;
    configuration.product = 0x456;
    configuration.increments_per_unit = 1000;
    initialised_ = bus_.driver().initialise().is_ok() && drive_.driver().initialise().is_ok() &&
                   bus_.driver().wire()->attach(far_end_) != nullptr;
  }
  ~CanopenWorld() override {
    drive_.driver().stop();
    bus_.driver().wire()->detach(far_end_);
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
    far_end_.drive().power_off();
    return initialised_;
  }
  bool find_drive() override {
    far_end_.drive().power_on(bus_.now());
    return initialised_;
  }
  bool move_by_hand(double way) override {
    far_end_.drive().be_moved(1000 * way);
    return initialised_;
  }
  bool stick_axis() override {
    far_end_.drive().cut_motor(true);
    return initialised_;
  }
  bool trip_drive() override {
    far_end_.drive().trip(0x2310, false, far_end_.said());
    return initialised_;
  }
  bool lose_home() override {
    far_end_.drive().lose_home(true);
    return initialised_;
  }

 private:
  static constexpr std::uint8_t node = 5;

  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<CanopenServoDrive> drive_{nullptr, {}, &bus_.driver()};
  DriveOnCan far_end_{{.node = node, .first_position = 1000}, bus_.now()};
  bool initialised_ = false;
};

template <bool Interpolates>
std::unique_ptr<ServoDriveWorld> make_world(const ServoDriveSetup& setup) {
  return std::make_unique<CanopenWorld>(setup, Interpolates);
}

}  // namespace

int main() {
  return run_servo_drive_conformance("canopen servo drive", make_world<false>) +
         run_servo_drive_conformance("canopen servo drive, interpolated positions", make_world<true>);
}
