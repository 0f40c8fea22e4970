#include "hal/operator/keyboard/conformance/keyboard_conformance.hpp"
#include "hal/operator/keyboard/mock/mock_keyboard.hpp"

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
    bench_->driver().refuse(refusal_);
    const Status status = bench_->driver().initialise();
    for (const KeyEvent& event : events_) bench_->driver().press(event);
    if (ends_) bench_->driver().close();
    return status;
  }
  Keyboard& keyboard() override { return bench_->driver(); }
  void receive() override { bench_->receive(std::chrono::milliseconds(7)); }

  bool hold(const KeyEvent& key) override {
    return act([&](MockKeyboard& mock) { mock.hold(key); });
  }
  bool let_go(const KeyEvent& key) override {
    return act([&](MockKeyboard& mock) { mock.let_go(key); });
  }
  bool unplug() override {
    return act([](MockKeyboard& mock) { mock.unplug(); });
  }
  bool plug_in() override {
    return act([](MockKeyboard& mock) { mock.plug_in(); });
  }
  bool hide() override { return refuse(StatusCode::not_found); }
  bool forbid() override { return refuse(StatusCode::not_permitted); }
  bool occupy() override { return refuse(StatusCode::busy); }

 private:
  template <class Act>
  bool act(const Act& act) {
    act(bench_->driver());
    return true;
  }
  bool refuse(StatusCode code) {
    refusal_ = Status::error(code, "scripted, not produced");
    return true;
  }

  Status refusal_;
  std::vector<KeyEvent> events_;
  bool ends_ = false;
  std::optional<DeviceBench<MockKeyboard>> bench_;
};

}  // namespace

int main() {
  return run_keyboard_conformance(
      "mock keyboard", []() -> std::unique_ptr<KeyboardWorld> { return std::make_unique<MockWorld>(); });
}
