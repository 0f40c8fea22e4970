#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "hal/operator/keyboard/conformance/keyboard_conformance.hpp"
#include "hal/operator/keyboard/script/script_keyboard.hpp"

namespace {

using namespace flexrf;

class ScriptWorld final : public KeyboardWorld {
 public:
  ~ScriptWorld() override { std::remove(file_.c_str()); }

  void will_press(std::span<const KeyEvent> events, bool then_ends) override {
    std::ofstream script(file_);
    for (const KeyEvent& event : events) script << "0.01 " << name_of(event) << '\n';
    if (!then_ends) script << "1000 x\n";  // open: there is more to come
  }
  Status start(std::span<QueueSink* const> sinks) override {
    bench_.emplace(nullptr, sinks);
    bench_->environment().options = OptionValues{{&keys_, 1}};
    return bench_->driver().initialise();
  }
  Keyboard& keyboard() override { return bench_->driver(); }
  void receive() override { bench_->receive(std::chrono::milliseconds(7)); }

 private:
  static std::string name_of(const KeyEvent& event) {
    switch (event.key) {
      case Key::up:
        return "up";
      case Key::down:
        return "down";
      case Key::left:
        return "left";
      case Key::right:
        return "right";
      default:
        return std::string(1, static_cast<char>(event.character));
    }
  }

  std::string file_ = "/tmp/flexrf_script_" + std::to_string(getpid()) + ".keys";
  const GivenOption keys_{script_keyboard_driver_options, file_.c_str()};
  std::optional<DeviceBench<ScriptKeyboard>> bench_;
};

}  // namespace

int main() {
  return run_keyboard_conformance(
      "script keyboard", []() -> std::unique_ptr<KeyboardWorld> { return std::make_unique<ScriptWorld>(); });
}
