#include "hal/scene/tabletop/tabletop_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "hal/driver/device_bench.hpp"
#include "motion/kinematics.hpp"
#include "runtime/blackboard/slot.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr Duration cycle = std::chrono::milliseconds(7);

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

/// A scene, and slots in which a test says where arm and fingers are.
class SceneCell {
 public:
  SceneCell() {
    joints_.connect(&context_, &joints_slot_.control());
    fingers_.connect(&context_, &fingers_slot_.control());
  }

  DeviceBench<TabletopScene>& bench() { return bench_; }
  TabletopScene& scene() { return bench_.driver(); }
  const TabletopSceneFeedback& told() { return bench_.feedback(); }
  const SceneState& state() { return scene().state(); }

  void cycles(int count = 1) {
    for (int i = 0; i < count; ++i) {
      bench_.receive(cycle);
      bench_.send();
      // As the executive does: a press counts in one cycle.
      auto& runtime = bench_.runtime();
      runtime.push_part = runtime.add_obstacle = runtime.remove_obstacles = runtime.lay_table = 0;
    }
  }
  /// Downwards, over a place; its fingers close along y turned by `turn`. False: out of the arm's reach.
  bool move_hand(double x, double y, double tips, double turn) {
    Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
    target.linear() = turn_about(Eigen::Vector3d::UnitZ(), turn) *
                      turn_about(Eigen::Vector3d::UnitX(), 3.14159265358979323846);
    target.translation() = Eigen::Vector3d(x, y, tips + 0.16);
    const InverseResult found = inverse_kinematics(six_axis, target, seed_);
    if (found.outcome != InverseOutcome::converged) return false;
    seed_ = found.joints;
    JointState joints{};
    joints.position_map() = found.joints;
    return joints_.publish(joints, bench_.now());
  }
  void open_to(double opening) {
    SceneFingers fingers{};
    fingers.opening = opening;
    fingers_.publish(fingers, bench_.now());
  }
  SlotControl& scene_slot() { return scene_slot_.control(); }
  SlotControl& arm_slot() { return arm_slot_.control(); }

 private:
  DeviceBinding binding() {
    DeviceBinding binding;
    binding.inputs = inputs_;
    binding.outputs = outputs_;
    binding.resources = resources_;
    return binding;
  }

  Slot<JointState, 1> joints_slot_;
  Slot<SceneFingers, 1> fingers_slot_;
  Slot<SceneState, 1> scene_slot_;
  Slot<SceneArm, 1> arm_slot_;
  SlotReader readers_[2] = {SlotReader(&joints_slot_.control()), SlotReader(&fingers_slot_.control())};
  InputBinding inputs_[2] = {InputBinding{&readers_[0], 1, {}, nullptr},
                             InputBinding{&readers_[1], 1, {}, nullptr}};
  SlotControl* outputs_[2] = {&scene_slot_.control(), &arm_slot_.control()};
  const void* resources_[1] = {&six_axis};
  DeviceBench<TabletopScene> bench_{binding()};
  StepContext context_;
  Output<JointState> joints_;
  Output<SceneFingers> fingers_;
  JointVector seed_ = home_position(six_axis);
};

bool it_tells_where_everything_is() {
  SceneCell cell;
  if (!cell.scene().initialise()) return false;
  cell.cycles();
  SlotReader scene(&cell.scene_slot());
  SlotReader arm(&cell.arm_slot());
  if (scene.newest() == nullptr || arm.newest() == nullptr) return false;
  const auto& told = *static_cast<const SceneState*>(scene.payload());
  const auto& chain = *static_cast<const SceneArm*>(arm.payload());
  // Neither arm nor fingers have said anything.
  return told.parts[0].kind != SceneKind::none && told.light[2] > 0.5 && chain.joints == 6 &&
         !cell.told().moves && cell.told().parts_on_table == 12 && cell.told().obstacles == 4;
}

/// That with the most room around it, of those that the arm reaches well: near its base its elbow is bent too
/// far.
std::size_t freest_block(const SceneState& state) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < most_parts; ++i) {
    if (state.parts[i].kind != SceneKind::block || state.parts[i].position[0] < 0.42) continue;
    const Footprint block = footprint_of(state.parts[i]);
    double least = 1;
    for (std::size_t k = 0; k < most_parts; ++k)
      if (k != i) least = std::min(least, separation_of(block, footprint_of(state.parts[k]), 1).gap);
    for (const SceneBody& obstacle : state.obstacles)
      if (obstacle.kind != SceneKind::none)
        least = std::min(least, separation_of(block, footprint_of(obstacle), 1).gap);
    if (least <= most) continue;
    most = least;
    best = i;
  }
  return best;
}

