// Orders, and no order, move an arm that KeyboardRobot leads.
#include "hal/operator/keyboard/mock/mock_keyboard.hpp"
#include "tests/arm_orders.hpp"
#include "units/keyboard_robot/keyboard_robot.hpp"
#include "units/unit_bench.hpp"

namespace flexrf::keyboard_orders_test {
namespace {

using namespace flexrf::user;

/// Asked by keys: five presses of one, or of another.
class Leader {
 public:
  explicit Leader(RobotArm& arm) : arm_(&arm) {
    UnitBinding binding;
    binding.context = &bench_.context();
    binding.outputs = outputs_;
    binding.devices = devices_;
    bench_.unit().connect(binding);
    assert_true(bench_.unit().initialise().is_ok());
  }
  void step() {
    keyboard_.receive(arm_orders::cycle);
    bench_.step(arm_orders::cycle);
  }
  void permit(bool on) {
    bench_.tick().motion_inhibited = !on;
    if (on) bench_.tick().permitted_since = bench_.now() + std::chrono::microseconds(1);
  }
  void ask(bool otherwise) {
    for (int i = 0; i < 5; ++i)
      keyboard_.driver().press({Key::character, static_cast<std::uint32_t>(otherwise ? 'a' : 's')});
  }

 private:
  DeviceBench<MockKeyboard> keyboard_{nullptr};
  UnitBench<KeyboardRobot> bench_;
  SlotBench<Pose> pose_;
  SlotControl* outputs_[1] = {&pose_.control()};
  Device* keys_ = &keyboard_.driver();
  Device* arm_;
  Device* const* devices_[2] = {&keys_, &arm_};
};

// [robot-arm-12] [stop-3] [stop-96]
void no_order_moves_a_mock(void**) {
  arm_orders::no_order_moves_it<Leader, arm_orders::MockedArm, 3, 4>(1'000, 20'000);
}

// [stop-96]
void no_order_moves_a_melfa(void**) {
  arm_orders::no_order_moves_it<Leader, arm_orders::MelfaArm, 2, 4>(500, 5'000);
}

// [stop-96]
void no_order_moves_an_arm_of_drives(void**) {
  arm_orders::no_order_moves_it<Leader, arm_orders::ArmOfSimulatedDrives, 2, 4>(200, 2'000);
}

/// Such a key was kept, and moved the arm as soon as it was heard again.
// [stop-96]
void a_key_for_an_arm_that_is_silent_is_forgotten(void**) {
  using enum arm_orders::Event;
  for (const arm_orders::Event first : {start, stop}) {
    const arm_orders::Event order[] = {first, silent, target, start, idle, speaks};
    const OrderOutcome outcome = arm_orders::outcome_of<Leader, arm_orders::MockedArm>(order);
    assert_null(outcome.violation);
  }
}

}  // namespace
}  // namespace flexrf::keyboard_orders_test

int main() {
  using namespace flexrf::keyboard_orders_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_order_moves_a_mock),
      cmocka_unit_test(no_order_moves_a_melfa),
      cmocka_unit_test(no_order_moves_an_arm_of_drives),
      cmocka_unit_test(a_key_for_an_arm_that_is_silent_is_forgotten),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
