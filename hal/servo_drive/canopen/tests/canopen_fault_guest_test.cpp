// What goes wrong on a real interface (vcan), as root; the drive is another process, the cable is the
// interface that goes down, the adapter the interface that is removed, and bus-off is injected, not produced.
#include <linux/can/error.h>
#include <net/if.h>
#include <unistd.h>

#include "hal/servo_drive/canopen/tests/drive_faults.hpp"
#include "hal/servo_drive/canopen/tests/real_axis.hpp"
#include "places.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"
#include "tests/recovery.hpp"

namespace {

using namespace flexrf;

// As the controller's driver says it; no virtual interface goes off the bus by itself.
bool inject_error(canid_t what) {
  const auto socket = std::make_unique<CanSocket>();
  if (!socket->open() || !socket->bind(static_cast<int>(if_nametoindex(can_interface)))) return false;
  can_frame frame{};
  frame.can_id = CAN_ERR_FLAG | what;
  frame.can_dlc = CAN_ERR_DLC;
  return write(socket->descriptor(), &frame, sizeof(frame)) == static_cast<ssize_t>(sizeof(frame));
}

class RealFaultWorld final : public DriveFaultWorld {
 public:
  RealFaultWorld() : RealFaultWorld(true) {}
  explicit RealFaultWorld(bool interface_is_there) : interface_{interface_is_there} {
    configure(axis_.configuration());
    initialised_ = far_end_.is_running() && axis_.initialise();
  }

  CanopenServoDrive& drive() override { return axis_.drive(); }
  void step(double position) override {
    axis_.receive();
    drive().command_position(position);
    axis_.send();
  }
  void stall(Duration time) override { std::this_thread::sleep_for(time); }
  void restart() override {
    drive().stop();
    drive().clear_fault();
    initialised_ = drive().initialise().is_ok() && initialised_;
  }

  std::string ask(std::string_view line) override { return initialised_ ? far_end_.ask(line) : ""; }
  bool lose_bus(BusLoss how) override {
    switch (how) {
      case BusLoss::cable:
        return set_interface(false);
      case BusLoss::adapter:
        return remove_interface();
      case BusLoss::bus_off:
        // Who is off the bus hears nobody, either.
        return tell("unplug") && inject_error(CAN_ERR_BUSOFF);
    }
    return false;
  }
  bool restore_bus(BusLoss how) override {
    switch (how) {
      case BusLoss::cable:
        return set_interface(true);
      case BusLoss::adapter:
        return add_interface() && set_interface(true);
      case BusLoss::bus_off:
        return inject_error(CAN_ERR_RESTARTED) && tell("plug");
    }
    return false;
  }
  CanBusState bus_state() override { return axis_.bus().state(); }

  Time now() const override { return axis_.now(); }

 private:
  VirtualInterface interface_;
  SimulatorProcess far_end_{place::cia402_simulator, {can_interface, "--node", "5"}};
  RealAxis axis_;
  bool initialised_ = false;
};

bool waits_for_an_interface_that_is_missing_at_start() {
  const LogEar log;
  RealFaultWorld world(false);
  for (int i = 0; i < 300; ++i) world.step(1);
  if (world.drive().state() || !world.drive().fault().is_ok()) return false;
  if (!log.has_heard(std::string("there is no network interface ") + can_interface)) return false;
  if (!add_interface() || !set_interface(true)) return false;
  const Time came = world.now();
  for (int i = 0; i < 5000; ++i) {
    world.step(1);
    const auto state = world.drive().state();
    if (!state || !state->enabled) continue;
    return world.drive().fault().is_ok() &&
           is_back_in_time("an interface that was missing", world.now() - came);
  }
  return false;
}

void interface_missing_at_start(void**) {
  assert_true(waits_for_an_interface_that_is_missing_at_start());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(interface_missing_at_start)};
  int failed = run_drive_faults(
      "faults of a CANopen drive on vcan",
      []() -> std::unique_ptr<DriveFaultWorld> { return std::make_unique<RealFaultWorld>(); });
  failed += cmocka_run_group_tests_name("CANopen drive beside the suites", tests, nullptr, nullptr);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
