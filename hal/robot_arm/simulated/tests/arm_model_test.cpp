#include "hal/robot_arm/simulated/arm_model.hpp"

#include <algorithm>
#include <cmath>

#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"
#include "hal/robot_arm/simulated/simulated_arm.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr Time start{std::chrono::seconds(5)};
constexpr double lag = 0.012;

Time after(double seconds) {
  return start + Duration(std::llround(seconds * 1e9));
}

// A step of all joints: limits hold, there is no overshoot, and it arrives.
bool a_step_keeps_the_limits() {
  ArmModel model;
  model.reset(six_axis, lag);
  model.advance(start);
  JointVector goal = home_position(six_axis);
  goal.head<6>().array() += 0.4;
  model.follow(goal);
  JointVector last_velocity = JointVector::Zero();
  for (int k = 1; k <= 3000; ++k) {
    model.advance(after(k * 1e-3));
    const JointVector velocity = model.velocity();
    for (std::size_t i = 0; i < 6; ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      const ChainJoint& joint = six_axis.joints[i];
      if (std::abs(velocity[index]) > joint.velocity + 1e-12) return false;
      if (std::abs(velocity[index] - last_velocity[index]) > joint.acceleration * 1e-3 + 1e-12) return false;
      if (model.position()[index] > goal[index] + 1e-3) return false;
    }
    last_velocity = velocity;
  }
  return (model.position() - goal).cwiseAbs().maxCoeff() < 1e-6;
}

// Small steps are followed with the lag's exponential.
bool small_steps_follow_the_lag() {
  ArmModel model;
  model.reset(six_axis, lag);
  model.advance(start);
  const JointVector home = home_position(six_axis);
  JointVector goal = home;
  goal[0] += 1e-4;
  model.follow(goal);
  model.advance(after(5 * lag));
  const double left = (goal[0] - model.position()[0]) / 1e-4;
  return left > 0 && left < 0.05;
}

// The motion does not depend on how often one looks.
bool looking_changes_nothing() {
  const auto run = [](double period) {
    ArmModel model;
    model.reset(six_axis, lag);
    model.advance(start);
    JointVector goal = home_position(six_axis);
    goal[1] += 0.3;
    model.follow(goal);
    for (int k = 1; k * period < 0.1999; ++k) model.advance(after(k * period));
    model.advance(after(0.2));
    return JointVector(model.position());
  };
  return run(0.0003) == run(0.007) && run(0.007) == run(0.2);
}

bool a_stuck_joint_stays() {
  ArmModel model;
  model.reset(six_axis, lag);
  model.stick(2);
  model.advance(start);
  JointVector goal = home_position(six_axis);
  goal.head<3>().array() += 0.1;
  model.follow(goal);
  model.advance(after(1.0));
  return model.position()[2] == home_position(six_axis)[2] && std::abs(model.position()[1] - goal[1]) < 1e-6;
}

// As an arm whose control begins anew.
bool what_is_restarted_stays_where_it_is() {
  DeviceBench<SimulatedArm> bench(&six_axis);
  bench.configuration().noise = {};
  if (!bench.driver().initialise()) return false;
  JointPositions goal{};
  goal.position_map() = home_position(six_axis);
  goal.position[0] += 0.3;
  for (int k = 0; k < 200; ++k) {
    bench.receive(std::chrono::milliseconds(7));
    lead_from_here(bench.driver());
    bench.driver().command(goal);
    bench.send();
  }
  bench.driver().inject(SimulatedArm::Fault::drives_trip);
  bench.receive(std::chrono::milliseconds(7));
  const bool tripped = !bench.driver().fault().is_ok();
  bench.driver().clear_fault();
  if (!bench.driver().initialise()) return false;
  bench.receive(std::chrono::milliseconds(7));
  const auto told = bench.driver().state();
  return tripped && told && std::abs(told->position[0] - goal.position[0]) < 1e-3 &&
         std::abs(told->velocity[0]) < 1e-6;
}

// What the sensors say of an arm at rest.
std::array<double, 8> first_reading(std::uint64_t seed, double noise) {
  DeviceBench<SimulatedArm> bench(&six_axis);
  bench.environment().seed = seed;
  bench.configuration().noise.fill(noise);
  if (!bench.driver().initialise()) return {};
  bench.receive(std::chrono::milliseconds(7));
  return bench.driver().state()->position;
}

// Each in its unit of measure: what is little for one that turns may be much for one that slides.
bool each_joint_has_its_noise() {
  DeviceBench<SimulatedArm> bench(&six_axis);
  bench.configuration().noise = {};
  bench.configuration().noise[2] = 1e-3;
  if (!bench.driver().initialise()) return false;
  bench.receive(std::chrono::milliseconds(7));
  const auto told = bench.driver().state()->position;
  bool good = true;
  for (std::size_t i = 0; i < six_axis.joint_count; ++i)
    good = good && (told[i] != six_axis.joints[i].home) == (i == 2);
  return good;
}

bool the_seed_makes_the_noise() {
  const auto first = first_reading(1, 1e-4);
  return first == first_reading(1, 1e-4) && first != first_reading(2, 1e-4) &&
         first_reading(1, 0) == first_reading(2, 0) && std::abs(first[0]) < 1e-3 && first[6] == 0;
}

bool scheduled_faults_come() {
  DeviceBench<SimulatedArm> bench(&six_axis);
  bench.configuration().sensor_lost_after = 0.05;
  bench.configuration().drive_fault_after = 0.1;
  if (!bench.driver().initialise()) return false;
  bool sensed_before = true;
  for (int k = 0; k < 7; ++k) {  // 42 ms after its first cycle
    bench.receive(std::chrono::milliseconds(7));
    sensed_before = sensed_before && bench.driver().state().has_value();
  }
  if (!sensed_before || !bench.driver().fault().is_ok()) return false;
  for (int k = 0; k < 4; ++k) bench.receive(std::chrono::milliseconds(7));
  if (bench.driver().state() || !bench.driver().fault().is_ok()) return false;
  for (int k = 0; k < 7; ++k) bench.receive(std::chrono::milliseconds(7));
  return bench.driver().fault().code() == StatusCode::device_fault;
}

void limits_hold(void**) {
  assert_true(a_step_keeps_the_limits());
}
void lag_is_first_order(void**) {
  assert_true(small_steps_follow_the_lag());
}
void cadence_does_not_matter(void**) {
  assert_true(looking_changes_nothing());
}
void stuck_joint(void**) {
  assert_true(a_stuck_joint_stays());
}
void a_restart_is_no_jump(void**) {
  assert_true(what_is_restarted_stays_where_it_is());
}
void noise_is_seeded(void**) {
  assert_true(the_seed_makes_the_noise());
}
void noise_of_each_joint(void**) {
  assert_true(each_joint_has_its_noise());
}
void faults_are_injected(void**) {
  assert_true(scheduled_faults_come());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(limits_hold),
      cmocka_unit_test(lag_is_first_order),
      cmocka_unit_test(cadence_does_not_matter),
      cmocka_unit_test(stuck_joint),
      cmocka_unit_test(a_restart_is_no_jump),
      cmocka_unit_test(noise_is_seeded),
      cmocka_unit_test(noise_of_each_joint),
      cmocka_unit_test(faults_are_injected),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
