#include "hal/interfaces/keyboard/conformance/keyboard_conformance.hpp"
#include "hal/mock/mock_keyboard/mock_keyboard.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public KeyboardWorld {
 public:
  void will_press(std::span<const KeyEvent> events, bool then_ends) override {
    events_.assign(events.begin(), events.end());
    ends_ = then_ends;
  }
  Status start(std::span<QueueSink* const> sinks) override {
    bench_.emplace(nullptr, sinks);
    const Status status = bench_->driver().initialise();
    for (const KeyEvent& event : events_) bench_->driver().press(event);
    if (ends_) bench_->driver().close();
    return status;
  }
  Keyboard& keyboard() override { return bench_->driver(); }
  void receive() override { bench_->receive(std::chrono::milliseconds(7)); }

 private:
  std::vector<KeyEvent> events_;
  bool ends_ = false;
  std::optional<DeviceBench<MockKeyboard>> bench_;
};

}  // namespace

int main() {
  return run_keyboard_conformance(
      "mock keyboard", []() -> std::unique_ptr<KeyboardWorld> { return std::make_unique<MockWorld>(); });
}
