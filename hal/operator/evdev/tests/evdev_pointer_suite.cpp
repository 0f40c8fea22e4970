#include "hal/operator/evdev/tests/evdev_descriptions.hpp"
#include "hal/operator/evdev/tests/evdev_suites.hpp"
#include "hal/operator/evdev/tests/evdev_world.hpp"
#include "hal/operator/pointer/conformance/pointer_conformance.hpp"
#include "hal/operator/pointer/evdev/evdev_pointer.hpp"

namespace flexrf {
namespace {

class PointerInGuest final : public PointerWorld {
 public:
  Status start() override { return world_.start(); }
  Pointer& device() override { return world_.driver(); }
  const PointerFeedback& feedback() override { return world_.bench().feedback(); }
  void receive() override { world_.receive(); }

  void move(int x, int y) override {
    world_.hand.report(EV_REL, REL_X, x);
    world_.hand.report(EV_REL, REL_Y, y);
  }
  void turn_wheel(int detents) override { world_.hand.report(EV_REL, REL_WHEEL, detents); }
  void press(std::size_t button) override { world_.hand.press(BTN_LEFT + static_cast<int>(button)); }
  void let_go(std::size_t button) override { world_.hand.let_go(BTN_LEFT + static_cast<int>(button)); }
  void unplug() override { world_.hand.unplug(); }
  void plug_in() override { world_.hand.plug_in(); }
  bool hide() override { return world_.hide(); }
  bool forbid() override { return world_.forbid(); }
  bool occupy() override { return world_.occupy(); }

 private:
  EvdevBench<EvdevPointer> world_{pointer_description()};
};

}  // namespace

int run_evdev_pointer_suite() {
  return run_pointer_conformance("evdev pointer on uinput", []() -> std::unique_ptr<PointerWorld> {
    return std::make_unique<PointerInGuest>();
  });
}

}  // namespace flexrf
