// What an arm that does not follow, or no longer says where it is, is told to be, and when.
#include "hal/robot_arm/interface/arm_supervision.hpp"

#include <array>
#include <string_view>

#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;

constexpr ArmSupervision::Limits limits{.following_time = 0.25, .silence = 0.5};
constexpr Time begin{std::chrono::seconds(1)};

struct Watch {
  explicit Watch(const ArmSupervision::Limits& with = limits) { supervision.begin(six_axis, with); }
  // Of the third joint, as a share of what may be.
  StatusCode behind(double share) {
    error[2] = share * 0.25 * six_axis.joints[2].velocity;
    found = supervision.look(JointState{}, error, true, now);
    return found.code();
  }
  StatusCode silent(Duration since_begin, bool may_move = true) {
    found = supervision.look(std::nullopt, error, may_move, begin + since_begin);
    return found.code();
  }
  bool names(const char* words) const {
    return std::string_view{found.cause()}.find(words) != std::string_view::npos;
  }

  Time now = begin;
  std::array<double, max_joints> error{};
  ArmSupervision supervision;
  Status found;
};

void a_joint_may_be_behind_for_its_time_and_no_more(void**) {
  Watch watch;
  assert_true(watch.behind(0.99) == StatusCode::ok);
  assert_true(watch.behind(-0.99) == StatusCode::ok);
  assert_true(watch.behind(1.01) == StatusCode::device_fault);
  assert_true(watch.names(six_axis.joints[2].name.data()) && watch.names("following_time"));
  assert_true(watch.behind(-1.01) == StatusCode::device_fault);
}

// [robot-arm-11]
void nothing_is_expected_of_an_arm_that_may_not_move(void**) {
  Watch watch;
  watch.behind(0);
  watch.error[2] = 100;
  assert_true(watch.supervision.look(JointState{}, watch.error, false, begin).is_ok());
  assert_true(watch.silent(milliseconds(5000), false) == StatusCode::ok);
  // The permission is new: it has its time again, and counts from its first word.
  assert_true(watch.silent(milliseconds(9000)) == StatusCode::ok);
}

void it_may_be_silent_for_its_time_and_no_more(void**) {
  Watch watch;
  assert_true(watch.behind(0) == StatusCode::ok);
  assert_true(watch.silent(milliseconds(500)) == StatusCode::ok);
  assert_true(watch.silent(milliseconds(501)) == StatusCode::unavailable);
  assert_true(watch.names("silence"));
}

void what_has_not_said_anything_yet_is_on_its_way(void**) {
  Watch watch;
  assert_true(watch.silent(milliseconds(60000)) == StatusCode::ok);
}

void zero_is_no_limit(void**) {
  Watch watch({.following_time = 0, .silence = 0});
  assert_true(watch.behind(1000) == StatusCode::ok);
  assert_true(watch.silent(milliseconds(60000)) == StatusCode::ok);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_joint_may_be_behind_for_its_time_and_no_more),
      cmocka_unit_test(nothing_is_expected_of_an_arm_that_may_not_move),
      cmocka_unit_test(it_may_be_silent_for_its_time_and_no_more),
      cmocka_unit_test(what_has_not_said_anything_yet_is_on_its_way),
      cmocka_unit_test(zero_is_no_limit),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
