#include "units/jog/jog.hpp"

#include <cmath>

#include "hal/driver/device_bench.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

constexpr Duration interval = std::chrono::milliseconds(100);

struct World {
  UnitBench<Jog> bench;
  QueueBench<KeyEvent> keys;
  SlotBench<Pose> actual;
  SlotBench<Pose> target;
  SlotBench<Velocity> velocity;
  SlotBench<TargetAnswer> answer;
  InputBinding inputs[2] = {actual.input(std::chrono::milliseconds(500)), answer.input()};
  SlotControl* outputs[2] = {&target.control(), &velocity.control()};
  QueueSource* sources[1] = {&keys.ring()};

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.queue_inputs = sources;
    bench.unit().connect(binding);
    initialised = bench.unit().initialise().is_ok();
  }

  void arm_is_at(double x, double y, double z) {
    Pose pose{};
    pose.position = {x, y, z};
    pose.orientation = {0, 1, 0, 0};
    actual.publish(pose, bench.now());
  }
  void press(const char* text) {
    for (; *text != '\0'; ++text) keys.push({Key::character, static_cast<std::uint32_t>(*text)});
  }
  bool target_is(double x, double y, double z) {
    const auto pose = target.latest();
    return pose && std::abs(pose->position[0] - x) < 1e-12 && std::abs(pose->position[1] - y) < 1e-12 &&
           std::abs(pose->position[2] - z) < 1e-12 && pose->orientation[1] == 1.0;
  }
  bool velocity_is(double x, double y, double z) {
    const auto now = velocity.latest();
    return now && std::abs(now->linear[0] - x) < 1e-12 && std::abs(now->linear[1] - y) < 1e-12 &&
           std::abs(now->linear[2] - z) < 1e-12;
  }
  bool initialised = false;
};

bool keys_wait_for_the_arms_pose() {
  World world;
  world.press("ww");
  world.bench.step(interval);
  if (world.target.latest() || world.bench.unit().is_idle()) return false;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(interval);
  return world.target_is(0.72, 0, 1) && world.bench.unit().is_idle() && world.bench.feedback().presses == 2;
}

// Its thread may not have run since the stop, and the arm was moved by hand meanwhile.
bool the_first_key_after_start_counts_from_where_the_arm_is() {
  World world;
  world.bench.tick().motion_inhibited = true;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(interval);
  world.bench.tick().motion_inhibited = false;
  world.arm_is_at(0.4, 0, 1);
  world.press("w");
  world.bench.step(interval);
  return world.target_is(0.41, 0, 1);
}

bool every_press_counts() {
  World world;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(interval);
  if (!world.target_is(0.7, 0, 1)) return false;
  world.press("wwwwddd?q");
  world.bench.step(interval);
  if (!world.target_is(0.74, -0.03, 1.01)) return false;
  world.bench.runtime().step = 0.1;
  world.press("s");
  world.bench.step(interval);
  return world.target_is(0.64, -0.03, 1.01) && world.bench.feedback().presses == 9;
}

// The reader's limit on age must not bite while jog lives.
bool target_stays_fresh() {
  World world;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(interval);
  const std::uint64_t published = world.target.control().published();
  world.bench.step(interval);
  world.bench.step(interval);
  return world.target.control().published() == published + 2;
}

// Seeded once: the arm's motion does not draw the target along.
bool target_is_its_own() {
  World world;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(interval);
  world.arm_is_at(0.5, 0.5, 0.5);
  world.bench.step(interval);
  return world.target_is(0.7, 0, 1);
}

/// However often a key is pressed that leads out of reach, one press leads back in.
bool stays_within_reach() {
  World world;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(interval);
  world.press("wwwwwwwwww");
  world.bench.step(interval);
  if (!world.target_is(0.8, 0, 1)) return false;
  TargetAnswer said{};
  said.kept.position = {0.72, 0, 1};
  said.kept.orientation = {0, 1, 0, 0};
  said.set_reason("target (0.800, 0.000, 1.000) m refused: out of reach");
  world.answer.publish(said, world.bench.now());
  world.bench.step(interval);
  if (!world.target_is(0.72, 0, 1) || world.bench.feedback().refusals != 1) return false;
  if (world.bench.feedback().refusal_view().find("out of reach") == std::string_view::npos) return false;
  world.press("s");
  world.bench.step(interval);
  return world.target_is(0.71, 0, 1);
}

