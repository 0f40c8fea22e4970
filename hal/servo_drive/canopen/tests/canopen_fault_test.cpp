// The driver and a drive that misbehaves, on a simulated bus in virtual time.
#include <cstdlib>
#include <limits>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/simulator/drive_console.hpp"
#include "hal/servo_drive/canopen/tests/asked_objects.hpp"
#include "hal/servo_drive/canopen/tests/drive_faults.hpp"
#include "hal/servo_drive/canopen/tests/drive_quirks.hpp"

namespace {

using namespace flexrf;

class SimulatedWorld final : public DriveFaultWorld {
 public:
  SimulatedWorld() {
    configure(drive_.configuration());
    initialised_ = bus_.driver().initialise().is_ok() && drive_.driver().initialise().is_ok() &&
                   bus_.driver().wire()->attach(far_end_) != nullptr;
  }
  ~SimulatedWorld() override {
    drive_.driver().stop();
    bus_.driver().wire()->detach(far_end_);
    bus_.driver().stop();
  }

  CanopenServoDrive& drive() override { return drive_.driver(); }
  void step(double position) override {
    bus_.receive(cycle);
    drive_.receive(cycle);
    drive().command_position(position);
    drive_.send();
    bus_.send();
  }
  void stall(Duration time) override {
    for (Duration passed{}; passed < time; passed += cycle) bus_.receive(cycle);
  }
  void restart() override {
    drive().stop();
    drive().clear_fault();
    initialised_ = drive().initialise().is_ok() && initialised_;
  }

  std::string ask(std::string_view line) override { return initialised_ ? far_end_.obey(line) : "no world"; }
  bool lose_bus(BusLoss how) override {
    switch (how) {
      case BusLoss::cable:
        return tell("unplug");
      case BusLoss::adapter:
        bus_.driver().pretend(CanBusState::gone);
        return true;
      case BusLoss::bus_off:
        // Also what it sends after each restart.
        bus_.driver().station().corrupt_next(std::numeric_limits<unsigned>::max());
        return true;
    }
    return false;
  }
  bool restore_bus(BusLoss how) override {
    bus_.driver().station().corrupt_next(0);
    bus_.driver().pretend(CanBusState::error_active);
    return how != BusLoss::cable || tell("plug");
  }
  CanBusState bus_state() override { return bus_.driver().state(); }

  Time now() const override { return drive_.now(); }

 private:
  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<CanopenServoDrive> drive_{nullptr, {}, &bus_.driver()};
  DriveConsole far_end_{{.node = node, .first_position = 1000}, bus_.now()};
  bool initialised_ = false;
};

}  // namespace

int main() {
  const int failed = run_drive_faults(
      "CANopen drive on a simulated bus",
      []() -> std::unique_ptr<DriveFaultWorld> { return std::make_unique<SimulatedWorld>(); });
  return failed + run_asked_objects() + run_drive_quirks() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
