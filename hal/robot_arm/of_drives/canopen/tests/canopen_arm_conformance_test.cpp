// The real driver of an arm of drives, its messages on a simulated bus, and six simulated drives.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/of_drives/canopen/canopen_arm.hpp"
#include "hal/servo_drive/canopen/simulator/drive_on_can.hpp"
#include "six_axis.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

using Odd = void (*)(DriveObjects& drive, CanopenArm::Configuration& arm);

class CanopenArmWorld final : public RobotArmWorld {
 public:
  /// `odd`: what is special about its drives, and what is said of them.
  explicit CanopenArmWorld(Odd odd = nullptr) {
    auto& configuration = arm_.configuration();
    configuration.vendor = 0x123;
    configuration.quick_stop_deceleration.fill(60);
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
      if (odd != nullptr) odd(far_ends_[i]->drive().objects(), configuration);
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

  bool is_ready() { return initialised_ && arm_.driver().is_ready(); }
  RobotArm& arm() override { return arm_.driver(); }
  void receive(Duration elapsed) override {
    bus_.receive(elapsed);
    arm_.receive(elapsed);
  }
  void send() override {
    arm_.send();
    bus_.send();
  }
  /// What the drive of this joint was told, in its units.
  double told(std::size_t joint, canopen::ObjectAddress object) {
    return static_cast<double>(far_ends_[joint]->drive().objects().get(object)) / increments;
  }
  double noise() const override { return 1 / increments; }
  bool lose_sensors() override {
    far_ends_[4]->drive().power_off();
    return initialised_;
  }
  bool stick_joint() override {
    far_ends_[0]->drive().cut_motor(true);
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

bool comes_up(Odd odd) {
  CanopenArmWorld world{odd};
  if (!world.is_ready()) std::printf("%s\n", world.arm().fault().cause());
  return world.is_ready();
}

// In its own unit of measure, rad or m.
bool each_joint_has_its_own_speeds() {
  namespace axis = canopen::cia402::objects;
  CanopenArmWorld world{[](DriveObjects&, CanopenArm::Configuration& arm) {
    for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
      const double factor = static_cast<double>(i + 1);
      arm.homing_methods[i] = 35;
      arm.homing_speed[i] = 0.1 * factor;
      arm.homing_creep_speed[i] = 0.02 * factor;
      arm.quick_stop_deceleration[i] = 10 * factor;
    }
  }};
  bool good = true;
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
    const double factor = static_cast<double>(i + 1);
    good = good && std::abs(world.told(i, axis::homing_search_speed) - 0.1 * factor) < 1e-6 &&
           std::abs(world.told(i, axis::homing_creep_speed) - 0.02 * factor) < 1e-6 &&
           std::abs(world.told(i, axis::quick_stop_deceleration) - 10 * factor) < 1e-6;
  }
  return good;
}

void speeds_of_each_joint(void**) {
  const bool good = each_joint_has_its_own_speeds();
  assert_true(good);
}

void drives_that_lack_what_others_have(void**) {
  namespace axis = canopen::cia402::objects;
  const bool unsaid =
      comes_up([](DriveObjects& drive, CanopenArm::Configuration&) { drive.lack(axis::period_value); });
  assert_false(unsaid);
  const bool said = comes_up([](DriveObjects& drive, CanopenArm::Configuration& arm) {
    drive.lack(axis::period_value);
    drive.lack(axis::abort_connection);
    drive.lack(canopen::objects::producer_heartbeat);
    drive.lack(canopen::objects::consumer_heartbeat);
    drive.unmap(axis::mode);
    drive.unmap(axis::mode_display);
    drive.refuse_bit_30();
    arm.tells_period = arm.tells_abort_connection = arm.supervises_us = false;
    arm.maps_mode = arm.forbids_remote = false;
    arm.guarded = true;
  });
  assert_true(said);
}

// What the drive's table says is said of an arm's drives too, but for what its chain says, one for each
// joint, and what is of other modes.
void columns_of_a_drive(void**) {
  constexpr std::string_view elsewhere[] = {
      "mode",
      "lowest",
      "highest",
      "endless",
      "modulo",
      "fastest",
      "acceleration",
      "node",
      "increments_per_unit",
      "homing_method",
      "set_point_timeout",
      "changes_target_at_once",
      "maps_speed",
      "tells_speed",
  };
  const auto fields = descriptor_of<CanopenArm::Configuration>->fields;
  for (const FieldDescriptor& wanted : descriptor_of<CanopenServoDrive::Configuration>->fields) {
    if (std::find(std::begin(elsewhere), std::end(elsewhere), wanted.name) != std::end(elsewhere)) continue;
    const bool there = std::any_of(fields.begin(), fields.end(), [&](const FieldDescriptor& have) {
      // One for all joints, or one for each.
      return std::string_view(have.name) == wanted.name && have.scalar == wanted.scalar &&
             (have.count == wanted.count || have.count == wanted.count * max_joints);
    });
    if (!there) std::printf("an arm has no column %s\n", wanted.name);
    assert_true(there);
  }
}

int run_columns() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(columns_of_a_drive),
      cmocka_unit_test(drives_that_lack_what_others_have),
      cmocka_unit_test(speeds_of_each_joint),
  };
  return cmocka_run_group_tests_name("columns of an arm of CANopen drives", tests, nullptr, nullptr);
}

}  // namespace

int main() {
  const int failed = run_robot_arm_conformance(
      "arm of CANopen drives",
      []() -> std::unique_ptr<RobotArmWorld> { return std::make_unique<CanopenArmWorld>(); });
  return failed + run_columns() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
