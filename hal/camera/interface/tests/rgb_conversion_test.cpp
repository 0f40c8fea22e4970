#include "hal/camera/interface/rgb_conversion.hpp"

#include <cstdlib>
#include <vector>

#include "hal/camera/interface/picture_size.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

constexpr std::uint32_t width = 4;
constexpr std::uint32_t height = 2;

// Two red pixels, two white ones; below them two blue ones, two of a dark grey.
const std::vector<std::uint8_t> picture{200, 0, 0,   200, 0, 0,   255, 255, 255, 255, 255, 255,
                                        0,   0, 200, 0,   0, 200, 60,  60,  60,  60,  60,  60};

std::vector<std::uint8_t> converted(PixelFormat format) {
  std::vector<std::uint8_t> data(picture_bytes(format, row_bytes(format, width), height), 99);
  convert_rgb(picture, width, height, format, data);
  return data;
}

bool is_about(int one, int other) {
  return std::abs(one - other) <= 1;
}

bool brightness_is_by_the_standard() {
  const auto grey = converted(PixelFormat::grey8);
  const auto deep = converted(PixelFormat::grey16);
  const int expected[] = {60, 60, 255, 255, 23, 23, 60, 60};
  for (std::size_t i = 0; i < 8; ++i)
    if (!is_about(grey[i], expected[i]) || deep[2 * i] != 0 || deep[2 * i + 1] != grey[i]) return false;
  return grey.size() == 8;
}

bool colours_are_by_the_standard() {
  const auto pairs = converted(PixelFormat::yuyv);
  const auto swapped = converted(PixelFormat::uyvy);
  const auto planes = converted(PixelFormat::nv12);
  // Red: U = 128 - 0.564 * 60, V = 128 + 0.713 * 140.
  if (!is_about(pairs[1], 94) || !is_about(pairs[3], 228)) return false;
  // White has none, blue much of U.
  if (pairs[5] != 128 || pairs[7] != 128 || !is_about(pairs[9], 228)) return false;
  for (std::size_t i = 0; i < pairs.size(); i += 2)
    if (swapped[i] != pairs[i + 1] || swapped[i + 1] != pairs[i]) return false;
  return planes.size() == 12 && planes[8] == pairs[1] && planes[9] == pairs[3] && planes[10] == 128;
}

bool mosaics_have_their_pixels_channels() {
  const auto rggb = converted(PixelFormat::bayer_rggb8);
  const auto bggr = converted(PixelFormat::bayer_bggr8);
  const auto grbg = converted(PixelFormat::bayer_grbg8);
  const auto gbrg = converted(PixelFormat::bayer_gbrg8);
  return rggb[0] == 200 && rggb[1] == 0 && rggb[5] == 200 && rggb[7] == 60 && bggr[0] == 0 && bggr[1] == 0 &&
         bggr[4] == 0 && bggr[5] == 0 && grbg[1] == 200 && grbg[4] == 200 && gbrg[1] == 0 && gbrg[4] == 0 &&
         gbrg[5] == 0 && rggb[2] == 255;
}

bool rgb_stays_as_it_is() {
  return converted(PixelFormat::rgb24) == picture;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<brightness_is_by_the_standard>),
      cmocka_unit_test(judged<colours_are_by_the_standard>),
      cmocka_unit_test(judged<mosaics_have_their_pixels_channels>),
      cmocka_unit_test(judged<rgb_stays_as_it_is>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
