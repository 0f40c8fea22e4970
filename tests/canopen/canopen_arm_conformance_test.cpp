// The real driver of an arm of drives, its messages on a simulated bus, and six simulated drives.
#include <array>
#include <cmath>
#include <optional>

#include "hal/interfaces/device_bench.hpp"
#include "hal/interfaces/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/linux/canopen_arm/canopen_arm.hpp"
#include "hal/simulated/in_process_can_bus/in_process_can_bus.hpp"
#include "hal/simulated/simulated_cia402_drive/drive_on_can.hpp"
#include "six_axis.hpp"

namespace {

using namespace flexrf;

class CanopenArmWorld final : public RobotArmWorld {
 public:
  CanopenArmWorld() {
    auto& configuration = arm_.configuration();
    configuration.vendor = 0x123;
    configuration.quick_stop_deceleration = 60;
    initialised_ = bus_.driver().initialise().is_ok();
    for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
      const auto node = static_cast<std::uint8_t>(11 + i);
      configuration.nodes[i] = node;
      // Every other one counts the other way.
      configuration.increments_per_unit[i] = i % 2 == 0 ? increments : -increments;
      far_ends_[i].emplace(
          SimulatedCia402Drive::Options{
              .node = node,
              .fastest = 20 * increments,
              .first_position = std::round(six_axis.joints[i].home * configuration.increments_per_unit[i])},
          bus_.now());
      initialised_ = initialised_ && bus_.driver().wire()->attach(*far_ends_[i]) != nullptr;
    }
    initialised_ = initialised_ && arm_.driver().initialise().is_ok();
    for (int i = 0; i < 1000 && initialised_ && !arm_.driver().is_ready(); ++i) {
      receive(std::chrono::milliseconds(7));
      send();
    }
  }
  ~CanopenArmWorld() override {
    arm_.driver().stop();
    for (auto& far_end : far_ends_) bus_.driver().wire()->detach(*far_end);
    bus_.driver().stop();
  }

  RobotArm& arm() override { return arm_.driver(); }
  void receive(Duration elapsed) override {
    bus_.receive(elapsed);
    arm_.receive(elapsed);
  }
  void send() override {
    arm_.send();
    bus_.send();
  }
  double noise() const override { return 1 / increments; }
  bool lose_sensors() override {
    far_ends_[4]->drive().power_off();
    return initialised_;
  }
  bool trip_drives() override {
    far_ends_[4]->drive().trip(0x2310, false, far_ends_[4]->said());
    return initialised_;
  }

 private:
  static constexpr double increments = 100'000;

  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<CanopenArm> arm_{&six_axis, {}, &bus_.driver()};
  std::array<std::optional<DriveOnCan>, six_axis.joint_count> far_ends_;
  bool initialised_ = false;
};

}  // namespace

int main() {
  return run_robot_arm_conformance("arm of CANopen drives", []() -> std::unique_ptr<RobotArmWorld> {
    return std::make_unique<CanopenArmWorld>();
  });
}