bool nothing_is_kept_while_inhibited() {
  World world;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(interval);
  world.press("www");
  world.bench.tick().motion_inhibited = true;
  world.arm_is_at(0.6, 0.1, 1);
  world.bench.step(interval);
  if (!world.target_is(0.6, 0.1, 1)) return false;
  world.bench.tick().motion_inhibited = false;
  world.bench.step(interval);
  return world.target_is(0.6, 0.1, 1) && world.bench.feedback().presses == 0;
}

bool an_old_pose_is_no_seed() {
  World world;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(std::chrono::seconds(1));
  return !world.target.latest();
}

bool a_held_arrow_is_a_velocity() {
  World world;
  world.arm_is_at(0.7, 0, 1);
  world.bench.runtime().speed = 0.1;
  world.bench.step(interval);
  if (!world.velocity_is(0, 0, 0)) return false;
  world.bench.runtime().minus_y = true;
  world.bench.step(interval);
  if (!world.velocity_is(0, -0.1, 0)) return false;
  // Two arrows are no faster than one; opposite ones are none.
  world.bench.runtime().plus_z = true;
  world.bench.step(interval);
  if (!world.velocity_is(0, -0.1 * std::sqrt(0.5), 0.1 * std::sqrt(0.5))) return false;
  world.bench.runtime().plus_y = true;
  world.bench.runtime().plus_z = false;
  world.bench.step(interval);
  if (!world.velocity_is(0, 0, 0)) return false;
  world.bench.runtime().plus_y = false;
  world.bench.runtime().minus_y = false;
  world.bench.step(interval);
  return world.velocity_is(0, 0, 0) && world.target_is(0.7, 0, 1);
}

// Also before the target is known.
bool no_velocity_while_inhibited_or_stopping() {
  World world;
  world.bench.runtime().plus_x = true;
  world.bench.tick().motion_inhibited = true;
  world.bench.step(interval);
  if (!world.velocity_is(0, 0, 0)) return false;
  world.bench.tick().motion_inhibited = false;
  world.bench.step(interval);
  if (!world.velocity_is(0.05, 0, 0)) return false;
  world.bench.tick().stop_requested = true;
  world.bench.step(interval);
  return world.velocity_is(0, 0, 0);
}

bool a_key_after_an_arrow_begins_where_the_arm_is() {
  World world;
  world.arm_is_at(0.7, 0, 1);
  world.bench.step(interval);
  world.bench.runtime().plus_x = true;
  world.press("q");  // lost: a hand moves the arm
  world.bench.step(interval);
  world.arm_is_at(0.8, 0, 1);
  world.bench.runtime().plus_x = false;
  world.bench.step(interval);
  if (!world.target_is(0.7, 0, 1) || world.bench.feedback().presses != 0) return false;
  world.press("w");
  world.bench.step(interval);
  if (!world.target_is(0.81, 0, 1)) return false;
  world.arm_is_at(0.9, 0, 1);
  world.press("w");
  world.bench.step(interval);
  return world.target_is(0.82, 0, 1);
}

void gives_a_velocity_while_held(void**) {
  assert_true(a_held_arrow_is_a_velocity());
}
void gives_none_while_inhibited(void**) {
  assert_true(no_velocity_while_inhibited_or_stopping());
}
void goes_on_from_what_is_kept(void**) {
  assert_true(stays_within_reach());
}
void leaves_the_target_behind(void**) {
  assert_true(a_key_after_an_arrow_begins_where_the_arm_is());
}
void waits_for_the_pose(void**) {
  assert_true(keys_wait_for_the_arms_pose());
}
void counts_every_press(void**) {
  assert_true(the_first_key_after_start_counts_from_where_the_arm_is());
  assert_true(every_press_counts());
}
void publishes_in_every_step(void**) {
  assert_true(target_stays_fresh());
}
void does_not_follow_the_arm(void**) {
  assert_true(target_is_its_own());
}
void forgets_while_inhibited(void**) {
  assert_true(nothing_is_kept_while_inhibited());
}
void old_pose_is_no_seed(void**) {
  assert_true(an_old_pose_is_no_seed());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(waits_for_the_pose),          cmocka_unit_test(counts_every_press),
      cmocka_unit_test(publishes_in_every_step),     cmocka_unit_test(does_not_follow_the_arm),
      cmocka_unit_test(forgets_while_inhibited),     cmocka_unit_test(old_pose_is_no_seed),
      cmocka_unit_test(gives_a_velocity_while_held), cmocka_unit_test(gives_none_while_inhibited),
      cmocka_unit_test(leaves_the_target_behind),    cmocka_unit_test(goes_on_from_what_is_kept),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
