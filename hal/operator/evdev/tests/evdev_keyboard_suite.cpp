#include "hal/operator/evdev/tests/evdev_descriptions.hpp"
#include "hal/operator/evdev/tests/evdev_suites.hpp"
#include "hal/operator/evdev/tests/evdev_world.hpp"
#include "hal/operator/keyboard/conformance/keyboard_conformance.hpp"
#include "hal/operator/keyboard/evdev/evdev_keyboard.hpp"
#include "hal/operator/keyboard/evdev/evdev_keys.hpp"

namespace flexrf {
namespace {

/// The key that writes this, or is it.
int code_of(const KeyEvent& event) {
  for (unsigned code = 1; code < 128; ++code)
    if (is_same_key(key_of_code(code, false), event)) return static_cast<int>(code);
  return KEY_UNKNOWN;
}

class KeyboardInGuest final : public KeyboardWorld {
 public:
  void will_press(std::span<const KeyEvent> events, bool /*then_ends*/) override {
    events_.assign(events.begin(), events.end());
  }
  Status start(std::span<QueueSink* const> sinks) override { return world_.start(sinks); }
  Keyboard& keyboard() override { return world_.driver(); }
  void receive() override {
    // Nobody presses more in a cycle than the kernel keeps.
    for (int n = 0; n < 8 && pressed_ < events_.size(); ++n, ++pressed_) {
      world_.hand.press(code_of(events_[pressed_]));
      world_.hand.let_go(code_of(events_[pressed_]));
    }
    world_.receive();
  }
  bool can_end() const override { return false; }

  bool hold(const KeyEvent& key) override {
    world_.hand.press(code_of(key));
    return true;
  }
  bool let_go(const KeyEvent& key) override {
    world_.hand.let_go(code_of(key));
    return true;
  }
  bool unplug() override {
    world_.hand.unplug();
    return true;
  }
  bool plug_in() override { return world_.hand.plug_in(); }
  bool hide() override { return world_.hide(); }
  bool forbid() override { return world_.forbid(); }
  bool occupy() override { return world_.occupy(); }

 private:
  EvdevBench<EvdevKeyboard> world_{keyboard_description()};
  std::vector<KeyEvent> events_;
  std::size_t pressed_ = 0;
};

}  // namespace

int run_evdev_keyboard_suite() {
  return run_keyboard_conformance("evdev keyboard on uinput", []() -> std::unique_ptr<KeyboardWorld> {
    return std::make_unique<KeyboardInGuest>();
  });
}

}  // namespace flexrf
