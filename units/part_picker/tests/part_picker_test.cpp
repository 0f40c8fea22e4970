// The unit at its ports: a mock's fingers, an arm that is at once where it is led, and a list of tracks.
#include "units/part_picker/part_picker.hpp"

#include <cmath>
#include <memory>

#include "hal/driver/device_bench.hpp"
#include "hal/gripper/mock/mock_gripper.hpp"
#include "motion/pose_conversion.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"
#include "units/vision/tests/known_parts.hpp"

namespace flexrf::part_picker_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;

constexpr Duration cycle = std::chrono::milliseconds(7);

struct World {
  DeviceBench<MockGripper> gripper{nullptr};
  UnitBench<PartPicker> bench;
  SlotBench<TrackList> tracks;
  SlotBench<AttentionGeneration> generation;
  SlotBench<PictureCondition> condition;
  SlotBench<Pose> tool_pose;
  SlotBench<RobotLead> led_by;
  SlotBench<ServoTarget> servo;
  SlotBench<TargetInHand> in_hand;
  InputBinding inputs[5] = {
      tracks.input(std::chrono::milliseconds(300)), generation.input(std::chrono::seconds(1)),
      condition.input(std::chrono::seconds(1)), tool_pose.input(std::chrono::milliseconds(100)),
      led_by.input(std::chrono::milliseconds(100))};
  SlotControl* outputs[2] = {&servo.control(), &in_hand.control()};
  Device* device = &gripper.driver();
  Device* const* devices[1] = {&device};

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.devices = devices;
    bench.unit().connect(binding);
    gripper.configuration().speed = 0.15;
    gripper.configuration().object_width = 0.04;
    where.translation() = Eigen::Vector3d(0.4, 0, 0.6);
    where.linear() = Eigen::AngleAxisd(3.141592653589793, Eigen::Vector3d::UnitX()).toRotationMatrix();
    lead.activity = RobotActivity::servo;
    lead.mode = ControlMode::automatic;
    configuration().catalogue = catalogue_of_tests();
  }
  PartPickerConfiguration& configuration() {
    return *static_cast<PartPickerConfiguration*>(bench.unit().parameter_memory().configuration);
  }
  Status begin() {
    if (const Status status = gripper.driver().initialise(); !status) return status;
    return bench.unit().initialise();
  }
  void lay_disc() {
    ObjectTrack& disc = list.tracks[0];
    list.count = 1;
    disc.identity = 7;
    disc.found = VisualClass::target;
    disc.kind = 1;
    disc.position = {0.45, 0.1};
    disc.radius = 0.02;
    disc.confirmed = disc.may_be_target = true;
  }
  void step() {
    gripper.receive(cycle);
    move();
    if (tells_pose) tool_pose.publish(to_pose(where), bench.now());
    if (tells_lead) led_by.publish(lead, bench.now());
    if (sees && ++steps % 5 == 0) {
      list.tracks[0].measured_at = nanoseconds(bench.now()) - 20'000'000;
      ++list.tracks[0].frames;
      ++list.frame;
      if (const auto hand = in_hand.latest(); hand && hand->watch_from != hand->watch_to) {
        list.watched = {hand->watch[0], hand->watch[1], hand->watch_angle};
        list.watched_at = nanoseconds(bench.now());
      }
      tracks.publish(list, bench.now());
    }
    bench.step(cycle);
    gripper.send();
    bench.runtime().open_gripper = 0;
    bench.runtime().clear_counters = 0;
  }
  void run(double duration) {
    for (double t = 0; t < duration; t += 0.007) step();
  }
  bool until(PickerState state, double within = 20) {
    for (double t = 0; t < within && bench.feedback().state != state; t += 0.007) step();
    return bench.feedback().state == state;
  }
  PickerState state() { return bench.feedback().state; }
  bool leads() { return servo.latest() && servo.latest()->valid; }
  bool says(const char* what) { return bench.feedback().message_view().find(what) != std::string_view::npos; }

  TrackList list{};
  RobotLead lead{};
  Eigen::Isometry3d where = Eigen::Isometry3d::Identity();
  bool sees = true;
  bool tells_pose = true;
  bool tells_lead = true;
  int steps = 0;

 private:
  void move() {
    const auto aim = servo.latest();
    lead.moving = false;
    if (!aim || !aim->valid || lead.activity != RobotActivity::servo) return;
    const Eigen::Isometry3d goal = to_isometry(aim->pose);
    const Eigen::Vector3d way = goal.translation() - where.translation();
    lead.moving = way.norm() > 1e-9;
    where.translation() += way * std::min(1.0, 0.004 / std::max(way.norm(), 1e-12));
    where.linear() = goal.linear();
  }
};

