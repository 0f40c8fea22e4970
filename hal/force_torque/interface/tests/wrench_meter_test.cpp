#include "hal/force_torque/interface/wrench_meter.hpp"

#include <cstring>

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;

constexpr Time origin{std::chrono::seconds(5)};

bool begun(WrenchMeter& meter, std::uint32_t tare_samples = 4) {
  return meter
      .begin("test", {.force_limit = {0, 0, 100}, .tare_samples = tare_samples, .max_age = milliseconds(50)})
      .is_ok();
}

// [force-torque-sensor-3]
void a_measurement_that_is_too_old_is_nothing(void**) {
  WrenchMeter meter;
  assert_true(begun(meter));
  meter.close(origin);
  assert_false(meter.state().has_value());
  assert_true(meter.age() == Duration::max());
  meter.take({{1, 2, 3}, {}}, origin);
  meter.close(origin + milliseconds(50));
  assert_true(meter.state().has_value());
  assert_true(meter.age() == milliseconds(50));
  meter.close(origin + milliseconds(51));
  assert_false(meter.state().has_value());
  assert_int_equal(meter.trouble().code(), StatusCode::unavailable);
}

void why_nothing_comes_is_told_when_the_newest_is_too_old(void**) {
  WrenchMeter meter;
  assert_true(begun(meter));
  meter.take({}, origin);
  meter.note_away(Status::error(StatusCode::not_permitted, "locked"));
  meter.close(origin + milliseconds(10));
  assert_true(meter.trouble().is_ok());
  meter.close(origin + milliseconds(60));
  assert_string_equal(meter.trouble().cause(), "locked");
  meter.take({}, origin + milliseconds(60));
  meter.close(origin + milliseconds(200));
  assert_int_equal(meter.trouble().code(), StatusCode::unavailable);
}

void a_measurement_that_no_longer_changes_is_not_believed(void**) {
  for (const bool judged : {true, false}) {
    WrenchMeter meter;
    const Duration limit = judged ? milliseconds(100) : milliseconds(0);
    assert_true(meter.begin("test", {.max_age = milliseconds(50), .frozen_after = limit}).is_ok());
    for (int ms = 0; ms < 300; ms += 10) {
      meter.take({{1, 2, 3}, {0, 0, ms < 150 ? ms * 1e-9 : 1}}, origin + milliseconds(ms));
      meter.close(origin + milliseconds(ms));
      const bool is_frozen = judged && ms >= 250;
      assert_int_equal(meter.trouble().code(), is_frozen ? StatusCode::device_fault : StatusCode::ok);
      assert_true(meter.state().has_value() != is_frozen);
    }
    meter.take({{1, 2, 3.1}, {0, 0, 1}}, origin + milliseconds(300));
    meter.close(origin + milliseconds(300));
    assert_true(meter.trouble().is_ok() && meter.state().has_value());
  }
}

/// Loads differ while it is taken.
// [force-torque-sensor-7]
void a_tare_is_a_mean(void**) {
  WrenchMeter meter;
  assert_true(begun(meter));
  meter.tare();  // of what?
  assert_false(meter.is_taring());
  meter.take({}, origin);
  meter.close(origin);
  meter.tare();
  for (int i = 0; i < 4; ++i) {
    assert_true(meter.is_taring());
    meter.take({{i * 2.0, 0, 0}, {0, -1.0 * i, 0}}, origin);
  }
  assert_false(meter.is_taring());
  meter.take({}, origin);
  meter.close(origin);
  assert_true(meter.state()->force[0] == -3);
  assert_true(meter.state()->torque[1] == 1.5);
}

// [force-torque-sensor-9]
void a_tare_that_is_given_up_leaves_the_one_before(void**) {
  WrenchMeter meter;
  assert_true(begun(meter, 2));
  meter.take({}, origin);
  meter.close(origin);
  meter.tare();
  for (int i = 0; i < 2; ++i) meter.take({{10, 0, 0}, {}}, origin);
  meter.tare();
  meter.take({{99, 0, 0}, {}}, origin);
  meter.take({{99, 0, 101}, {}}, origin);  // an overload
  assert_false(meter.is_taring());
  meter.take({{10, 0, 0}, {}}, origin);
  meter.close(origin);
  assert_true(meter.state()->tared);
  assert_true(meter.state()->force[0] == 0);
}

// [force-torque-sensor-10]
void a_tare_stays_while_the_sensor_is_away(void**) {
  WrenchMeter meter;
  assert_true(begun(meter, 2));
  meter.take({}, origin);
  meter.close(origin);
  meter.tare();
  for (int i = 0; i < 2; ++i) meter.take({{10, 0, 0}, {}}, origin);
  meter.note_away(Status::error(StatusCode::unavailable, "unplugged"));
  meter.close(origin + std::chrono::minutes(1));
  assert_false(meter.state().has_value());
  meter.take({{12, 0, 0}, {}}, origin + std::chrono::minutes(2));
  meter.close(origin + std::chrono::minutes(2));
  assert_true(meter.state()->tared);
  assert_true(meter.state()->force[0] == 2);
}

void what_is_beyond_is_said_with_its_axis(void**) {
  WrenchMeter meter;
  assert_true(begun(meter));
  meter.take({{500, 0, -101.5}, {}}, origin);
  meter.close(origin);
  assert_non_null(std::strstr(meter.trouble().cause(), "-101.5 N along the sensor's z"));
  assert_true(meter.state()->overload);
}

void what_was_missed_has_its_numbers(void**) {
  WrenchMeter meter;
  assert_true(begun(meter));
  meter.take({}, origin);
  meter.take({}, origin, 5);
  meter.close(origin);
  assert_int_equal(meter.state()->sequence, 7);
  ForceTorqueSensorFeedback told;
  meter.fill(told);
  assert_int_equal(told.lost, 5);
  assert_int_equal(told.samples, 2);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_measurement_that_is_too_old_is_nothing),
      cmocka_unit_test(why_nothing_comes_is_told_when_the_newest_is_too_old),
      cmocka_unit_test(a_measurement_that_no_longer_changes_is_not_believed),
      cmocka_unit_test(a_tare_is_a_mean),
      cmocka_unit_test(a_tare_that_is_given_up_leaves_the_one_before),
      cmocka_unit_test(a_tare_stays_while_the_sensor_is_away),
      cmocka_unit_test(what_is_beyond_is_said_with_its_axis),
      cmocka_unit_test(what_was_missed_has_its_numbers),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
