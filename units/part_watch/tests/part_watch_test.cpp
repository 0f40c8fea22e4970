#include "units/part_watch/part_watch.hpp"

#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "runtime/blackboard/sized_slot.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

constexpr std::uint32_t width = 40;
constexpr std::uint32_t height = 20;

/// A picture of one grey, with a brighter field in columns 16 to 23, rows 8 to 11: the usual window.
struct World {
  UnitBench<PartWatch> bench;
  SlotBench<CameraFrame> picture;
  SlotBench<PartSight> sight;
  InputBinding inputs[1] = {picture.input(std::chrono::seconds(2))};
  SlotControl* outputs[1] = {&sight.control()};
  SizedItem<CameraFrame> memory;
  CameraFrame& frame = *memory;

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    bench.unit().connect(binding);
  }
  void draw(PixelFormat format, std::uint32_t bytes, std::uint8_t ground, std::uint8_t field) {
    frame.width = width;
    frame.height = height;
    frame.stride = width * bytes + 6;  // with padding
    frame.format = format;
    std::memset(frame.data().data(), 255, frame.data().size());
    for (std::uint32_t row = 0; row < height; ++row) {
      for (std::uint32_t column = 0; column < width; ++column) {
        const bool inside = row >= 8 && row < 12 && column >= 16 && column < 24;
        std::memset(frame.data().data() + std::size_t{row} * frame.stride + std::size_t{column} * bytes,
                    inside ? field : ground, bytes);
      }
    }
  }
  void look() {
    picture.publish(frame, bench.now());
    bench.step(std::chrono::milliseconds(10));
  }
};

// In here, so that a failing assertion jumps over no destructor.
bool sees(PixelFormat format, std::uint32_t bytes) {
  const auto world = std::make_unique<World>();
  world->draw(format, bytes, 0, 204);
  world->look();
  const auto seen = world->sight.latest();
  const bool bright = seen && seen->seen && std::abs(seen->brightness - 0.8) < 0.01;
  world->draw(format, bytes, 255, 51);
  world->look();
  const auto dark = world->sight.latest();
  return bright && dark && !dark->seen && std::abs(dark->brightness - 0.2) < 0.01;
}

bool a_dark_part_can_be_looked_for() {
  const auto world = std::make_unique<World>();
  world->bench.runtime().part_is_bright = false;
  world->draw(PixelFormat::grey8, 1, 255, 51);
  world->look();
  const auto seen = world->sight.latest();
  return seen && seen->seen;
}

bool a_window_beyond_the_picture_is_cut() {
  const auto world = std::make_unique<World>();
  world->bench.runtime().window = {1, 1, 1, 1};
  world->draw(PixelFormat::grey8, 1, 102, 0);
  world->look();
  const auto seen = world->sight.latest();
  return seen && std::abs(seen->brightness - 0.4) < 0.01;
}

bool what_it_cannot_judge_it_does_not(void (*spoil)(CameraFrame&)) {
  const auto world = std::make_unique<World>();
  world->draw(PixelFormat::grey8, 1, 0, 204);
  spoil(world->frame);
  world->look();
  return !world->sight.latest() && !world->bench.feedback().trouble_view().empty();
}

void in_every_format(void**) {
  assert_true(sees(PixelFormat::grey8, 1));
  assert_true(sees(PixelFormat::yuyv, 2));
  assert_true(sees(PixelFormat::rgb24, 3));
  assert_true(sees(PixelFormat::bgr24, 3));
  assert_true(sees(PixelFormat::nv12, 1));
  assert_true(sees(PixelFormat::uyvy, 2));
  assert_true(sees(PixelFormat::grey16, 2));
}
void dark_parts(void**) {
  assert_true(a_dark_part_can_be_looked_for());
}
void window_at_the_edge(void**) {
  assert_true(a_window_beyond_the_picture_is_cut());
}
void damaged_pictures(void**) {
  assert_true(what_it_cannot_judge_it_does_not([](CameraFrame& frame) { frame.format = PixelFormat::none; }));
  assert_true(
      what_it_cannot_judge_it_does_not([](CameraFrame& frame) { frame.format = PixelFormat::mjpeg; }));
  assert_true(
      what_it_cannot_judge_it_does_not([](CameraFrame& frame) { frame.format = PixelFormat::bayer_rggb8; }));
  assert_true(what_it_cannot_judge_it_does_not([](CameraFrame& frame) { frame.width = 0; }));
  assert_true(what_it_cannot_judge_it_does_not([](CameraFrame& frame) { frame.stride = width - 1; }));
  assert_true(what_it_cannot_judge_it_does_not([](CameraFrame& frame) { frame.height = 4'000'000; }));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(in_every_format), cmocka_unit_test(dark_parts),
                              cmocka_unit_test(window_at_the_edge), cmocka_unit_test(damaged_pictures)};
  return cmocka_run_group_tests_name("part watch", tests, nullptr, nullptr);
}
