#include "hal/driver/device_bench.hpp"
#include "hal/gripper/conformance/gripper_conformance.hpp"
#include "hal/gripper/scene/scene_gripper.hpp"

namespace {

using namespace flexrf;

// No scene is connected: what its fingers meet a test puts there.
class SceneGripperWorld final : public GripperWorld {
 public:
  Status start(const GripperSetting& setting) override {
    configure_gripper(bench_.configuration(), setting);
    return bench_.driver().initialise();
  }
  Gripper& gripper() override { return bench_.driver(); }
  void receive() override { bench_.receive(std::chrono::milliseconds(7)); }
  void send() override { bench_.send(); }
  Time now() const override { return bench_.now(); }
  double fingers() override { return model().opening(); }

  bool put_object(double width) override {
    meet_width(model(), width);
    return true;
  }
  bool put_around(double room) override {
    model().put_around(room);
    return true;
  }
  bool take_away() override {
    meet_width(model(), 0);
    return true;
  }
  bool make(GripperFarEnd behaviour) override {
    using Fault = FingerControl::Fault;
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
  FingerModel& model() { return bench_.driver().control().fingers(); }
  bool set(FingerControl::Fault fault) {
    bench_.driver().control().set_fault(fault);
    return true;
  }

  DeviceBench<SceneGripper> bench_{nullptr};
};

}  // namespace

int main() {
  return run_gripper_conformance("scene gripper", []() -> std::unique_ptr<GripperWorld> {
    return std::make_unique<SceneGripperWorld>();
  });
}
