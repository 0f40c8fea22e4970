// What the scene's gripper has beyond every gripper: it asks the scene, and tells it.
#include "hal/gripper/scene/scene_gripper.hpp"

#include <cmath>

#include "hal/driver/device_bench.hpp"
#include "runtime/blackboard/slot.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

class GripperCell {
 public:
  GripperCell() {
    scene_.connect(&context_, &scene_slot_.control());
    bench_.configuration().activation = 0;
  }

  bool start() { return bench_.driver().initialise().is_ok(); }
  SceneGripper& gripper() { return bench_.driver(); }
  void meet(double width) {
    SceneState state{};
    state.grip_width = width;
    scene_.publish(state, bench_.now());
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) {
      bench_.receive(std::chrono::milliseconds(7));
      bench_.send();
    }
  }
  double told_opening() {
    const ItemHeader* const header = reader_.newest();
    return header == nullptr ? -1 : static_cast<const SceneFingers*>(reader_.payload())->opening;
  }

 private:
  DeviceBinding binding() {
    DeviceBinding binding;
    binding.inputs = inputs_;
    binding.outputs = outputs_;
    return binding;
  }

  Slot<SceneState, 1> scene_slot_;
  Slot<SceneFingers, 1> fingers_slot_;
  SlotReader scene_reader_{&scene_slot_.control()};
  SlotReader reader_{&fingers_slot_.control()};
  InputBinding inputs_[1] = {InputBinding{&scene_reader_, 1, {}, nullptr}};
  SlotControl* outputs_[1] = {&fingers_slot_.control()};
  DeviceBench<SceneGripper> bench_{binding()};
  StepContext context_;
  Output<SceneState> scene_;
};

bool the_scene_says_where_fingers_stop() {
  GripperCell cell;
  if (!cell.start()) return false;
  cell.meet(0.03);
  cell.cycles(1);
  cell.gripper().close();
  cell.cycles(400);
  return cell.told_opening() == 0.03 && cell.gripper().state()->object == GripperObject::gripped;
}

bool what_the_scene_takes_away_is_lost() {
  GripperCell cell;
  if (!cell.start()) return false;
  cell.meet(0.03);
  cell.cycles(1);
  cell.gripper().close();
  cell.cycles(400);
  cell.meet(0);
  cell.cycles(200);
  return cell.told_opening() == 0 && cell.gripper().state()->object == GripperObject::lost;
}

bool it_tells_the_scene_where_its_fingers_are() {
  GripperCell cell;
  if (!cell.start()) return false;
  cell.cycles(1);
  if (std::abs(cell.told_opening() - 0.085) > 1e-12) return false;
  cell.gripper().command({.opening = 0.05});
  cell.cycles(400);
  return cell.told_opening() == 0.05 && cell.gripper().state()->object == GripperObject::none;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<the_scene_says_where_fingers_stop>),
      cmocka_unit_test(judged<what_the_scene_takes_away_is_lost>),
      cmocka_unit_test(judged<it_tells_the_scene_where_its_fingers_are>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
