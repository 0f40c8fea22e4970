// A cell with the real driver on the kernel's virtual camera: the kernel fills what the unit sees, and the
// camera goes away and comes back.
#include "hal/camera/v4l2/tests/vivid.hpp"
#include "tests/camera/running_belt.hpp"
#include "tests/recovery.hpp"

namespace flexrf::whole {
namespace {

void a_real_camera_comes_back_and_nothing_was_copied() {
  Vivid vivid;
  vivid.restore();
  vivid.plug_in();
  RunningBelt belt("v4l2");
  CHECK(belt.pictures_come());
  CHECK_EQUAL(belt.told("camera").at("copied_bytes").get<int>(), 0);
  const Duration took = it_goes_away_and_comes_back(
      belt, [&] { CHECK(vivid.unplug()); }, [&] { vivid.plug_in(); });
  CHECK(is_back_in_time("the camera's absence", took));
}

void a_silent_camera_is_told_and_comes_back() {
  Vivid vivid;
  vivid.restore();
  RunningBelt belt("v4l2");
  CHECK(belt.pictures_come());
  CHECK(vivid.set("Percentage of Dropped Buffers", 100));
  CHECK(belt.becomes("camera", "present", false));
  CHECK(belt.becomes("finder", "sees", false));
  CHECK_CONTAINS(belt.trouble(), "no pictures");
  CHECK(vivid.set("Percentage of Dropped Buffers", 0));
  const Time heard = MonotonicClock::now();
  CHECK(belt.becomes("finder", "sees", true));
  CHECK(is_back_in_time("the camera's silence", MonotonicClock::now() - heard));
  CHECK(belt.pictures_come());
  CHECK(belt.becomes("camera", "recoveries", 1));
  belt.check_ends_well();
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {TEST_APART(a_real_camera_comes_back_and_nothing_was_copied),
                              TEST_APART(a_silent_camera_is_told_and_comes_back)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
