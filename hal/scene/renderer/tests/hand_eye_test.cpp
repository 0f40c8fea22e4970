#include "hal/scene/renderer/hand_eye.hpp"

#include <cmath>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

HandEye told() {
  HandEye eye;
  eye.pose.translation() = Eigen::Vector3d(0.055, 0, 0);
  return eye;
}

bool errors_are_as_large_as_asked() {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const HandEye real =
        disturbed(told(), {.position = 0.001, .orientation = 0.0035, .focal_length = 0.005}, seed);
    const double aside = (real.pose.translation() - told().pose.translation()).norm();
    const double turn = Eigen::AngleAxisd(Eigen::Matrix3d(real.pose.linear())).angle();
    if (std::abs(aside - 0.001) > 1e-12 || std::abs(turn - 0.0035) > 1e-9 ||
        std::abs(std::abs(real.focal_length - 600) - 3) > 1e-9)
      return false;
  }
  return true;
}

bool the_seed_says_where_to() {
  const HandEyeErrors errors{.position = 0.001, .orientation = 0.0035, .focal_length = 0.005};
  const HandEye one = disturbed(told(), errors, 3);
  const HandEye same = disturbed(told(), errors, 3);
  const HandEye other = disturbed(told(), errors, 4);
  return one.pose.matrix() == same.pose.matrix() && one.pose.matrix() != other.pose.matrix();
}

bool without_errors_it_is_as_told() {
  const HandEye real = disturbed(told(), {}, 3);
  return real.pose.matrix() == told().pose.matrix() && real.focal_length == 600;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<errors_are_as_large_as_asked>),
      cmocka_unit_test(judged<the_seed_says_where_to>),
      cmocka_unit_test(judged<without_errors_it_is_as_told>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
