#include "hal/interfaces/robot_arm/conformance/robot_arm_conformance.hpp"
#include "tests/melfa/melfa_world.hpp"

namespace {

using namespace flexrf;

class LoopbackWorld final : public RobotArmWorld {
 public:
  LoopbackWorld() { world_.begin_leading(); }
  RobotArm& arm() override { return world_.arm(); }
  void receive(Duration elapsed) override { world_.receive(elapsed); }
  void send() override { world_.send(); }
  double noise() const override { return 1e-6; }  // single precision
  bool lose_sensors() override {
    world_.with([](melfa::MxtWire& wire) { wire.set_silent(true); });
    return world_.initialised();
  }

 private:
  MelfaWorld world_;
};

}  // namespace

int main() {
  return run_robot_arm_conformance("MELFA arm over UDP", []() -> std::unique_ptr<RobotArmWorld> {
    return std::make_unique<LoopbackWorld>();
  });
}
