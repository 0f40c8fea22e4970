// The real driver and a simulated controller that meet at a UDP port of this machine only, and are both led
// by a test.
#pragma once

#include <string>
#include <string_view>

#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/melfa_mxt/melfa_mxt.hpp"
#include "six_axis.hpp"

namespace flexrf {

class MelfaWorld {
 public:
  MelfaWorld() = default;
  virtual ~MelfaWorld() = default;
  MelfaWorld(const MelfaWorld&) = delete;
  MelfaWorld& operator=(const MelfaWorld&) = delete;

  bool initialised() const { return initialised_; }
  MelfaMxt& arm() { return bench_.driver(); }
  const auto& feedback() { return bench_.feedback(); }
  /// The driver's clock.
  Time now() const { return bench_.now(); }

  /// Of the controller.
  virtual std::uint16_t port() const = 0;
  /// Its answer (mxt_console.hpp).
  virtual std::string ask(std::string_view line) = 0;
  bool tell(std::string_view line) { return ask(line) == "ok"; }

  /// The next cycle begins: the answer to what was sent before is there, or does not come.
  virtual void receive() = 0;
  void send() { bench_.send(); }
  /// What was sent has arrived at the far end.
  virtual void await_far_end() = 0;

  /// Cycles without a command.
  void idle(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      receive();
      send();
    }
  }
  void command(const JointAngles& to, int cycles) {
    JointPositions wanted{};
    wanted.position = to;
    for (int i = 0; i < cycles; ++i) {
      receive();
      lead_from_here(arm());
      arm().command(wanted);
      send();
    }
  }
  /// As a person restarts a unit with its arm.
  bool restart() {
    arm().stop();
    // It may say its end several times while nobody answers, and be gone before it is heard.
    await_far_end();
    begin_to_count_anew();
    arm().clear_fault();
    return arm().initialise().is_ok();
  }
  bool begin_leading() {
    for (int i = 0; i < 100 && !arm().is_ready(); ++i) idle(1);
    return arm().is_ready();
  }

 protected:
  /// When the controller is at its port.
  void initialise_arm(double cycle) {
    auto& set = bench_.configuration();
    set.set_address("127.0.0.1");
    set.port = port();
    set.cycle = cycle;
    initialised_ = arm().initialise().is_ok();
  }
  DeviceBench<MelfaMxt>& bench() { return bench_; }
  /// The driver's counters are at 0 from now on.
  virtual void begin_to_count_anew() {}

 private:
  DeviceBench<MelfaMxt> bench_{&six_axis};
  bool initialised_ = false;
};

/// As the conformance suite of arms wants it.
template <class World>
class MelfaConformanceWorld final : public RobotArmWorld {
 public:
  MelfaConformanceWorld() { world_.begin_leading(); }
  RobotArm& arm() override { return world_.arm(); }
  void receive(Duration /*elapsed*/) override { world_.receive(); }
  void send() override { world_.send(); }
  double noise() const override { return 1e-6; }  // single precision
  bool lose_sensors() override { return world_.initialised() && world_.tell("silence"); }

 private:
  World world_;
};

}  // namespace flexrf
