#include <poll.h>

#include <cmath>
#include <vector>

#include "hal/camera/conformance/camera_eye.hpp"
#include "hal/camera/conformance/virtual_world.hpp"
#include "hal/camera/simulated/camera_scene.hpp"
#include "hal/camera/simulated/simulated_camera.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using SimulatedBench = CameraBench<SimulatedCamera>;
using std::chrono::milliseconds;

/// Middle of what is red in the row in the middle, in widths of the picture; below 0: nothing is.
double red_middle(const CameraImage& image) {
  const std::uint8_t* const row = image.data.data() + std::size_t{image.height / 2} * image.stride;
  std::uint32_t sum = 0;
  std::uint32_t count = 0;
  for (std::uint32_t x = 0; x < image.width; ++x) {
    const std::uint8_t* const pixel = row + std::size_t{x} * 3;
    if (pixel[0] != CameraScene::part_colour.red || pixel[1] != CameraScene::part_colour.green) continue;
    sum += x;
    ++count;
  }
  return count == 0 ? -1 : static_cast<double>(sum) / count / image.width;
}

bool the_part_passes_by() {
  SimulatedBench camera(CameraRequest{.format = PixelFormat::rgb24});
  camera.bench().configuration().part_period = 2;
  if (!camera.driver().initialise()) return false;
  Time origin{};
  int judged = 0;
  for (int cycle = 0; cycle < 300; ++cycle) {
    camera.bench().receive(milliseconds(10));
    const auto image = camera.driver().frame();
    if (!image) continue;
    if (origin == Time{}) origin = image->time;
    const double passed = seconds(image->time - origin) / 2;
    const double where = passed - static_cast<double>(static_cast<int>(passed));
    if (where < 0.2 || where > 0.8) continue;  // it is cut at the edges
    if (std::abs(red_middle(*image) - where) > 0.01) return false;
    ++judged;
  }
  return judged > 20;
}

void part(void**) {
  assert_true(the_part_passes_by());
}

bool faults_come_as_configured() {
  SimulatedBench camera(CameraRequest{});
  camera.bench().configuration().lose_every = 5;
  camera.bench().configuration().damage_every = 7;
  if (!camera.driver().initialise()) return false;
  for (int cycle = 0; cycle < 400; ++cycle) camera.bench().receive(milliseconds(10));
  const CameraFeedback& told = camera.bench().feedback();
  return told.lost_frames > 10 && told.damaged_frames > 10 && told.frames > 60 && told.losses == 0;
}

void faults(void**) {
  assert_true(faults_come_as_configured());
}

std::uint64_t sum_of_three(PixelFormat format) {
  SimulatedBench camera(CameraRequest{.format = format, .into_slot = true});
  if (!camera.driver().initialise()) return 0;
  SlotReader reader(camera.slot());
  std::uint64_t sum = 0;
  for (std::uint64_t seen = 0; seen < 3;) {
    camera.bench().receive(milliseconds(10));
    const ItemHeader* const header = reader.newest();
    if (header == nullptr || header->sequence == seen) continue;
    seen = header->sequence;
    // All of the item, to its last byte.
    const auto& frame = *static_cast<const CameraFrame*>(reader.payload());
    sum = sum * 31 + checksum({.data = frame.data()});
  }
  return sum;
}

void the_same_run_gives_the_same_items(void**) {
  for (const PixelFormat format : {PixelFormat::yuyv, PixelFormat::grey8, PixelFormat::nv12}) {
    const std::uint64_t sum = sum_of_three(format);
    assert_int_not_equal(sum, 0);
    assert_int_equal(sum, sum_of_three(format));
  }
}

/// Of one pixel, as a picture's data has it.
struct Sample {
  int y = 0;
  int u = 0;
  int v = 0;
  bool operator==(const Sample&) const = default;
};

Sample sample(const PictureCanvas& canvas, std::size_t column, std::size_t row) {
  if (canvas.format == PixelFormat::yuyv) {
    const std::uint8_t* const pair = &canvas.data[(row * canvas.width + column / 2 * 2) * 2];
    return {pair[column % 2 * 2], pair[1], pair[3]};
  }
  const std::size_t colour = (canvas.height + row / 2) * canvas.width + column / 2 * 2;
  return {canvas.data[row * canvas.width + column], canvas.data[colour], canvas.data[colour + 1]};
}

bool nv12_shows_what_yuyv_shows() {
  constexpr std::uint32_t width = 64;
  constexpr std::uint32_t height = 32;
  std::vector<std::uint8_t> pairs(std::size_t{width} * height * 2);
  std::vector<std::uint8_t> planes(std::size_t{width} * height * 3 / 2);
  const PictureCanvas in_pairs{pairs, width, height, PixelFormat::yuyv};
  const PictureCanvas in_planes{planes, width, height, PixelFormat::nv12};
  CameraScene::draw(in_pairs, 0.5, 0);
  CameraScene::draw(in_planes, 0.5, 0);
  const Sample part = sample(in_planes, width / 2, height / 2);
  // Through the part, and through the belt beside it; a mark is narrower than what shares a colour.
  for (std::size_t row = 0; row < height; ++row)
    for (const std::size_t column : {width / 2 - 1, width / 2 + 1, width / 2 + 5})
      if (sample(in_planes, column, row) != sample(in_pairs, column, row)) return false;
  return part.v > 180 && part.u < 110;
}

