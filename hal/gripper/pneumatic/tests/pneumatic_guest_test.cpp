// The pneumatic gripper on the kernel's simulated chip, in the guest: a cylinder moves its reed switches by
// what its valves' lines are.
#include <ctime>

#include "base/text.hpp"
#include "hal/gpio/chip/linux/linux_gpio_chip.hpp"
#include "hal/gpio/chip/linux/tests/gpio_sim.hpp"
#include "hal/gripper/pneumatic/tests/pneumatic_world.hpp"

namespace {

using namespace flexrf;

class GpioSimWorld final : public PneumaticWorld<LinuxGpioChip> {
 public:
  GpioSimWorld() : PneumaticWorld(false) { set_text(chip().configuration().chip, GpioSim::label); }
  ~GpioSimWorld() override {
    if (!sim_.is_plugged()) sim_.plug_in();
    connect({});
    end();
  }
  Time now() const override { return MonotonicClock::now(); }
  bool has_virtual_time() const override { return false; }

 private:
  Duration pass_time() override {
    const timespec pause{0, 1'000'000};
    nanosleep(&pause, nullptr);
    return MonotonicClock::now() - PneumaticWorld::now();
  }
  Valves valves() override { return {sim_.is_high("VALVE_OPEN"), sim_.is_high("VALVE_CLOSE")}; }
  void connect(const ReedSwitches& reeds) override {
    sim_.pull("REED_OPEN", reeds.open);
    sim_.pull("REED_CLOSED", reeds.closed);
  }
  bool is_there() override { return sim_.is_plugged(); }
  bool unplug() override {
    sim_.unplug();
    return sim_.is_good();
  }
  bool plug_in() override {
    sim_.plug_in();
    return sim_.is_good();
  }

  GpioSim sim_;
};

}  // namespace

int main() {
  return run_gripper_conformance("pneumatic gripper on gpio-sim", []() -> std::unique_ptr<GripperWorld> {
    return std::make_unique<GpioSimWorld>();
  });
}
