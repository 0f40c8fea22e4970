// A scene and its gripper, connected as in a cell: each sees of the other what it told in the cycle before.
#include <algorithm>
#include <cmath>

#include "hal/driver/device_bench.hpp"
#include "hal/gripper/scene/scene_gripper.hpp"
#include "hal/scene/tabletop/tabletop_scene.hpp"
#include "motion/kinematics.hpp"
#include "runtime/blackboard/slot.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr Duration cycle = std::chrono::milliseconds(7);
constexpr double half_turn = 3.14159265358979323846;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

class GripCell {
 public:
  GripCell() { joints_.connect(&context_, &joints_slot_.control()); }

  bool start() {
    gripper_.configuration().activation = 0;
    return scene_.driver().initialise().is_ok() && gripper_.driver().initialise().is_ok();
  }
  SceneGripper& gripper() { return gripper_.driver(); }
  const TabletopSceneFeedback& told() { return scene_.feedback(); }
  const SceneState& state() { return scene_.driver().state(); }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) {
      gripper_.receive(cycle);
      gripper_.send();
      scene_.receive(cycle);
      scene_.send();
    }
  }
  void lay_table() {
    scene_.runtime().lay_table = 1;
    cycles(1);
    scene_.runtime().lay_table = 0;
  }
  bool move_hand(double x, double y, double tips, double turn) {
    Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
    target.linear() =
        turn_about(Eigen::Vector3d::UnitZ(), turn) * turn_about(Eigen::Vector3d::UnitX(), half_turn);
    target.translation() = Eigen::Vector3d(x, y, tips + 0.16);
    const InverseResult found = inverse_kinematics(six_axis, target, seed_);
    if (found.outcome != InverseOutcome::converged) return false;
    seed_ = found.joints;
    JointState joints{};
    joints.position_map() = found.joints;
    return joints_.publish(joints, scene_.now());
  }

 private:
  DeviceBinding scene_binding() {
    DeviceBinding binding;
    binding.inputs = scene_inputs_;
    binding.outputs = scene_outputs_;
    binding.resources = resources_;
    return binding;
  }
  DeviceBinding gripper_binding() {
    DeviceBinding binding;
    binding.inputs = gripper_inputs_;
    binding.outputs = gripper_outputs_;
    return binding;
  }

  Slot<JointState, 1> joints_slot_;
  Slot<SceneFingers, 1> fingers_slot_;
  Slot<SceneState, 1> scene_slot_;
  SlotReader readers_[3] = {SlotReader(&joints_slot_.control()), SlotReader(&fingers_slot_.control()),
                            SlotReader(&scene_slot_.control())};
  InputBinding scene_inputs_[2] = {InputBinding{&readers_[0], 1, {}, nullptr},
                                   InputBinding{&readers_[1], 1, {}, nullptr}};
  InputBinding gripper_inputs_[1] = {InputBinding{&readers_[2], 1, {}, nullptr}};
  SlotControl* scene_outputs_[2] = {&scene_slot_.control(), nullptr};
  SlotControl* gripper_outputs_[1] = {&fingers_slot_.control()};
  const void* resources_[1] = {&six_axis};
  DeviceBench<TabletopScene> scene_{scene_binding()};
  DeviceBench<SceneGripper> gripper_{gripper_binding()};
  StepContext context_;
  Output<JointState> joints_;
  JointVector seed_ = home_position(six_axis);
};

/// A block that the arm reaches well; it may lie beside others.
const SceneBody* reachable_block(const SceneState& state) {
  const auto found = std::find_if(state.parts.begin(), state.parts.end(), [](const SceneBody& part) {
    return part.kind == SceneKind::block && part.position[0] > 0.42;
  });
  return found == state.parts.end() ? nullptr : &*found;
}

// By 4 degrees askew and 2 mm beside: it is turned and pushed until it lies flush, and the gripper says so.
bool a_part_is_gripped_lifted_and_dropped() {
  GripCell cell;
  if (!cell.start()) return false;
  const SceneBody* const block = reachable_block(cell.state());
  if (block == nullptr) return false;
  const double x = block->position[0];
  const double y = block->position[1];
  const double turn = block->angle + 0.07;
  cell.cycles(1);
  cell.gripper().command({.opening = 0.05});
  if (!cell.move_hand(x, y + 0.002, 0.1, turn)) return false;
  cell.cycles(200);
  for (int i = 1; i <= 97; ++i) {
    if (!cell.move_hand(x, y + 0.002, 0.1 - 0.001 * i, turn)) return false;
    cell.cycles(1);
  }
  cell.gripper().close();
  cell.cycles(300);
  const auto gripped = cell.gripper().state();
  if (gripped->object != GripperObject::gripped || std::abs(*gripped->opening - 0.03) > 5e-4 ||
      cell.told().held_part == 0)
    return false;
  for (int i = 1; i <= 97; ++i) {
    if (!cell.move_hand(x, y + 0.002, 0.003 + 0.001 * i, turn)) return false;
    cell.cycles(1);
  }
  if (std::abs(block->position[2] - 0.097) > 1e-3 || cell.gripper().state()->object != GripperObject::gripped)
    return false;
  cell.gripper().open();
  cell.cycles(300);
  return cell.told().held_part == 0 && block->position[2] < 0.03 &&
         cell.gripper().state()->object == GripperObject::none;
}

bool what_disappears_is_lost() {
  GripCell cell;
  if (!cell.start()) return false;
  const SceneBody* const block = reachable_block(cell.state());
  if (block == nullptr) return false;
  cell.cycles(1);
  cell.gripper().command({.opening = 0.05});
  if (!cell.move_hand(block->position[0], block->position[1], 0.1, block->angle)) return false;
  cell.cycles(200);
  for (int i = 1; i <= 97; ++i) {
    if (!cell.move_hand(block->position[0], block->position[1], 0.1 - 0.001 * i, block->angle)) return false;
    cell.cycles(1);
  }
  cell.gripper().close();
  cell.cycles(300);
  if (cell.told().held_part == 0) return false;
  // Away from all parts, and laid anew.
  for (int i = 1; i <= 100; ++i) {
    if (!cell.move_hand(0.7, 0, 0.2, 0)) return false;
    cell.cycles(1);
  }
  cell.lay_table();
  cell.cycles(300);
  return cell.told().held_part == 0 && cell.gripper().state()->object == GripperObject::lost;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<a_part_is_gripped_lifted_and_dropped>),
      cmocka_unit_test(judged<what_disappears_is_lost>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