bool the_hand_is_where_the_joints_say() {
  SceneCell cell;
  if (!cell.scene().initialise()) return false;
  const std::size_t block = freest_block(cell.state());
  const SceneBody part = cell.state().parts[block];
  const double x = part.position[0];
  const double y = part.position[1];
  cell.open_to(0.045);
  for (int i = 0; i <= 20; ++i) {
    if (!cell.move_hand(x, y, 0.103 - 0.005 * i, part.angle)) return false;
    cell.cycles();
  }
  if (!cell.told().moves || std::abs(cell.state().grip_width - 0.03) > 1e-4) return false;
  for (double opening = 0.045; opening > 0.03; opening -= 0.0005) {
    cell.open_to(opening);
    cell.cycles();
  }
  cell.open_to(0.03);
  cell.cycles();
  if (cell.told().held_part != block + 1) return false;
  for (int i = 0; i <= 20; ++i) {
    if (!cell.move_hand(x, y, 0.003 + 0.005 * i, part.angle)) return false;
    cell.cycles();
  }
  return std::abs(cell.state().parts[block].position[2] - 0.1) < 1e-3 && cell.told().parts_on_table == 11;
}

bool links_are_counted_as_the_hand_is() {
  SceneCell cell;
  // A rod beside the fingers, 140 mm longer than they. The last joint's x is the tool's z.
  SceneCapsule& link = cell.bench().configuration().links[2];
  link.joint = 6;
  link.from = {0.10, 0, 0};
  link.to = {0.40, 0, 0};
  link.radius = 0.01;
  if (!cell.scene().initialise()) return false;
  cell.open_to(0.08);
  if (!cell.move_hand(0.75, 0, 0.2, 0)) return false;
  cell.cycles();
  if (cell.told().contacts != 0 || !cell.move_hand(0.75, 0, 0.1, 0)) return false;
  cell.cycles();
  return cell.told().contacts == 1;
}

bool buttons_do_as_they_say() {
  SceneCell cell;
  if (!cell.scene().initialise()) return false;
  cell.bench().runtime().place = {0.2, 0};
  cell.bench().runtime().add_obstacle = 1;
  cell.cycles();
  if (cell.told().obstacles != 5 || !cell.told().refusal_view().empty()) return false;
  cell.bench().runtime().add_obstacle = 1;
  cell.cycles();
  if (cell.told().obstacles != 5 ||
      cell.told().refusal_view().find("another place") == std::string_view::npos)
    return false;
  cell.bench().runtime().remove_obstacles = 1;
  cell.cycles();
  if (cell.told().obstacles != 4 || !cell.told().refusal_view().empty()) return false;
  const SceneBody before = cell.state().parts[4];
  cell.bench().runtime().part = 5;
  cell.bench().runtime().push_part = 1;
  cell.cycles();
  if (cell.state().parts[4].position == before.position) return false;
  cell.bench().runtime().cover_lens = true;
  cell.bench().runtime().light_intensity = 0.5;
  cell.bench().runtime().light_tint = {0.1, 0, -0.2};
  cell.bench().runtime().lay_table = 1;
  cell.cycles();
  return cell.state().lens_covered && cell.state().light_intensity == 0.5 &&
         cell.state().light_tint[2] == -0.2 && cell.told().parts_on_table == 12;
}

bool links_of_no_joint_are_refused() {
  SceneCell cell;
  cell.bench().configuration().links[2].joint = 7;
  const Status status = cell.scene().initialise();
  return status.code() == StatusCode::invalid_argument && std::strstr(status.cause(), "links[2]") != nullptr;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<it_tells_where_everything_is>),
      cmocka_unit_test(judged<the_hand_is_where_the_joints_say>),
      cmocka_unit_test(judged<links_are_counted_as_the_hand_is>),
      cmocka_unit_test(judged<buttons_do_as_they_say>),
      cmocka_unit_test(judged<links_of_no_joint_are_refused>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
