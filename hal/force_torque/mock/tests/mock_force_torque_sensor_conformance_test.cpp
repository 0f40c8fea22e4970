#include "hal/force_torque/conformance/sensor_bench.hpp"
#include "hal/force_torque/mock/mock_force_torque_sensor.hpp"
#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;

class MockWorld final : public BenchWorld<MockForceTorqueSensor> {
 public:
  Status start(const ForceTorqueSetting& setting) override {
    configure_sensor(bench().configuration(), setting, 0.1);
    return driver().initialise();
  }
  void receive() override { advance(milliseconds(5)); }
  void load(const std::array<double, 3>& force, const std::array<double, 3>& torque) override {
    load_ = {force, torque};
    driver().set_load(load_);
  }
  bool make(SensorFarEnd behaviour) override {
    driver().set_silent(behaviour == SensorFarEnd::silent || behaviour == SensorFarEnd::off ||
                        behaviour == SensorFarEnd::unplugged);
    driver().set_fault(behaviour == SensorFarEnd::faulty
                           ? Status::error(StatusCode::device_fault, "the mock's sensor is broken")
                           : Status{});
    driver().damage(behaviour == SensorFarEnd::damaged || behaviour == SensorFarEnd::truncated ? 1'000'000
                                                                                               : 0);
    load_.saturated = behaviour == SensorFarEnd::saturated;
    driver().set_load(load_);
    return behaviour != SensorFarEnd::foreign;
  }
  bool lose(std::uint32_t count) override {
    driver().lose(count);
    return true;
  }

 private:
  RawWrench load_;
};

struct Noise {
  double least = 1e9;
  double most = -1e9;
  double sum = 0;
};

Noise noise_of(std::uint64_t seed) {
  DeviceBench<MockForceTorqueSensor> bench(nullptr);
  bench.configuration().force_noise = 2;
  bench.environment().seed = seed;
  Noise noise;
  if (!bench.driver().initialise()) return noise;
  for (int i = 0; i < 1000; ++i) {
    bench.receive(milliseconds(10));
    const double force = bench.driver().state()->force[1];
    noise.least = std::min(noise.least, force);
    noise.most = std::max(noise.most, force);
    noise.sum += force * i;
  }
  return noise;
}

// Who reads the log alone sees it, once when it begins and once when it ends.
bool says_in_the_log_what_is_wrong(bool is_frozen) {
  DeviceBench<MockForceTorqueSensor> bench(nullptr);
  bench.configuration().frozen_after = 0.5;
  if (!bench.driver().initialise()) return false;
  const auto run_for = [&](int cycles, bool is_loaded) {
    for (int i = 0; i < cycles; ++i) {
      if (is_loaded) bench.driver().set_load({{1.0 * i, 0, 0}, {}});
      bench.receive(milliseconds(10));
    }
  };
  const LogEar start;
  run_for(100, true);
  if (start.has_heard("warning")) return false;
  const LogEar ear;
  if (is_frozen) {
    run_for(100, false);
    return ear.has_heard("the same to the last digit") && !bench.driver().state();
  }
  bench.driver().set_silent(true);
  run_for(100, true);
  if (!ear.has_heard("nothing is heard from the sensor") || ear.has_heard("well again")) return false;
  bench.driver().set_silent(false);
  run_for(200, true);
  return ear.has_heard("well again") && !ear.has_heard("the same to the last digit");
}

void troubles_are_in_the_log(void**) {
  assert_true(says_in_the_log_what_is_wrong(false));
  assert_true(says_in_the_log_what_is_wrong(true));
}

void noise_is_bounded_and_seeded(void**) {
  const Noise one = noise_of(1);
  assert_true(one.least >= -2 && one.least < -1.8 && one.most <= 2 && one.most > 1.8);
  assert_true(one.sum == noise_of(1).sum);
  assert_true(one.sum != noise_of(2).sum);
}

bool delayed_measurements_are_old() {
  DeviceBench<MockForceTorqueSensor> bench(nullptr);
  if (!bench.driver().initialise()) return false;
  bench.driver().set_delay(milliseconds(25));
  int heard = 0;
  for (int i = 0; i < 20; ++i) {
    bench.receive(milliseconds(10));
    heard += bench.driver().state().has_value() ? 1 : 0;
  }
  return heard == 17;  // from the third cycle after the first one on
}

void delays(void**) {
  assert_true(delayed_measurements_are_old());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {cmocka_unit_test(troubles_are_in_the_log),
                              cmocka_unit_test(noise_is_bounded_and_seeded), cmocka_unit_test(delays)};
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_force_torque_conformance("mock force-torque sensor", []() -> std::unique_ptr<ForceTorqueWorld> {
           return std::make_unique<MockWorld>();
         });
}
