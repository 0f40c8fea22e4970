// The gripper that is an axis on a real interface (vcan), as root: the conformance suite and the faults. The
// drive is another process, the cable is the interface that goes down.
#include "hal/gripper/canopen/canopen_gripper.hpp"
#include "hal/gripper/canopen/tests/gripper_faults.hpp"
#include "hal/servo_drive/canopen/tests/real_axis.hpp"
#include "places.hpp"

namespace {

using namespace flexrf;

class RealGripperWorld final : public AxisGripperWorld {
 public:
  explicit RealGripperWorld(const FingerAxis& axis) : AxisGripperWorld{axis} {}

  Status start(const GripperSetting& setting) override {
    configure(device_.configuration(), setting);
    if (!interface_.is_ready()) return Status::error(StatusCode::unavailable, "no interface");
    if (!far_end_.is_running()) return Status::error(StatusCode::unavailable, "no simulator");
    ready_ = device_.initialise();
    return ready_ ? Status{} : Status::error(StatusCode::unavailable, "no driver");
  }
  CanopenGripper& driver() override { return device_.drive(); }
  void receive() override { device_.receive(); }
  void send() override { device_.send(); }
  Time now() const override { return device_.now(); }
  /// The cycles are counted, and the drive lives by the machine's clock.
  bool has_virtual_time() const override { return false; }
  void stall(Duration time) override { std::this_thread::sleep_for(time); }
  std::string ask(std::string_view line) override { return ready_ ? far_end_.ask(line) : ""; }
  bool set_cable(bool in) override { return set_interface(in); }

 private:
  VirtualInterface interface_{true};
  SimulatorProcess far_end_{place::cia402_simulator, {can_interface, "--node", "5"}};
  RealDevice<CanopenGripper> device_;
  bool ready_ = false;
};

}  // namespace

int main() {
  int failed = run_gripper_conformance(
      "gripper that is an axis, on vcan",
      []() -> std::unique_ptr<GripperWorld> { return std::make_unique<RealGripperWorld>(FingerAxis{}); });
  failed += run_gripper_faults("faults of a gripper that is an axis, on vcan",
                               [](const FingerAxis& axis) -> std::unique_ptr<AxisGripperWorld> {
                                 return std::make_unique<RealGripperWorld>(axis);
                               });
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
