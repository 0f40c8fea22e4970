// Several drives as one arm: all or none.
#include <cmath>
#include <cstring>
#include <memory>

#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/of_drives/mock/mock_drive_arm.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr std::size_t joints = six_axis.joint_count;

struct Cell {
  explicit Cell(bool homes = false) {
    if (homes) bench.configuration().homing_methods.fill(33);
    good = arm().initialise().is_ok();
    for (std::size_t i = 0; i < joints; ++i) {
      arm().drive(i).set_state(ServoState{.position = six_axis.joints[i].home});
    }
  }
  MockDriveArm& arm() { return bench.driver(); }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      bench.receive(std::chrono::milliseconds(7));
      bench.send();
    }
  }
  bool is_ready_in_time() {
    for (int i = 0; i < 1000 && !arm().is_ready(); ++i) run(1);
    return good && arm().is_ready();
  }
  int enabled() {
    int count = 0;
    for (std::size_t i = 0; i < joints; ++i) {
      const auto state = arm().drive(i).state();
      if (state && state->enabled) ++count;
    }
    return count;
  }
  std::uint64_t commands() {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < joints; ++i) count += arm().drive(i).commands();
    return count;
  }
  bool fault_says(const char* words) { return std::strstr(arm().fault().cause(), words) != nullptr; }

  DeviceBench<MockDriveArm> bench{&six_axis};
  bool good = false;
};

// Each in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  const bool good = Run();
  assert_true(good);
}

bool a_fault_of_one_switches_all_off() {
  const auto cell = std::make_unique<Cell>();
  if (!cell->is_ready_in_time() || cell->enabled() != static_cast<int>(joints)) return false;
  cell->arm().drive(3).trip();
  cell->run(2);
  const bool named = cell->fault_says(six_axis.joints[3].name.data()) && cell->fault_says("tripped");
  cell->run(2);
  return named && cell->enabled() == 0 && !cell->arm().is_ready();
}

bool a_drive_that_drops_out_switches_all_off() {
  const auto cell = std::make_unique<Cell>();
  if (!cell->is_ready_in_time()) return false;
  cell->arm().drive(1).set_state(std::nullopt);
  cell->run(4);
  return cell->arm().fault().code() == StatusCode::device_fault && cell->enabled() == 0;
}

bool nothing_is_commanded_before_all_are_enabled() {
  const auto cell = std::make_unique<Cell>();
  cell->arm().drive(5).set_state(std::nullopt);
  for (int i = 0; i < 20; ++i) {
    cell->bench.receive(std::chrono::milliseconds(7));
    cell->arm().command(JointPositions{});
    cell->bench.send();
  }
  if (cell->commands() != 0 || cell->arm().is_ready() || cell->arm().state()) return false;
  if (!cell->arm().fault().is_ok()) return false;
  cell->arm().drive(5).set_state(ServoState{});
  if (!cell->is_ready_in_time()) return false;
  lead_from_here(cell->arm());
  return cell->commands() == joints;
}

bool drives_are_homed_one_after_the_other() {
  const auto cell = std::make_unique<Cell>(true);
  int most_at_once = 0;
  for (int i = 0; i < 5000 && !cell->arm().is_ready(); ++i) {
    cell->run(1);
    int at_once = 0;
    for (std::size_t joint = 0; joint < joints; ++joint) {
      const auto state = cell->arm().drive(joint).state();
      if (state && state->homing == ServoHoming::running) ++at_once;
    }
    most_at_once = std::max(most_at_once, at_once);
    // Where it is is not told before all know it.
    if (!cell->arm().is_ready() && at_once > 0 && cell->arm().state()) return false;
  }
  const auto state = cell->arm().state();
  if (!cell->arm().is_ready() || !state || most_at_once != 1) return false;
  for (std::size_t joint = 0; joint < joints; ++joint) {
    if (cell->arm().drive(joint).homings() != 1 || state->position[joint] != 0) return false;
  }
  // Known from now on, with or without the permission to move.
  cell->arm().set_inhibited(true);
  cell->run(3);
  cell->arm().set_inhibited(false);
  return cell->is_ready_in_time() && cell->arm().drive(0).homings() == 1;
}