/// Of the part, which is red, and of the belt, which is grey.
bool other_formats_show_what_rgb_shows() {
  constexpr std::uint32_t width = 64;
  constexpr std::uint32_t height = 32;
  constexpr std::size_t on_part = height / 2 * width + width / 2;
  constexpr std::size_t on_belt = on_part + 6;
  std::vector<std::uint8_t> data(std::size_t{width} * height * 3);
  const auto drawn = [&data](PixelFormat format) -> const std::uint8_t* {
    CameraScene::draw({data, width, height, format}, 0.5, 0);
    return data.data();
  };
  const std::uint8_t* at = drawn(PixelFormat::rgb24);
  const int part[] = {at[on_part * 3], at[on_part * 3 + 1], at[on_part * 3 + 2]};
  const int belt[] = {at[on_belt * 3], at[on_belt * 3 + 1], at[on_belt * 3 + 2]};
  const auto mosaic_is = [&](PixelFormat format, std::size_t red, std::size_t blue) {
    at = drawn(format);
    for (std::size_t place = 0; place < 4; ++place) {
      const std::size_t channel = place == red ? 0 : place == blue ? 2 : 1;
      const std::size_t offset = place / 2 * width + place % 2;
      if (at[on_part + offset] != part[channel] || at[on_belt + offset] != belt[channel]) return false;
    }
    return true;
  };
  std::vector<std::uint8_t> pairs;
  at = drawn(PixelFormat::yuyv);
  pairs.assign(at, at + on_belt * 2 + 4);
  at = drawn(PixelFormat::uyvy);
  for (const std::size_t place : {on_part * 2, on_belt * 2})
    for (const std::size_t byte : {std::size_t{0}, std::size_t{2}})
      if (at[place + byte + 1] != pairs[place + byte] || at[place + byte] != pairs[place + byte + 1])
        return false;
  at = drawn(PixelFormat::grey16);
  if (at[on_part * 2 + 1] != pairs[on_part * 2] || at[on_part * 2] != 0) return false;
  return mosaic_is(PixelFormat::bayer_rggb8, 0, 3) && mosaic_is(PixelFormat::bayer_grbg8, 1, 2) &&
         mosaic_is(PixelFormat::bayer_gbrg8, 2, 1) && mosaic_is(PixelFormat::bayer_bggr8, 3, 0);
}

void colours(void**) {
  assert_true(nv12_shows_what_yuyv_shows());
  assert_true(other_formats_show_what_rgb_shows());
}

/// Its descriptor wakes whoever waits for the next picture.
bool pictures_come_by_the_clock_on_the_wall() {
  SimulatedBench camera(CameraRequest{});
  camera.bench().environment().virtual_time = false;
  if (!camera.driver().initialise()) return false;
  for (int turn = 0; turn < 1000; ++turn) {
    pollfd wanted{camera.driver().descriptor(), POLLIN, 0};
    if (poll(&wanted, 1, 30'000) != 1) return false;
    camera.bench().receive(MonotonicClock::now() - camera.bench().now());
    if (camera.bench().feedback().frames >= 3) return true;
  }
  return false;
}

/// A thread that comes two seconds late is not given sixty pictures.
bool what_came_too_long_ago_is_lost() {
  SimulatedBench camera(CameraRequest{});
  camera.bench().environment().virtual_time = false;
  if (!camera.driver().initialise()) return false;
  camera.bench().receive(milliseconds(10));
  camera.bench().receive(milliseconds(100));
  const std::uint64_t frames = camera.bench().feedback().frames;
  camera.bench().receive(milliseconds(2000));
  const auto image = camera.driver().frame();
  const CameraFeedback& told = camera.bench().feedback();
  return frames == 3 && told.frames <= frames + 3 && told.lost_frames > 50 && told.losses == 0 && image &&
         camera.bench().now() - image->time < milliseconds(40);
}

void late(void**) {
  assert_true(what_came_too_long_ago_is_lost());
}

void by_the_clock(void**) {
  assert_true(pictures_come_by_the_clock_on_the_wall());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(part),         cmocka_unit_test(faults),
      cmocka_unit_test(colours),      cmocka_unit_test(the_same_run_gives_the_same_items),
      cmocka_unit_test(by_the_clock), cmocka_unit_test(late),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_camera_conformance("simulated camera", []() -> std::unique_ptr<CameraWorld> {
           return std::make_unique<VirtualCameraWorld<SimulatedCamera>>();
         });
}