bool a_part_is_brought_into_its_bin() {
  const auto world = std::make_unique<World>();
  world->lay_disc();
  if (!world->begin() || !world->until(PickerState::descending)) return false;
  const auto& told = world->bench.feedback();
  if (!world->leads() || world->in_hand.latest()->track != 7 || told.target != 7) return false;
  if (told.target_kind != 1 || std::abs(told.target_place[0] - 0.45) > 1e-9) return false;
  if (std::abs(told.grasp_place[1] - 0.1) > 1e-9 || !world->says("disc")) return false;
  // 20 ms old when it was told, and found in the same cycle.
  if (told.latency < 0.0199 || told.latency > 0.035) return false;
  if (!world->until(PickerState::lifting) ||
      world->gripper.driver().state()->object != GripperObject::gripped)
    return false;
  world->list.tracks[0].found = VisualClass::nothing;
  if (!world->until(PickerState::releasing)) return false;
  const Eigen::Vector3d place = world->where.translation();
  if (std::abs(place.x() - 0.54) > 0.05 || std::abs(place.y() - 0.38) > 0.04) return false;
  if (!world->until(PickerState::waiting) || told.binned != 1 || told.approaches != 1) return false;
  if (told.target != 0 || told.target_kind != 65535 || world->in_hand.latest()->track != 0) return false;
  if (!world->bench.unit().is_idle() || told.remedy_view().empty()) return false;
  world->bench.runtime().clear_counters = 1;
  world->step();
  return told.binned == 0 && told.approaches == 0;
}

/// Of each input that it needs: how long it goes on without, and what it says then.
bool holds_without(bool World::*input, double age, PickerState state) {
  const auto world = std::make_unique<World>();
  world->lay_disc();
  if (!world->begin() || !world->until(PickerState::approaching)) return false;
  (*world).*input = false;
  world->run(age - 0.05);
  if (!world->leads()) return false;
  world->run(0.08);
  if (world->leads() || world->state() != state || world->bench.feedback().message_view().empty())
    return false;
  world->run(1);
  if (world->leads()) return false;
  (*world).*input = true;
  return world->until(PickerState::lifting, 30);
}
bool holds_without_tracks() {
  return holds_without(&World::sees, 0.3, PickerState::no_sight);
}
bool holds_without_a_pose() {
  return holds_without(&World::tells_pose, 0.1, PickerState::off);
}
bool holds_when_nobody_says_who_leads() {
  return holds_without(&World::tells_lead, 0.1, PickerState::off);
}

bool yields_to_others() {
  for (int who = 0; who < 3; ++who) {
    const auto world = std::make_unique<World>();
    world->lay_disc();
    if (!world->begin() || !world->until(PickerState::approaching)) return false;
    const RobotLead before = world->lead;
    if (who == 0) world->lead.mode = ControlMode::manual;
    if (who == 1) world->lead.stepping = true;
    world->run(0.1);
    if (who == 2) {
      // move() takes it for one that another leads.
      world->lead.activity = RobotActivity::jog;
      world->led_by.publish({.activity = RobotActivity::jog, .moving = true}, world->bench.now());
      world->tells_lead = false;
      world->step();
    }
    if (world->leads() || world->state() != PickerState::led_by_others) return false;
    world->tells_lead = true;
    world->lead = before;
    if (!world->until(PickerState::lifting, 30)) return false;
  }
  return true;
}

/// A kind that the table draws and no header knows: it is called by its name, and comes into its own bin.
bool another_kind_comes_into_its_bin() {
  const auto world = std::make_unique<World>();
  PartDrawing& ring = world->configuration().catalogue.parts[4];
  ring.set_name("ring");
  ring.radius = 0.02;
  ring.height = 0.015;
  ring.grasps[0].width = 0.04;
  ring.bin.middle = {0.70, 0.0};
  ring.bin.size = {0.10, 0.20};
  world->lay_disc();
  world->list.tracks[0].kind = 4;
  if (!world->begin() || !world->until(PickerState::descending) || !world->says("ring")) return false;
  if (!world->until(PickerState::lifting)) return false;
  world->list.tracks[0].found = VisualClass::nothing;
  if (!world->until(PickerState::releasing)) return false;
  const bool is_over = std::abs(world->where.translation().x() - 0.70) < 0.03;
  world->run(3);
  return is_over && world->bench.feedback().binned_by_kind[4] == 1;
}

