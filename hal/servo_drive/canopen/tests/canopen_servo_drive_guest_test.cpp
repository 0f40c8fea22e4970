// The driver on a real interface (vcan), as root; the drive is another process, and both meet only on the
// wire.
#include "hal/servo_drive/canopen/tests/real_axis.hpp"
#include "hal/servo_drive/conformance/servo_drive_conformance.hpp"
#include "places.hpp"

namespace {

using namespace flexrf;

class RealDriveWorld final : public ServoDriveWorld {
 public:
  explicit RealDriveWorld(const ServoDriveSetup& setup) {
    auto& configuration = axis_.configuration();
    configuration.mode = setup.mode;
    configuration.endless = setup.endless;
    configuration.modulo = setup.modulo;
    configuration.acceleration = 100;
    configuration.homing_method = setup.needs_home ? 33 : 0;
    configuration.homing_speed = 2;
    configuration.lowest = -10;
    configuration.highest = 10;
    configuration.fastest = 20;
    configuration.node = 5;
    configuration.vendor = 0x123;
    configuration.product = 0x456;
    configuration.increments_per_unit = 1000;
    ready_ = interface_.is_ready() && far_end_.is_running() && axis_.initialise();
  }

  ServoDrive& drive() override { return axis_.drive(); }
  void receive(Duration /*elapsed*/) override { axis_.receive(); }
  void send() override { axis_.send(); }
  bool shares_its_cycle() const override { return false; }
  bool lose_drive() override { return ready_ && far_end_.ask("off") == "ok"; }
  bool stick_axis() override { return ready_ && far_end_.ask("cut motor") == "ok"; }
  bool trip_drive() override { return ready_ && far_end_.ask("trip 0x2310") == "ok"; }
  bool lose_home() override { return ready_ && far_end_.ask("lose home") == "ok"; }

 private:
  VirtualInterface interface_{true};
  SimulatorProcess far_end_{place::cia402_simulator, {can_interface, "--node", "5"}};
  RealAxis axis_;
  bool ready_ = false;
};

}  // namespace

int main() {
  return run_servo_drive_conformance("CANopen drive on vcan, the drive another process",
                                     [](const ServoDriveSetup& setup) -> std::unique_ptr<ServoDriveWorld> {
                                       return std::make_unique<RealDriveWorld>(setup);
                                     });
}
