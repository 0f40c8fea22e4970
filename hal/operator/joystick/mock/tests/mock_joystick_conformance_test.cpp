#include "hal/driver/device_bench.hpp"
#include "hal/operator/joystick/conformance/joystick_conformance.hpp"
#include "hal/operator/joystick/mock/mock_joystick.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public JoystickWorld {
 public:
  Status start() override {
    bench_.configuration().dead_zone = dead_zone;
    return mock().initialise();
  }
  Joystick& device() override { return mock(); }
  const JoystickFeedback& feedback() override { return bench_.feedback(); }
  void receive() override { bench_.receive(std::chrono::milliseconds(7)); }

  void deflect(std::size_t axis, double part) override { mock().deflect(axis, part); }
  void press(std::size_t button) override { mock().press(button); }
  void let_go(std::size_t button) override { mock().let_go(button); }
  void unplug() override { mock().unplug(); }
  void plug_in() override { mock().plug_in(); }

  bool hide() override { return refuse(StatusCode::not_found); }
  bool forbid() override { return refuse(StatusCode::not_permitted); }
  bool occupy() override { return refuse(StatusCode::busy); }

 private:
  MockJoystick& mock() { return bench_.driver(); }
  bool refuse(StatusCode code) {
    mock().refuse(Status::error(code, "scripted, not produced"));
    return true;
  }

  DeviceBench<MockJoystick> bench_{nullptr};
};

}  // namespace

int main() {
  return run_joystick_conformance(
      "mock joystick", []() -> std::unique_ptr<JoystickWorld> { return std::make_unique<MockWorld>(); });
}