bool a_part_without_a_bin_is_left() {
  const auto world = std::make_unique<World>();
  world->configuration().catalogue.parts[1].bin = {};
  world->lay_disc();
  return world->begin() && !world->until(PickerState::approaching, 15) &&
         world->state() == PickerState::waiting;
}

bool inhibited_it_neither_moves_nor_grips() {
  const auto world = std::make_unique<World>();
  world->lay_disc();
  world->bench.tick().motion_inhibited = true;
  if (!world->begin()) return false;
  world->run(2);
  if (world->leads() || world->state() != PickerState::off || !world->bench.unit().is_idle()) return false;
  if (world->gripper.driver().state()->activated || world->gripper.driver().state()->moving) return false;
  world->bench.tick().motion_inhibited = false;
  return world->until(PickerState::lifting, 30);
}

bool stuck_fingers_go_on_after_a_press() {
  const auto world = std::make_unique<World>();
  world->lay_disc();
  world->gripper.configuration().object_width = 0;
  if (!world->begin() || !world->until(PickerState::closing)) return false;
  world->gripper.driver().set_fault(MockGripper::Fault::stuck);
  if (!world->until(PickerState::gripper_trouble, 5) || world->leads()) return false;
  if (!world->says("come to rest") || !world->bench.unit().is_idle()) return false;
  world->gripper.driver().set_fault(MockGripper::Fault::none);
  world->run(1);
  if (world->state() != PickerState::gripper_trouble) return false;
  world->bench.runtime().open_gripper = 1;
  world->run(0.05);
  return world->state() != PickerState::gripper_trouble && world->until(PickerState::closing, 30);
}

bool what_cannot_be_is_refused() {
  const auto refuses = [](void (*spoil)(World&), const char* word) {
    const auto world = std::make_unique<World>();
    spoil(*world);
    const Status status = world->begin();
    return !status && std::string_view(status.cause()).find(word) != std::string_view::npos;
  };
  const bool box = refuses(
      [](World& world) {
        world.configuration().keep_out[3] = {.from = {0, 0, 0}, .to = {0.1, -0.1, 0.3}};
      },
      "keep_out");
  const bool look_out = refuses(
      [](World& world) {
        world.configuration().keep_out[0] = {.from = {0.40, -0.05, 0}, .to = {0.46, 0.05, 0.5}};
      },
      "look_out");
  const bool reach = refuses([](World& world) { world.configuration().reach = {0.5, 0.4}; }, "reach");
  // Fingers that know open and closed alone could not be opened for a part among others.
  const bool fingers =
      refuses([](World& world) { world.gripper.configuration().two_state = true; }, "gripper");
  const bool parts = refuses([](World& world) { world.configuration().catalogue.parts[0].height = 0; },
                             "catalogue: 'block' needs a height");
  return box && look_out && reach && fingers && parts;
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::part_picker_test

int main() {
  using namespace flexrf::part_picker_test;
  const CMUnitTest tests[] = {
      {"a part into its bin", passes<a_part_is_brought_into_its_bin>, nullptr, nullptr, nullptr},
      {"holds without tracks", passes<holds_without_tracks>, nullptr, nullptr, nullptr},
      {"holds without a pose", passes<holds_without_a_pose>, nullptr, nullptr, nullptr},
      {"holds when nobody says who leads", passes<holds_when_nobody_says_who_leads>, nullptr, nullptr,
       nullptr},
      {"yields to others", passes<yields_to_others>, nullptr, nullptr, nullptr},
      {"another kind", passes<another_kind_comes_into_its_bin>, nullptr, nullptr, nullptr},
      {"no bin", passes<a_part_without_a_bin_is_left>, nullptr, nullptr, nullptr},
      {"inhibited", passes<inhibited_it_neither_moves_nor_grips>, nullptr, nullptr, nullptr},
      {"stuck fingers", passes<stuck_fingers_go_on_after_a_press>, nullptr, nullptr, nullptr},
      {"what cannot be is refused", passes<what_cannot_be_is_refused>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
