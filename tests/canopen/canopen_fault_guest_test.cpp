// What goes wrong on a real interface (vcan), as root; the drive is another process, the cable is the
// interface that goes down.
#include "tests/canopen/drive_faults.hpp"
#include "tests/canopen/real_axis.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

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
  bool set_cable(bool in) override { return set_interface(in); }

  Time now() const override { return axis_.now(); }

 private:
  VirtualInterface interface_;
  SimulatorProcess far_end_{CIA402_SIMULATOR, {can_interface, "--node", "5"}};
  RealAxis axis_;
  bool initialised_ = false;
};

bool waits_for_an_interface_that_is_missing_at_start() {
  RealFaultWorld world(false);
  for (int i = 0; i < 300; ++i) world.step(1);
  if (world.drive().state() || !world.drive().fault().is_ok()) return false;
  if (!add_interface() || !set_interface(true)) return false;
  for (int i = 0; i < 5000; ++i) {
    world.step(1);
    const auto state = world.drive().state();
    if (state && state->enabled) return world.drive().fault().is_ok();
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
