#include "hal/camera/conformance/camera_eye.hpp"
#include "hal/camera/conformance/virtual_world.hpp"
#include "hal/camera/scene/tests/still_camera.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;

using StillBench = CameraBench<StillCamera>;

/// Of the part at the time that the picture says, which is a period before it came.
bool pictures_show_the_middle_of_their_exposure() {
  StillBench camera(CameraRequest{.width = 640, .height = 480, .format = PixelFormat::rgb24});
  if (!camera.driver().initialise()) return false;
  int judged = 0;
  for (int cycle = 0; cycle < 100; ++cycle) {
    camera.bench().receive(milliseconds(1));
    const auto image = camera.driver().frame();
    if (!image) continue;
    const Duration age = camera.bench().now() - image->time;
    if (age < milliseconds(33) || age > milliseconds(35)) return false;
    // The lens is 50 mm along x from the tool, 450 above the table; the part's upper side is at 25.
    const double x = 0.45 + 0.1 * seconds(image->time - Time{std::chrono::seconds(1)});
    const double expected = 239.5 - 600 * (x - 0.45) / 0.425;
    const auto middle = blue_middle(*image);
    if (!(std::abs(middle[1] - expected) < 0.7) || !(std::abs(middle[0] - 319.5) < 0.7)) return false;
    ++judged;
  }
  return judged >= 2;
}

bool a_calibration_may_be_off() {
  const auto seen = [](double orientation_error, std::uint64_t seed) {
    StillBench camera(CameraRequest{.width = 640, .height = 480, .format = PixelFormat::rgb24});
    camera.bench().configuration().orientation_error = orientation_error;
    camera.bench().environment().seed = seed;
    std::array<double, 2> middle{};
    if (!camera.driver().initialise()) return middle;
    for (int cycle = 0; cycle < 10; ++cycle) {
      camera.bench().receive(milliseconds(10));
      if (const auto image = camera.driver().frame()) middle = blue_middle(*image);
    }
    return middle;
  };
  const auto told = seen(0, 1);
  const auto off = seen(0.02, 1);
  const auto other = seen(0.02, 2);
  const double way = std::hypot(off[0] - told[0], off[1] - told[1]);
  const double between = std::hypot(off[0] - other[0], off[1] - other[1]);
  return way > 0.5 && way < 13 && between > 0.5;
}

/// Nothing is connected: it says so, and gives no pictures.
bool without_a_scene_it_is_away() {
  CameraBench<SceneCamera> camera(CameraRequest{});
  if (!camera.driver().initialise()) return false;
  for (int cycle = 0; cycle < 50; ++cycle) {
    camera.bench().receive(milliseconds(10));
    if (camera.driver().frame()) return false;
  }
  const CameraFeedback& told = camera.bench().feedback();
  return !told.present && text_view(told.trouble).find("scene") != std::string_view::npos;
}

bool what_makes_no_sense_is_refused() {
  StillBench slow(CameraRequest{});
  slow.bench().configuration().exposure = 0.05;
  StillBench turned(CameraRequest{});
  turned.bench().configuration().hand_eye_orientation = {};
  return slow.driver().initialise().code() == StatusCode::invalid_argument &&
         turned.driver().initialise().code() == StatusCode::invalid_argument;
}

void exposure(void**) {
  assert_true(pictures_show_the_middle_of_their_exposure());
}
void calibration(void**) {
  assert_true(a_calibration_may_be_off());
}
void away(void**) {
  assert_true(without_a_scene_it_is_away());
}
void refusals(void**) {
  assert_true(what_makes_no_sense_is_refused());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(exposure),
      cmocka_unit_test(calibration),
      cmocka_unit_test(away),
      cmocka_unit_test(refusals),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_camera_conformance("scene camera", []() -> std::unique_ptr<CameraWorld> {
           return std::make_unique<VirtualCameraWorld<StillCamera>>();
         });
}
