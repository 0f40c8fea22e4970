#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/simulated_melfa/simulated_melfa.hpp"
#include "six_axis.hpp"

namespace {

using namespace flexrf;

class SimulatedMelfaWorld final : public RobotArmWorld {
 public:
  SimulatedMelfaWorld() {
    bench_.configuration().cycle = 0.007;  // as the suite's
    initialised_ = bench_.driver().initialise().is_ok();
    for (int i = 0; i < 100 && initialised_ && !bench_.driver().is_ready(); ++i) {
      receive(std::chrono::milliseconds(7));
      send();
    }
  }
  ~SimulatedMelfaWorld() override { bench_.driver().stop(); }

  RobotArm& arm() override { return bench_.driver(); }
  void receive(Duration elapsed) override { bench_.receive(elapsed); }
  void send() override { bench_.send(); }
  double noise() const override { return 1e-6; }  // single precision
  bool lose_sensors() override {
    bench_.driver().far_end().set_silent(true);
    return initialised_;
  }

 private:
  DeviceBench<SimulatedMelfa> bench_{&six_axis};
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_robot_arm_conformance("simulated MELFA arm", []() -> std::unique_ptr<RobotArmWorld> {
    return std::make_unique<SimulatedMelfaWorld>();
  });
}
