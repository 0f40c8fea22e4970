#include "hal/driver/device_bench.hpp"
#include "hal/gripper/conformance/gripper_conformance.hpp"
#include "hal/gripper/mock/mock_gripper.hpp"

namespace {

using namespace flexrf;

template <bool TwoState>
class MockWorld final : public GripperWorld {
 public:
  Status start(const GripperSetting& setting) override {
    configure_gripper(bench_.configuration(), setting);
    bench_.configuration().two_state = TwoState;
    return bench_.driver().initialise();
  }
  Gripper& gripper() override { return bench_.driver(); }
  void receive() override { bench_.receive(std::chrono::milliseconds(5)); }
  void send() override { bench_.send(); }
  Time now() const override { return bench_.now(); }
  double fingers() override { return bench_.driver().fingers().opening(); }

  bool put_object(double width) override {
    bench_.driver().fingers().put_object(width);
    return true;
  }
  bool put_around(double room) override {
    bench_.driver().fingers().put_around(room);
    return true;
  }
  bool take_away() override {
    bench_.driver().fingers().take_away();
    return true;
  }
  bool make(GripperFarEnd behaviour) override {
    using Fault = MockGripper::Fault;
    switch (behaviour) {
      case GripperFarEnd::well:
        return set(Fault::none);
      case GripperFarEnd::silent:
        return set(Fault::silent);
      case GripperFarEnd::off:
        return set(Fault::off);
      case GripperFarEnd::stuck:
        return set(Fault::stuck);
      case GripperFarEnd::tripped:
        return set(Fault::tripped);
      case GripperFarEnd::unplugged:
      case GripperFarEnd::damaged:
      case GripperFarEnd::switch_broken:
        break;
    }
    return false;
  }

 private:
  bool set(MockGripper::Fault fault) {
    bench_.driver().set_fault(fault);
    return true;
  }

  DeviceBench<MockGripper> bench_{nullptr};
};

}  // namespace

int main() {
  const int whole = run_gripper_conformance(
      "mock gripper", []() -> std::unique_ptr<GripperWorld> { return std::make_unique<MockWorld<false>>(); });
  const int two_state = run_gripper_conformance(
      "mock gripper of two states",
      []() -> std::unique_ptr<GripperWorld> { return std::make_unique<MockWorld<true>>(); });
  return whole + two_state;
}
