// Whatever happens to an arm, in whatever order: it goes nowhere that nobody has asked for since the last
// Start.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/mock/mock_arm.hpp"
#include "hal/robot_arm/of_drives/simulated/simulated_drive_arm.hpp"
#include "hal/robot_arm/simulated_melfa/simulated_melfa.hpp"
#include "motion/pose_conversion.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"
#include "units/robot_control/robot_control.hpp"
#include "units/unit_bench.hpp"

namespace flexrf::robot_orders_test {
namespace {

using namespace flexrf::user;

constexpr Duration cycle = std::chrono::milliseconds(7);

enum class Event : std::uint8_t { stop, start, silent, speaks, by_hand, target, stream, idle, count };
constexpr std::array<const char*, static_cast<std::size_t>(Event::count)> names{
    "stop", "start", "silent", "speaks", "by hand", "target", "stream", "idle"};

/// An arm, and what a person does to it beside giving Stop and Start.
class Arm {
 public:
  virtual ~Arm() = default;
  virtual RobotArm& arm() = 0;
  virtual void receive() = 0;
  virtual void send() = 0;
  /// It says nothing, or speaks again: its cable, or its power.
  virtual void be_silent(bool on) = 0;
  /// Somebody moves it by more than `far`, who could not if it resisted.
  virtual void be_moved() = 0;
  /// Cycles until it has done something or other.
  virtual int patience() const = 0;
  /// Farther than it goes while it stops, rad.
  virtual double far() const = 0;
};

class MockedArm final : public Arm {
 public:
  MockedArm() { assert_true(bench_.driver().initialise().is_ok()); }
  RobotArm& arm() override { return bench_.driver(); }
  void receive() override {
    bench_.receive(cycle);
    if (const auto state = bench_.driver().state()) at_ = *state;
  }
  void send() override { bench_.send(); }
  void be_silent(bool on) override {
    is_silent_ = on;
    bench_.driver().set_state(on ? std::nullopt : std::optional(at_));
  }
  void be_moved() override {
    if (bench_.driver().commanded()) return;
    at_.position[1] += at_.position[1] > 0.2 ? -0.4 : 0.4;
    be_silent(is_silent_);
  }
  int patience() const override { return 3; }
  double far() const override { return 1e-6; }

 private:
  DeviceBench<MockArm> bench_{&six_axis};
  JointState at_{};
  bool is_silent_ = false;
};

class MelfaArm final : public Arm {
 public:
  MelfaArm() { assert_true(bench_.driver().initialise().is_ok()); }
  RobotArm& arm() override { return bench_.driver(); }
  void receive() override { bench_.receive(cycle); }
  void send() override { bench_.send(); }
  void be_silent(bool on) override { bench_.driver().far_end().set_silent(on); }
  void be_moved() override {
    if (bench_.driver().far_end().controller().is_in_session()) return;
    way_ = -way_;
    bench_.driver().far_end().controller().be_led(way_);
  }
  int patience() const override { return 40; }
  double far() const override { return 0.05; }

 private:
  DeviceBench<SimulatedMelfa> bench_{&six_axis};
  double way_ = 0.2;
};

class ArmOfSimulatedDrives final : public Arm {
 public:
  ArmOfSimulatedDrives() {
    bench_.configuration().increments_per_unit.fill(100'000);
    bench_.configuration().homing_methods[5] = 35;  // at home where it is
    assert_true(bus_.driver().initialise().is_ok() && bench_.driver().initialise().is_ok());
  }
  ~ArmOfSimulatedDrives() override {
    bench_.driver().stop();
    bus_.driver().stop();
  }
  RobotArm& arm() override { return bench_.driver(); }
  void receive() override {
    bus_.receive(cycle);
    bench_.receive(cycle);
  }
  void send() override {
    bench_.send();
    bus_.send();
  }
  void be_silent(bool on) override {
    SimulatedCia402Drive& drive = bench_.driver().drive(1).far_end().drive();
    if (on) drive.power_off();
    if (!on && is_off_) drive.power_on(bench_.now());
    is_off_ = on;
  }
  void be_moved() override {
    way_ = -way_;
    bench_.driver().drive(1).far_end().drive().be_moved(way_);
  }
  int patience() const override { return 60; }
  double far() const override { return 0.05; }

 private:
  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<SimulatedDriveArm> bench_{&six_axis, {}, &bus_.driver()};
  double way_ = 20'000;
  bool is_off_ = false;
};

/// The unit, one of these arms, and what a person does to both.
struct World {
  std::unique_ptr<Arm> held;
  RobotArm& arm;
  UnitBench<RobotControl> bench;
  SlotBench<Pose> target;
  SlotBench<ServoTarget> servo;
  SlotBench<Pose> pose;
  SlotBench<JointState> joints;
  SlotBench<TargetAnswer> answer;
  SlotBench<RobotLead> led_by;
  InputBinding inputs[5] = {target.input(std::chrono::milliseconds(500)), {}, {}, {}, servo.input()};
  SlotControl* outputs[4] = {&pose.control(), &joints.control(), &answer.control(), &led_by.control()};
  Device* device = &arm;
  Device* const* devices[1] = {&device};
  std::optional<JointState> since;  // where it was at the last Start, or was moved to
  bool may_move = false;
  bool is_wanted = false;  // somebody has asked for a motion since the last Start
  const char* violation = nullptr;
  int moved_as_asked = 0;

