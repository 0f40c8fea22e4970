// Orders, and no order, move an arm that RobotControl leads.
#include "motion/pose_conversion.hpp"
#include "tests/arm_orders.hpp"
#include "units/robot_control/robot_control.hpp"
#include "units/unit_bench.hpp"

namespace flexrf::robot_orders_test {
namespace {

using namespace flexrf::user;
using arm_orders::ArmOfSimulatedDrives;
using arm_orders::Event;
using arm_orders::MelfaArm;
using arm_orders::MockedArm;

/// Asked by a target, or by a stream of poses.
class Leader {
 public:
  explicit Leader(RobotArm& arm) : device_(&arm) {
    UnitBinding binding;
    binding.context = &bench_.context();
    binding.inputs = inputs_;
    binding.outputs = outputs_;
    binding.devices = devices_;
    bench_.unit().connect(binding);
    assert_true(bench_.unit().initialise().is_ok());
  }
  void step() { bench_.step(arm_orders::cycle); }
  void permit(bool on) {
    bench_.tick().motion_inhibited = !on;
    if (on) bench_.tick().permitted_since = bench_.now() + std::chrono::microseconds(1);
  }
  void ask(bool by_stream) {
    Pose wanted = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
    if (by_stream) {
      wanted.position[0] += 0.03;
      servo_.publish(ServoTarget{.valid = true, .pose = wanted}, bench_.now());
    } else {
      way_ = 0.07 - way_;  // another one than before, which would not be followed twice
      wanted.position[2] -= way_;
      target_.publish(wanted, bench_.now());
    }
  }

 private:
  UnitBench<RobotControl> bench_;
  SlotBench<Pose> target_;
  SlotBench<ServoTarget> servo_;
  SlotBench<Pose> pose_;
  SlotBench<JointState> joints_;
  SlotBench<TargetAnswer> answer_;
  SlotBench<RobotLead> led_by_;
  InputBinding inputs_[5] = {target_.input(std::chrono::milliseconds(500)), {}, {}, {}, servo_.input()};
  SlotControl* outputs_[4] = {&pose_.control(), &joints_.control(), &answer_.control(), &led_by_.control()};
  Device* device_;
  Device* const* devices_[1] = {&device_};
  double way_ = 0.02;
};

/// An arm that was moved by hand while nobody heard it, and speaks again after Start.
// [stop-96]
void one_that_speaks_after_start_stays(void**) {
  constexpr Event order[] = {Event::stop,  Event::silent, Event::by_hand,
                             Event::start, Event::speaks, Event::idle};
  assert_null((arm_orders::outcome_of<Leader, MockedArm>(order).violation));
  assert_null((arm_orders::outcome_of<Leader, MelfaArm>(order).violation));
  assert_null((arm_orders::outcome_of<Leader, ArmOfSimulatedDrives>(order).violation));
}

// [robot-arm-12] [stop-3] [stop-96]
void no_order_moves_a_mock(void**) {
  arm_orders::no_order_moves_it<Leader, MockedArm, 4, 4>(1'000, 20'000);
}

// [stop-96]
void no_order_moves_a_melfa(void**) {
  arm_orders::no_order_moves_it<Leader, MelfaArm, 2, 4>(500, 5'000);
}

// [stop-96]
void no_order_moves_an_arm_of_drives(void**) {
  arm_orders::no_order_moves_it<Leader, ArmOfSimulatedDrives, 2, 4>(200, 2'000);
}

}  // namespace
}  // namespace flexrf::robot_orders_test

int main() {
  using namespace flexrf::robot_orders_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_that_speaks_after_start_stays),
      cmocka_unit_test(no_order_moves_a_mock),
      cmocka_unit_test(no_order_moves_a_melfa),
      cmocka_unit_test(no_order_moves_an_arm_of_drives),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
