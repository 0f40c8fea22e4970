// The emitted text, compiled: the constant must be the arm of the URDF.
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using flexrf::six_axis;

static_assert(six_axis.joint_count == 6);
static_assert(six_axis.joints[4].axis[1] == 1.0);
static_assert(six_axis.joints[1].origin.position[0] == 0.16);

void test_emitted_chain_is_the_urdf(void**) {
  assert_true(six_axis.name == "six_axis");
  assert_true(six_axis.joints[0].name == "axis_1");
  assert_true(six_axis.joints[0].lower == -2.967);
  assert_true(six_axis.joints[3].velocity == 5.58);
  assert_true(six_axis.joints[5].acceleration == 30.0);
  assert_true(six_axis.joints[5].jerk == 400.0);
  assert_true(six_axis.joints[4].home == 1.5707963267948966);
  assert_true(six_axis.joints[6].name.empty());
  // The tool's z is the flange's x.
  assert_true(six_axis.tool.rotation[6] == 1.0);
  assert_true(six_axis.tool.position[0] == 0.1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_emitted_chain_is_the_urdf)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