  explicit World(std::unique_ptr<Arm> which) : held(std::move(which)), arm(held->arm()) {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.devices = devices;
    bench.unit().connect(binding);
    assert_true(bench.unit().initialise().is_ok());
    permit(false);
    run(held->patience());
  }

  void permit(bool on) {
    may_move = on;
    arm.set_inhibited(!on);
    bench.tick().motion_inhibited = !on;
  }

  void happens(Event event) {
    switch (event) {
      case Event::stop:
        permit(false);
        is_wanted = false;
        since.reset();
        break;
      case Event::start:
        // Control refuses it until the thread had a cycle without.
        permit(false);
        run(1);
        permit(true);
        is_wanted = false;
        since = arm.state();
        break;
      case Event::silent:
        held->be_silent(true);
        break;
      case Event::speaks:
        held->be_silent(false);
        break;
      case Event::by_hand:
        held->be_moved();
        since.reset();
        // Where it is now is told in the next cycles, unless it is silent.
        run_unwatched(2);
        break;
      case Event::target: {
        Pose wanted = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
        wanted.position[2] -= 0.05;
        target.publish(wanted, bench.now());
        is_wanted = is_wanted || may_move;
        break;
      }
      case Event::stream: {
        ServoTarget wanted{};
        wanted.valid = true;
        wanted.pose = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
        wanted.pose.position[0] += 0.03;
        servo.publish(wanted, bench.now());
        is_wanted = is_wanted || may_move;
        break;
      }
      default:
        break;
    }
    run(held->patience());
  }

  void run_unwatched(int cycles) {
    for (int n = 0; n < cycles; ++n) {
      held->receive();
      bench.step(cycle);
      held->send();
    }
  }
  void run(int cycles) {
    for (int n = 0; n < cycles; ++n) {
      run_unwatched(1);
      look();
    }
  }

  void look() {
    const auto state = arm.state();
    if (!state) return;
    if (!since) since = state;
    double moved = 0;
    for (std::size_t i = 0; i < six_axis.joint_count; ++i)
      moved = std::max(moved, std::abs(state->position[i] - since->position[i]));
    if (moved <= held->far()) return;
    if (is_wanted) {
      ++moved_as_asked;
    } else {
      violation = may_move ? "it moved where nobody had asked it to since the last Start"
                           : "it moved without the permission";
    }
  }
};

template <class Which>
int tries(std::span<const Event> order) {
  World world(std::make_unique<Which>());
  // It has led its arm somewhere already.
  for (const Event event : {Event::start, Event::target, Event::idle, Event::idle}) world.happens(event);
  for (const Event event : order) world.happens(event);
  world.run(2 * world.held->patience());
  if (world.violation == nullptr) return world.moved_as_asked;
  std::string text;
  for (const Event event : order)
    text += std::string{text.empty() ? "" : ", "} + names[static_cast<std::size_t>(event)];
  fail_msg("%s: %s", text.c_str(), world.violation);
  return 0;
}

template <class Which, std::size_t Length>
void tries_all_orders() {
  std::array<Event, Length> order{};
  std::size_t count = 1;
  for (std::size_t i = 0; i < Length; ++i) count *= static_cast<std::size_t>(Event::count);
  int moved = 0;
  for (std::size_t number = 0; number < count; ++number) {
    std::size_t rest = number;
    for (Event& event : order) {
      event = static_cast<Event>(rest % static_cast<std::size_t>(Event::count));
      rest /= static_cast<std::size_t>(Event::count);
    }
    moved += tries<Which>(order);
  }
  assert_true(moved > 0);  // an arm that never moves proves nothing
}

bool is_long() {
  return std::getenv("FLEXRF_LONG") != nullptr;
}

/// An arm that was moved by hand while nobody heard it, and speaks again after Start.
// [stop-96]
void one_that_speaks_after_start_stays(void**) {
  constexpr Event order[] = {Event::stop,  Event::silent, Event::by_hand,
                             Event::start, Event::speaks, Event::idle};
  tries<MockedArm>(order);
  tries<MelfaArm>(order);
  tries<ArmOfSimulatedDrives>(order);
}

// [robot-arm-12] [stop-3] [stop-96]
void no_order_of_four_moves_a_mock(void**) {
  tries_all_orders<MockedArm, 4>();
}

// [stop-96]
void no_order_moves_a_melfa(void**) {
  tries_all_orders<MelfaArm, 2>();
  if (is_long()) tries_all_orders<MelfaArm, 4>();
}

// [stop-96]
void no_order_moves_an_arm_of_drives(void**) {
  tries_all_orders<ArmOfSimulatedDrives, 2>();
  if (is_long()) tries_all_orders<ArmOfSimulatedDrives, 4>();
}

void no_longer_order_moves_a_mock(void**) {
  const int count = is_long() ? 20'000 : 500;
  std::mt19937 random{32};
  for (int n = 0; n < count; ++n) {
    std::array<Event, 6> order{};
    for (Event& event : order) event = static_cast<Event>(random() % static_cast<unsigned>(Event::count));
    tries<MockedArm>(std::span(order).first(5 + static_cast<std::size_t>(n) % 2));
  }
}

}  // namespace
}  // namespace flexrf::robot_orders_test

int main() {
  using namespace flexrf::robot_orders_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_that_speaks_after_start_stays),
      cmocka_unit_test(no_order_of_four_moves_a_mock),
      cmocka_unit_test(no_order_moves_a_melfa),
      cmocka_unit_test(no_order_moves_an_arm_of_drives),
      cmocka_unit_test(no_longer_order_moves_a_mock),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
