#include "hal/camera/conformance/camera_eye.hpp"
#include "hal/camera/conformance/virtual_world.hpp"
#include "hal/camera/mock/mock_camera.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using MockBench = CameraBench<MockCamera>;

bool a_scripted_camera_keeps_to_its_script() {
  using std::chrono::milliseconds;
  MockBench camera(CameraRequest{.width = 8, .height = 4, .format = PixelFormat::grey8, .silence = 0.5});
  camera.driver().script({{{milliseconds(20), 0, false}, 10},
                          {{milliseconds(30), 2, false}, 20},
                          {{milliseconds(10), 0, true}, 30},
                          {{milliseconds(50), 0, false}, 40}});
  if (!camera.driver().initialise()) return false;
  std::vector<int> seen;
  std::vector<std::int64_t> at;
  const Time start = camera.bench().now() + milliseconds(10);  // of the first cycle
  for (int cycle = 0; cycle < 100; ++cycle) {
    camera.bench().receive(milliseconds(10));
    const auto image = camera.driver().frame();
    if (!image) continue;
    seen.push_back(image->data[5]);
    at.push_back((image->time - start) / milliseconds(1));
  }
  const CameraFeedback& told = camera.bench().feedback();
  return seen == std::vector<int>{10, 20, 40} && at == std::vector<std::int64_t>{20, 50, 110} &&
         told.lost_frames == 2 && told.damaged_frames == 1 && told.losses == 1 && !told.present;
}

void scripted(void**) {
  assert_true(a_scripted_camera_keeps_to_its_script());
}

std::uint64_t noisy_sum(std::uint64_t seed) {
  MockBench camera(CameraRequest{.width = 64, .height = 64});
  camera.bench().configuration().noise = 5;
  camera.bench().environment().seed = seed;
  if (!camera.driver().initialise()) return 0;
  for (int cycle = 0; cycle < 100 && !camera.driver().frame(); ++cycle)
    camera.bench().receive(std::chrono::milliseconds(10));
  const auto image = camera.driver().frame();
  return image ? checksum(*image) : 0;
}

void noise_is_seeded(void**) {
  const std::uint64_t one = noisy_sum(1);
  assert_int_not_equal(one, 0);
  assert_int_equal(one, noisy_sum(1));
  assert_int_not_equal(one, noisy_sum(2));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {cmocka_unit_test(scripted), cmocka_unit_test(noise_is_seeded)};
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_camera_conformance("mock camera", []() -> std::unique_ptr<CameraWorld> {
           return std::make_unique<VirtualCameraWorld<MockCamera>>();
         });
}
