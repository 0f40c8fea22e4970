// Pictures are made by libturbojpeg, garbled here, and decoded by the unit.
#include "units/jpeg_decoder/jpeg_decoder.hpp"

#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "hal/camera/interface/jpeg_maker.hpp"
#include "runtime/blackboard/sized_slot.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

constexpr std::uint32_t width = 50;
constexpr std::uint32_t height = 30;

struct World {
  UnitBench<JpegDecoder> bench;
  SlotBench<CameraFrame> picture;
  SlotBench<CameraFrame> pixels;
  InputBinding inputs[1] = {picture.input(std::chrono::seconds(2))};
  SlotControl* outputs[1] = {&pixels.control()};
  SlotReader reader{&pixels.control()};
  SizedItem<CameraFrame> memory;
  CameraFrame& frame = *memory;
  std::string said;

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    bench.unit().connect(binding);
    make();
  }
  Status begin(PixelFormat format) {
    static_cast<JpegDecoder::Configuration*>(bench.unit().parameter_memory().configuration)->format = format;
    return bench.unit().initialise();
  }
  /// Red above, green below; so many strips that there is much to garble.
  void make() {
    JpegMaker maker;
    if (!maker.begin(width, height)) std::abort();
    for (std::size_t i = 0; i < std::size_t{width} * height; ++i)
      maker.canvas()[i * 3 + (i < std::size_t{width} * height / 2 ? 0 : 1)] = 255;
    const auto jpeg = maker.make(frame.data().size());
    frame.size = static_cast<std::uint32_t>(jpeg.size());
    std::memcpy(frame.data().data(), jpeg.data(), jpeg.size());
    frame.format = PixelFormat::mjpeg;
    frame.width = width;
    frame.height = height;
    frame.time = 77;
    frame.sequence = 5;
  }
  void look() {
    picture.publish(frame, bench.now());
    bench.step(std::chrono::milliseconds(10));
    said = bench.feedback().trouble_view();
    if (!said.empty()) print_message("%s\n", said.c_str());
  }
  /// What it published last; null: nothing yet.
  const CameraFrame* seen() {
    return reader.newest() == nullptr ? nullptr : static_cast<const CameraFrame*>(reader.payload());
  }
  /// What it is given now is counted and not given on.
  bool is_left_out() {
    const std::uint64_t damaged = bench.feedback().damaged;
    look();
    return seen() == nullptr && bench.feedback().damaged == damaged + 1 && bench.feedback().pictures == 0 &&
           !said.empty();
  }
};

bool is_near(int value, int wanted) {
  return std::abs(value - wanted) < 12;
}

// In here, so that a failing assertion jumps over no destructor.
bool decodes_to(PixelFormat format, std::size_t bytes, int red_above, int red_below) {
  const auto world = std::make_unique<World>();
  if (!world->begin(format)) return false;
  world->look();
  if (world->seen() == nullptr) return false;
  const CameraFrame& picture = *world->seen();
  const std::size_t red = format == PixelFormat::bgr24 ? 2 : 0;
  return picture.format == format && picture.width == width && picture.height == height &&
         picture.stride == width * bytes && picture.size == picture.stride * height && picture.time == 77 &&
         picture.sequence == 5 && is_near(picture.data()[2 * picture.stride + red], red_above) &&
         is_near(picture.data()[28 * picture.stride + red], red_below) &&
         world->bench.feedback().pictures == 1 && world->said.empty();
}

void to_pixels(void**) {
  assert_true(decodes_to(PixelFormat::rgb24, 3, 254, 0));
  assert_true(decodes_to(PixelFormat::bgr24, 3, 254, 0));
  assert_true(decodes_to(PixelFormat::grey8, 1, 76, 150));
}

void a_format_it_does_not_make_is_refused(void**) {
  assert_int_equal(std::make_unique<World>()->begin(PixelFormat::nv12).code(), StatusCode::invalid_argument);
}

bool a_truncated_one_is_left_out(std::uint32_t size) {
  const auto world = std::make_unique<World>();
  if (!world->begin(PixelFormat::rgb24)) return false;
  world->frame.size = size == 0 ? world->frame.size / 2 : size;
  return world->is_left_out();
}

/// What a check of the markers does not see: some of its data is other than was sent.
bool a_garbled_one_is_left_out() {
  const auto world = std::make_unique<World>();
  if (!world->begin(PixelFormat::rgb24)) return false;
  // The end of the data, in front of the end's marker, is gone.
  world->frame.size -= 12;
  world->frame.data()[world->frame.size - 2] = 0xFF;
  world->frame.data()[world->frame.size - 1] = 0xD9;
  return world->is_left_out();
}

/// And the next good one is given on.
bool what_is_no_jpeg_is_left_out() {
  const auto world = std::make_unique<World>();
  if (!world->begin(PixelFormat::rgb24)) return false;
  std::memset(world->frame.data().data(), 0x55, 1000);
  if (!world->is_left_out()) return false;
  world->make();
  world->look();
  return world->seen() != nullptr && world->said.empty();
}

bool an_uncompressed_one_is_told() {
  const auto world = std::make_unique<World>();
  if (!world->begin(PixelFormat::rgb24)) return false;
  world->frame.format = PixelFormat::yuyv;
  world->look();
  return world->seen() == nullptr && world->said.find("not compressed") != std::string::npos;
}

void damaged_ones(void**) {
  assert_true(a_truncated_one_is_left_out(0));
  assert_true(a_truncated_one_is_left_out(20));
  assert_true(a_truncated_one_is_left_out(0xFFFF'FFFF));
  assert_true(a_garbled_one_is_left_out());
  assert_true(what_is_no_jpeg_is_left_out());
}
void uncompressed_ones(void**) {
  assert_true(an_uncompressed_one_is_told());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(to_pixels),
                              cmocka_unit_test(a_format_it_does_not_make_is_refused),
                              cmocka_unit_test(damaged_ones), cmocka_unit_test(uncompressed_ones)};
  return cmocka_run_group_tests_name("jpeg decoder", tests, nullptr, nullptr);
}