bool a_homing_that_fails_is_told_and_tried_again_with_a_new_permission() {
  constexpr std::size_t far = 4;  // takes its time
  const auto cell = std::make_unique<Cell>(true);
  for (int i = 0; i < 100 && cell->arm().drive(far).homings() == 0; ++i) cell->run(1);
  cell->arm().set_inhibited(true);
  cell->run(3);
  if (!cell->arm().fault().is_ok()) return false;  // nobody's
  cell->arm().set_inhibited(false);
  for (int i = 0; i < 100 && cell->arm().drive(far).homings() < 2; ++i) cell->run(1);
  cell->arm().drive(far).fail_homing();
  cell->run(2);
  return cell->arm().drive(far).homings() == 2 && cell->arm().drive(0).homings() == 1 &&
         cell->fault_says("no home") && !cell->arm().is_ready();
}

bool joints_keep_to_their_limits() {
  const auto cell = std::make_unique<Cell>();
  if (!cell->is_ready_in_time()) return false;
  JointPositions far{};
  far.position.fill(100);
  lead_from_here(cell->arm());
  cell->arm().command(far);
  for (std::size_t i = 0; i < joints; ++i) {
    if (cell->arm().drive(i).commanded() != six_axis.joints[i].upper) return false;
  }
  return true;
}

bool one_that_is_no_number_moves_no_joint() {
  const auto cell = std::make_unique<Cell>();
  if (!cell->is_ready_in_time()) return false;
  JointPositions bad{};
  bad.position[4] = std::nan("");
  cell->arm().command(bad);
  cell->run(1);
  return cell->commands() == 0 && cell->arm().fault().code() == StatusCode::invalid_argument &&
         cell->fault_says(six_axis.joints[4].name.data());
}

bool it_goes_on_after_it_was_made_safe() {
  const auto cell = std::make_unique<Cell>();
  if (!cell->is_ready_in_time() || !cell->arm().make_safe()) return false;
  cell->run(1);
  cell->arm().set_inhibited(true);
  cell->run(2);
  if (cell->enabled() != 0) return false;
  cell->arm().set_inhibited(false);
  return cell->is_ready_in_time() && cell->arm().fault().is_ok();
}

// Its set-points are positions, and a drive counts only so far.
bool a_joint_without_end_is_refused() {
  static KinematicChain endless = six_axis;
  endless.joints[5].kind = JointKind::continuous;
  const auto bench = std::make_unique<DeviceBench<MockDriveArm>>(&endless);
  const Status status = bench->driver().initialise();
  return !status.is_ok() && std::strstr(status.cause(), "joint axis_6 turns without end") != nullptr &&
         std::strstr(status.cause(), "give it lower and upper") != nullptr;
}

// An arm is where its drives were when the last of them was heard longest ago.
// [robot-arm-13]
bool it_is_as_old_as_its_oldest_drive() {
  const auto cell = std::make_unique<Cell>();
  cell->run(5);
  if (cell->arm().measured_at() != cell->bench.now()) return false;
  cell->arm().drive(2).set_delay(std::chrono::milliseconds(14));
  cell->run(5);
  if (cell->arm().measured_at() != cell->bench.now() - std::chrono::milliseconds(14)) return false;
  cell->arm().drive(4).set_state(std::nullopt);
  return !cell->arm().state() && cell->arm().measured_at() == Time{};
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      {"a fault of one switches all off", judged<a_fault_of_one_switches_all_off>, nullptr, nullptr, nullptr},
      {"a drive that drops out switches all off", judged<a_drive_that_drops_out_switches_all_off>, nullptr,
       nullptr, nullptr},
      {"nothing is commanded before all are enabled", judged<nothing_is_commanded_before_all_are_enabled>,
       nullptr, nullptr, nullptr},
      {"drives are homed one after the other", judged<drives_are_homed_one_after_the_other>, nullptr, nullptr,
       nullptr},
      {"a homing that fails is told",
       judged<a_homing_that_fails_is_told_and_tried_again_with_a_new_permission>, nullptr, nullptr, nullptr},
      {"joints keep to their limits", judged<joints_keep_to_their_limits>, nullptr, nullptr, nullptr},
      {"one that is no number moves no joint", judged<one_that_is_no_number_moves_no_joint>, nullptr, nullptr,
       nullptr},
      {"a joint without end is refused", judged<a_joint_without_end_is_refused>, nullptr, nullptr, nullptr},
      {"it is as old as its oldest drive", judged<it_is_as_old_as_its_oldest_drive>, nullptr, nullptr,
       nullptr},
      {"it goes on after it was made safe", judged<it_goes_on_after_it_was_made_safe>, nullptr, nullptr,
       nullptr},
  };
  return cmocka_run_group_tests_name("servo group", tests, nullptr, nullptr);
}
