// From a camera that compresses to a unit's pixels: the red part is where the camera saw it.
#include <cmath>
#include <cstdlib>
#include <memory>

#include "hal/camera/conformance/camera_bench.hpp"
#include "hal/camera/simulated/camera_scene.hpp"
#include "hal/camera/simulated/simulated_camera.hpp"
#include "tests/cmocka.hpp"
#include "units/jpeg_decoder/jpeg_decoder.hpp"
#include "units/unit_bench.hpp"

namespace flexrf {
namespace {

using namespace user;

using std::chrono::milliseconds;

/// Middle of what is red in the row in the middle, in widths of the picture; below 0: nothing is.
double red_middle(const CameraFrame& frame) {
  const std::uint8_t* const row = frame.data().data() + std::size_t{frame.height / 2} * frame.stride;
  std::uint32_t sum = 0;
  std::uint32_t count = 0;
  for (std::uint32_t x = 0; x < frame.width; ++x) {
    const std::uint8_t* const pixel = row + std::size_t{x} * 3;
    if (std::abs(pixel[0] - CameraScene::part_colour.red) > 30 ||
        std::abs(pixel[1] - CameraScene::part_colour.green) > 30)
      continue;
    sum += x;
    ++count;
  }
  return count == 0 ? -1 : static_cast<double>(sum) / count / frame.width;
}

struct Belt {
  CameraBench<SimulatedCamera> camera{CameraRequest{.format = PixelFormat::mjpeg, .into_slot = true}};
  SlotReader pictures{camera.slot()};
  SlotBench<CameraFrame> pixels;
  SlotReader seen{&pixels.control()};
  UnitBench<JpegDecoder> decoder;
  InputBinding inputs[1] = {{&pictures, 1, {}, nullptr}};
  SlotControl* outputs[1] = {&pixels.control()};

  Belt() {
    UnitBinding binding;
    binding.context = &decoder.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    decoder.unit().connect(binding);
    camera.bench().configuration().part_period = 2;
    camera.bench().configuration().damage_every = 7;
  }
};

bool the_part_is_found_in_what_was_decoded() {
  const auto place = std::make_unique<Belt>();  // too large for a stack
  Belt& belt = *place;
  if (!belt.camera.driver().initialise() || !belt.decoder.unit().initialise()) return false;
  std::uint64_t sequence = 0;
  std::int64_t origin = 0;
  int judged = 0;
  for (int cycle = 0; cycle < 180; ++cycle) {
    belt.camera.bench().receive(milliseconds(10));
    belt.decoder.step(milliseconds(10));
    if (belt.seen.newest() == nullptr) continue;
    const auto& frame = *static_cast<const CameraFrame*>(belt.seen.payload());
    if (frame.sequence == sequence) continue;
    sequence = frame.sequence;
    if (origin == 0) origin = frame.time;
    const double where = static_cast<double>(frame.time - origin) / 2e9;
    if (where < 0.2 || where > 0.8) continue;  // it is cut at the edges
    if (std::abs(red_middle(frame) - where) > 0.01) return false;
    ++judged;
  }
  const CameraFeedback& told = belt.camera.bench().feedback();
  return judged > 20 && told.damaged_frames > 5 && belt.decoder.feedback().damaged == 0 &&
         belt.decoder.feedback().pictures == told.frames;
}

void decoded_belt(void**) {
  assert_true(the_part_is_found_in_what_was_decoded());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {cmocka_unit_test(decoded_belt)};
  return cmocka_run_group_tests_name("mjpeg belt", tests, nullptr, nullptr);
}
