// What mocks measure: with noise that a seed repeats, and told late.
#include <cmath>

#include "hal/driver/device_bench.hpp"
#include "hal/gripper/mock/mock_gripper.hpp"
#include "hal/modbus/station/mock/mock_modbus_station.hpp"
#include "hal/robot_arm/mock/mock_arm.hpp"
#include "hal/servo_drive/mock/mock_servo_drive.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;

constexpr double noise = 0.02;
constexpr int cycles = 500;

struct Measured {
  double least = 1e9;
  double most = -1e9;
  double weighed = 0;  // other values, or the same in another order, have another sum
};

bool is_noise_about(double value, const Measured& measured) {
  return measured.least >= value - noise && measured.least < value - 0.9 * noise &&
         measured.most <= value + noise && measured.most > value + 0.9 * noise;
}

// `prepare` is called once, behind initialise(); `told` each cycle, behind receive().
template <class Driver, class Prepare, class Told>
Measured measure(DeviceBench<Driver>& bench, std::uint64_t seed, Prepare prepare, Told told) {
  Measured result;
  bench.environment().seed = seed;
  if (!bench.driver().initialise()) return result;
  prepare(bench.driver());
  for (int i = 0; i < cycles; ++i) {
    bench.receive(milliseconds(7));
    const double value = told(bench.driver());
    result.least = std::min(result.least, value);
    result.most = std::max(result.most, value);
    result.weighed += value * i;
  }
  return result;
}

constexpr auto as_it_is = [](const Device&) {};

template <class Measure>
bool is_seeded(double value, Measure of_seed) {
  const Measured one = of_seed(1);
  return is_noise_about(value, one) && of_seed(1).weighed == one.weighed && of_seed(2).weighed != one.weighed;
}

bool arm_is_noisy() {
  return is_seeded(six_axis.joints[2].home, [](std::uint64_t seed) {
    DeviceBench<MockArm> bench{&six_axis};
    bench.configuration().position_noise[2] = noise;
    return measure(bench, seed, as_it_is, [](const MockArm& arm) { return arm.state()->position[2]; });
  });
}

bool drive_is_noisy() {
  return is_seeded(0, [](std::uint64_t seed) {
    DeviceBench<MockServoDrive> bench{nullptr};
    bench.configuration().position_noise = noise;
    return measure(bench, seed, as_it_is,
                   [](const MockServoDrive& drive) { return drive.state()->position; });
  });
}

bool gripper_is_noisy() {
  return is_seeded(DeviceBench<MockGripper>{nullptr}.configuration().open_width, [](std::uint64_t seed) {
    DeviceBench<MockGripper> bench{nullptr};
    bench.configuration().opening_noise = noise;
    return measure(bench, seed, as_it_is,
                   [](const MockGripper& gripper) { return *gripper.state()->opening; });
  });
}

constexpr ModbusRegister pressure{.name = "pressure", .type = ModbusType::f32, .unit = "bar"};
constexpr ModbusRegister registers[] = {pressure};
constexpr ModbusRegisterMap map{registers};

bool station_is_noisy() {
  return is_seeded(5, [](std::uint64_t seed) {
    DeviceBench<MockModbusStation> bench{&map};
    const auto prepare = [](MockModbusStation& station) {
      station.put(0, 5);
      station.set_noise(0, noise);
    };
    return measure(bench, seed, prepare,
                   [](const MockModbusStation& station) { return station.read(0).value; });
  });
}

void noise_is_bounded_and_seeded(void**) {
  assert_true(arm_is_noisy());
  assert_true(drive_is_noisy());
  assert_true(gripper_is_noisy());
  assert_true(station_is_noisy());
}

// Where it is told to be in each of so many cycles of 10 ms, of which the first moves it.
template <class Driver, class Told>
int cycles_until(DeviceBench<Driver>& bench, Told is_told) {
  for (int i = 0; i < cycles; ++i) {
    bench.receive(milliseconds(10));
    if (is_told(bench.driver())) return i;
  }
  return cycles;
}

int arm_tells_after(Duration delay) {
  DeviceBench<MockArm> bench{&six_axis};
  if (!bench.driver().initialise()) return cycles;
  bench.driver().set_delay(delay);
  bench.receive(milliseconds(10));
  JointPositions wanted;
  wanted.position_map() = home_position(six_axis);
  wanted.position[0] += 0.1;
  bench.driver().command(wanted);
  return cycles_until(bench,
                      [&](const MockArm& arm) { return arm.state()->position[0] == wanted.position[0]; });
}

int drive_tells_after(Duration delay) {
  DeviceBench<MockServoDrive> bench{nullptr};
  bench.configuration().fastest = 1000;
  bench.configuration().acceleration = 1e6;
  if (!bench.driver().initialise()) return cycles;
  bench.driver().set_delay(delay);
  bench.receive(milliseconds(10));
  bench.send();
  bench.driver().command_position(1);
  return cycles_until(bench, [](const MockServoDrive& drive) { return drive.state()->position == 1; });
}

int gripper_tells_after(Duration delay) {
  DeviceBench<MockGripper> bench{nullptr};
  auto& configuration = bench.configuration();
  configuration.activation = 0;
  if (!bench.driver().initialise()) return cycles;
  bench.driver().set_delay(delay);
  bench.receive(milliseconds(10));
  bench.driver().command({.opening = configuration.closed_width, .speed = 1000});
  return cycles_until(bench, [&](const MockGripper& gripper) {
    return *gripper.state()->opening == configuration.closed_width;
  });
}

void a_delay_is_rounded_up_to_cycles(void**) {
  for (const auto tells_after : {arm_tells_after, drive_tells_after, gripper_tells_after}) {
    assert_int_equal(tells_after(milliseconds(0)), 0);
    assert_int_equal(tells_after(milliseconds(30)), 3);
    assert_int_equal(tells_after(milliseconds(31)), 4);
  }
}

void a_delay_is_bounded(void**) {
  assert_int_equal(drive_tells_after(std::chrono::hours(1)), MockDelay<double>::most_cycles);
}

bool is_silent_late_and_heard_late() {
  DeviceBench<MockArm> bench{&six_axis};
  if (!bench.driver().initialise()) return false;
  bench.driver().set_delay(milliseconds(20));
  bench.receive(milliseconds(10));
  bench.driver().set_state(std::nullopt);
  const bool heard = bench.driver().state().has_value();
  const int gone = cycles_until(bench, [](const MockArm& arm) { return !arm.state(); });
  bench.driver().set_state(JointState{});
  const int back = cycles_until(bench, [](const MockArm& arm) { return arm.state().has_value(); });
  return heard && gone == 1 && back == 1;
}

void silence_is_delayed_too(void**) {
  assert_true(is_silent_late_and_heard_late());
}

/// Each cycle tells what was so 20 ms before, and says so.
// [robot-arm-13]
bool an_arm_tells_when_it_measured() {
  DeviceBench<MockArm> bench{&six_axis};
  if (!bench.driver().initialise()) return false;
  bench.driver().set_delay(milliseconds(20));
  for (int cycle = 0; cycle < 10; ++cycle) {
    bench.receive(milliseconds(10));
    if (cycle > 2 && bench.driver().measured_at() != bench.now() - milliseconds(20)) return false;
  }
  return true;
}

void a_delay_is_told(void**) {
  assert_true(an_arm_tells_when_it_measured());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(noise_is_bounded_and_seeded),
      cmocka_unit_test(a_delay_is_rounded_up_to_cycles),
      cmocka_unit_test(a_delay_is_bounded),
      cmocka_unit_test(silence_is_delayed_too),
      cmocka_unit_test(a_delay_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
