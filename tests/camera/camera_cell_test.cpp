// A cell with a camera that goes away and comes back, on mock and simulator, in real time.
#include "hal/camera/mock/mock_camera.hpp"
#include "hal/camera/simulated/simulated_camera.hpp"
#include "tests/camera/running_belt.hpp"

namespace flexrf::whole {
namespace {

template <class Driver>
void it_comes_back(const char* driver) {
  RunningBelt belt(driver);
  CameraCable& cable = static_cast<Driver&>(belt.camera()).cable();
  it_goes_away_and_comes_back(
      belt, [&] { cable.plugged = false; }, [&] { cable.plugged = true; });
}

void a_mock_camera_comes_back() {
  it_comes_back<MockCamera>("mock");
}
void a_simulated_camera_comes_back() {
  it_comes_back<SimulatedCamera>("simulated");
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {TEST_APART(a_mock_camera_comes_back),
                              TEST_APART(a_simulated_camera_comes_back)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
