#include <cmath>

#include "hal/operator/evdev/tests/evdev_descriptions.hpp"
#include "hal/operator/evdev/tests/evdev_suites.hpp"
#include "hal/operator/evdev/tests/evdev_world.hpp"
#include "hal/operator/joystick/conformance/joystick_conformance.hpp"
#include "hal/operator/joystick/evdev/evdev_joystick.hpp"

namespace flexrf {
namespace {

class JoystickInGuest final : public JoystickWorld {
 public:
  Status start() override {
    world_.bench().configuration().dead_zone = dead_zone;
    return world_.start();
  }
  Joystick& device() override { return world_.driver(); }
  const JoystickFeedback& feedback() override { return world_.bench().feedback(); }
  void receive() override { world_.receive(); }

  void deflect(std::size_t number, double part) override {
    const UinputDescription::Axis& axis = description_.axes[number];
    const double middle = (axis.minimum + axis.maximum) / 2.0;
    const double half = (axis.maximum - axis.minimum) / 2.0;
    world_.hand.report(EV_ABS, axis.code, static_cast<int>(std::lround(middle + part * half)));
  }
  void press(std::size_t button) override { world_.hand.press(description_.keys[button]); }
  void let_go(std::size_t button) override { world_.hand.let_go(description_.keys[button]); }
  void unplug() override { world_.hand.unplug(); }
  void plug_in() override { world_.hand.plug_in(); }
  bool hide() override { return world_.hide(); }
  bool forbid() override { return world_.forbid(); }
  bool occupy() override { return world_.occupy(); }

 private:
  UinputDescription description_ = joystick_description();
  EvdevBench<EvdevJoystick> world_{description_};
};

}  // namespace

int run_evdev_joystick_suite() {
  return run_joystick_conformance("evdev joystick on uinput", []() -> std::unique_ptr<JoystickWorld> {
    return std::make_unique<JoystickInGuest>();
  });
}

}  // namespace flexrf
