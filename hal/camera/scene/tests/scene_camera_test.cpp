// The scene's camera with its slots: scene and joints as of the middle of an exposure.
#include "hal/camera/scene/scene_camera.hpp"

#include <cmath>

#include "hal/driver/device_bench.hpp"
#include "runtime/blackboard/history.hpp"
#include "runtime/blackboard/slot.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

constexpr Time start{std::chrono::seconds(1)};

/// An arm of one joint that slides along x, 500 mm above a block; with its hand downwards.
class CameraCell {
 public:
  CameraCell() {
    scene_.connect(&context_, &scene_slot_.control());
    arm_.connect(&context_, &arm_slot_.control());
    joints_.connect(&context_, &joints_slot_.control());
    bench_.configuration().format = PixelFormat::rgb24;
    bench_.configuration().noise = 0;
  }

  bool begin() {
    SceneArm arm{};
    arm.joints = 1;
    arm.slides[0] = true;
    arm.axis[0] = 1;
    arm.rotation[0] = arm.rotation[4] = arm.rotation[8] = 1;
    arm.origin[2] = 0.5;
    arm.tool_rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
    arm_.publish(arm, bench_.now());
    return bench_.driver().initialise().is_ok();
  }
  /// From 300 mm on, with 0.4 m/s^2.
  static double position(Time time) { return 0.3 + 0.2 * std::pow(seconds(time - start), 2); }
  void tell_joints(Time time) {
    JointState joints{};
    joints.position[0] = position(time);
    joints.velocity[0] = 0.4 * seconds(time - start);
    joints_.publish(joints, time);
  }
  void tell_scene(Time time, bool held) {
    SceneState state{};
    state.light = {0, 0, 1};
    state.light_intensity = 1;
    state.opening = 0.03;
    // In the picture it is above the hand.
    state.parts[0] = part_at(SceneKind::block, {0.45, 0}, 0);
    if (held) {
      state.held = 1;
      state.grip_position = {0.1, 0, 0.4};
      state.grip_orientation = {1, 0, 0, 0};
    }
    scene_.publish(state, time);
  }
  std::optional<CameraImage> receive() {
    bench_.receive(milliseconds(10));
    bench_.send();
    return bench_.driver().frame();
  }
  const CameraFeedback& told() { return bench_.feedback(); }
  Time now() const { return bench_.now(); }

 private:
  static constexpr std::uint32_t kept = 64;

  DeviceBinding binding() {
    DeviceBinding binding;
    binding.inputs = inputs_;
    return binding;
  }

  HistoryMemory<SceneState, kept> scene_memory_{};
  HistoryMemory<JointState, kept> joints_memory_{};
  History scene_history_{descriptor_of<SceneState>, scene_memory_.words, kept};
  History joints_history_{descriptor_of<JointState>, joints_memory_.words, kept};
  Slot<SceneState, 1> scene_slot_{{}, &scene_history_};
  Slot<SceneArm, 1> arm_slot_;
  Slot<JointState, 1> joints_slot_{{}, &joints_history_};
  SlotReader readers_[3] = {SlotReader(&scene_slot_.control()), SlotReader(&arm_slot_.control()),
                            SlotReader(&joints_slot_.control())};
  InputBinding inputs_[3] = {InputBinding{&readers_[0], 1, {}, nullptr},
                             InputBinding{&readers_[1], 1, {}, nullptr},
                             InputBinding{&readers_[2], 1, {}, nullptr}};
  DeviceBench<SceneCamera> bench_{binding()};
  StepContext context_;
  Output<SceneState> scene_;
  Output<SceneArm> arm_;
  Output<JointState> joints_;
};

/// Middle of what is blue along the picture's columns, in rows; no number: nothing is.
double blue_row(const CameraImage& image) {
  double sum = 0;
  int count = 0;
  for (std::uint32_t row = 0; row < image.height; ++row) {
    for (std::uint32_t column = 0; column < image.width; ++column) {
      const std::uint8_t* const pixel = &image.data[row * image.stride + column * 3];
      if (pixel[2] < 130 || pixel[2] < 2 * pixel[0]) continue;  // its sides are darker
      sum += row;
      ++count;
    }
  }
  return sum / count;
}

/// Joints are told every 20 ms: what lies between is computed, and not taken from the last.
bool the_hand_is_where_it_was_in_the_middle_of_the_exposure() {
  CameraCell cell;
  if (!cell.begin()) return false;
  cell.tell_scene(cell.now(), false);
  int judged = 0;
  for (int i = 0; i < 50; ++i) {
    if (i % 2 == 0) cell.tell_joints(cell.now());
    const auto image = cell.receive();
    if (!image) continue;
    const double lens = CameraCell::position(image->time) + 0.05;
    const double expected = 239.5 - 600 * (0.45 - lens) / 0.425;
    if (!(std::abs(blue_row(*image) - expected) < 0.7)) return false;
    ++judged;
  }
  return judged > 10 && cell.told().lost_frames == 0;
}

/// However the hand moves, what it holds is seen at the same place.
bool what_is_held_moves_with_the_hand() {
  CameraCell cell;
  if (!cell.begin()) return false;
  double first = 0;
  int judged = 0;
  for (int i = 0; i < 50; ++i) {
    cell.tell_joints(cell.now());
    if (i % 3 == 0) cell.tell_scene(cell.now(), true);
    const auto image = cell.receive();
    if (!image) continue;
    const double row = blue_row(*image);
    if (judged++ == 0) first = row;
    if (!(std::abs(row - first) < 0.3)) return false;
  }
  // 50 mm before the lens, its upper side 325 mm below it.
  return judged > 10 && std::abs(first - (239.5 - 600 * 0.05 / 0.325)) < 0.7;
}

bool it_waits_for_scene_and_arm() {
  CameraCell cell;
  if (!cell.begin()) return false;
  for (int i = 0; i < 20; ++i)
    if (cell.receive()) return false;
  if (cell.told().trouble_view().find("scene") == std::string_view::npos) return false;
  cell.tell_scene(cell.now(), false);
  for (int i = 0; i < 20; ++i)
    if (cell.receive()) return false;
  if (cell.told().trouble_view().find("arm") == std::string_view::npos) return false;
  cell.tell_joints(cell.now());
  for (int i = 0; i < 20; ++i)
    if (cell.receive()) return cell.told().present && cell.told().trouble_view().empty();
  return false;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<the_hand_is_where_it_was_in_the_middle_of_the_exposure>),
      cmocka_unit_test(judged<what_is_held_moves_with_the_hand>),
      cmocka_unit_test(judged<it_waits_for_scene_and_arm>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
