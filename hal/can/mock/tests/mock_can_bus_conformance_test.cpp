#include <deque>

#include "hal/can/conformance/can_bus_conformance.hpp"
#include "hal/can/mock/mock_can_bus.hpp"
#include "hal/driver/device_bench.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public CanBusWorld {
 public:
  MockWorld() {
    initialised_ = bench_.driver().initialise().is_ok();
    bench_.driver().set_room(40);
  }
  CanBus& bus() override { return bench_.driver(); }
  void receive() override { bench_.receive(std::chrono::milliseconds(1)); }
  void send() override {
    bench_.send();
    for (const CanFrame& frame : bench_.driver().take_sent()) heard_.push_back(frame);
  }
  Time now() const override { return bench_.now(); }

  void say(const CanFrame& frame) override { bench_.driver().say(frame); }
  std::optional<CanFrame> hear() override {
    if (heard_.empty()) return std::nullopt;
    const CanFrame frame = heard_.front();
    heard_.pop_front();
    return frame;
  }

  bool set_down() override { return pretend(CanBusState::down); }
  bool set_up() override { return pretend(CanBusState::error_active); }
  bool take_away() override { return pretend(CanBusState::gone); }
  bool put_back() override { return pretend(CanBusState::error_active); }
  bool cause_bus_off() override { return pretend(CanBusState::bus_off); }
  void end_bus_off() override { pretend(CanBusState::error_active); }
  bool cause_error_passive() override { return pretend(CanBusState::error_passive); }

 private:
  bool pretend(CanBusState state) {
    bench_.driver().pretend(state);
    return initialised_;
  }

  DeviceBench<MockCanBus> bench_{nullptr};
  std::deque<CanFrame> heard_;
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_can_bus_conformance(
      "mock CAN bus", []() -> std::unique_ptr<CanBusWorld> { return std::make_unique<MockWorld>(); });
}
