#include "hal/scene/renderer/picture_finish.hpp"

#include <cmath>
#include <numeric>

#include "hal/scene/renderer/convex_fill.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

constexpr std::uint32_t width = 9;
constexpr std::uint32_t height = 7;
using Picture = std::vector<std::uint8_t>;

Picture finished(const Picture& sharp, const std::vector<std::int8_t>& noise) {
  PictureFinish finish;
  finish.begin(width, height);
  Picture result(sharp.size());
  constexpr std::size_t bytes = 3 * width;
  const auto write = [&](std::uint32_t row) {
    std::copy_n(&sharp[row * bytes], bytes, finish.sharp_row(row));
  };
  write(0);
  for (std::uint32_t row = 0; row < height; ++row) {
    if (row + 1 < height) write(row + 1);
    finish.finish_row(row, noise.data(), &result[row * bytes]);
  }
  return result;
}
const std::vector<std::int8_t> no_noise(3 * width, 0);

std::uint8_t& at(Picture& picture, std::uint32_t column, std::uint32_t row, std::uint32_t channel) {
  return picture[(row * width + column) * 3 + channel];
}

// Of one bright point sixteen sixteenths: four in the middle, two beside it, one at the corners.
bool a_point_is_spread_and_nothing_is_lost() {
  Picture sharp(std::size_t{3} * width * height, 0);
  at(sharp, 4, 3, 1) = 160;
  Picture result = finished(sharp, no_noise);
  const int sum = std::accumulate(result.begin(), result.end(), 0);
  return sum == 160 && at(result, 4, 3, 1) == 40 && at(result, 3, 3, 1) == 20 && at(result, 4, 4, 1) == 20 &&
         at(result, 5, 2, 1) == 10 && at(result, 4, 3, 0) == 0 && at(result, 6, 3, 1) == 0;
}

bool what_is_even_stays_so_to_the_edges() {
  for (const int level : {0, 1, 77, 254, 255}) {
    const Picture sharp(std::size_t{3} * width * height, static_cast<std::uint8_t>(level));
    if (finished(sharp, no_noise) != sharp) return false;
  }
  return true;
}

bool noise_is_added_and_kept_within_a_byte() {
  std::vector<std::int8_t> noise(3 * width, 0);
  noise[0] = -10;
  noise[1] = 10;
  const Picture dark(std::size_t{3} * width * height, 4);
  const Picture bright(std::size_t{3} * width * height, 250);
  const Picture darker = finished(dark, noise);
  const Picture brighter = finished(bright, noise);
  return darker[0] == 0 && darker[1] == 14 && darker[2] == 4 && brighter[0] == 240 && brighter[1] == 255;
}

bool noise_is_as_strong_as_asked() {
  PictureNoise noise;
  noise.begin(5, 3, 1920);
  double sum = 0;
  double squares = 0;
  constexpr int rows = 400;
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::int8_t* const levels = noise.row(1, row);
    for (std::size_t i = 0; i < 1920; ++i) {
      sum += levels[i];
      squares += levels[i] * levels[i];
    }
  }
  constexpr double count = rows * 1920.0;
  return std::abs(sum / count) < 0.1 && std::abs(std::sqrt(squares / count) - 3) < 0.1;
}

bool noise_is_another_in_each_frame_row_and_seed() {
  const auto row = [](std::uint64_t seed, std::uint64_t frame, std::uint32_t which) {
    PictureNoise noise;
    noise.begin(seed, 3, 300);
    const std::int8_t* const levels = noise.row(frame, which);
    return std::vector<std::int8_t>(levels, levels + 300);
  };
  const auto first = row(1, 1, 1);
  return first == row(1, 1, 1) && first != row(2, 1, 1) && first != row(1, 2, 1) && first != row(1, 1, 2);
}

// Polygons with common sides: each pixel is in one of them.
bool neighbours_leave_no_gap() {
  const PlaneVector middle{10.3, 8.7};
  const PlaneVector corners[] = {{1.5, 0.25}, {20, 1}, {18.2, 15.75}, {9, 19}, {0.5, 12}};
  std::vector<int> covered(24 * 20, 0);
  const auto count = [&](std::int32_t row, std::int32_t first, std::int32_t end) {
    for (std::int32_t column = first; column < end; ++column)
      ++covered[static_cast<std::size_t>(row * 24 + column)];
  };
  for (std::size_t i = 0; i < 5; ++i) {
    const PlaneVector triangle[] = {middle, corners[i], corners[(i + 1) % 5]};
    fill_convex(triangle, 24, 20, count);
  }
  std::vector<int> whole(24 * 20, 0);
  covered.swap(whole);
  fill_convex(corners, 24, 20, count);
  return covered == whole && std::accumulate(whole.begin(), whole.end(), 0) > 200;
}

bool a_square_covers_the_pixels_within() {
  std::vector<int> rows;
  const PlaneVector square[] = {{1.5, 2}, {4, 2}, {4, 5}, {1.5, 5}};
  bool good = true;
  fill_convex(square, 10, 10, [&](std::int32_t row, std::int32_t first, std::int32_t end) {
    rows.push_back(row);
    good = good && first == 2 && end == 4;
  });
  return good && rows == std::vector<int>{2, 3, 4};
}

bool what_is_beside_the_picture_is_left_out() {
  const PlaneVector large[] = {{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}};
  const PlaneVector beside[] = {{20, 1}, {30, 1}, {30, 5}, {20, 5}};
  int pixels = 0;
  const auto count = [&](std::int32_t, std::int32_t first, std::int32_t end) { pixels += end - first; };
  fill_convex(large, 10, 8, count);
  fill_convex(beside, 10, 8, count);
  return pixels == 80;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<a_point_is_spread_and_nothing_is_lost>),
      cmocka_unit_test(judged<what_is_even_stays_so_to_the_edges>),
      cmocka_unit_test(judged<noise_is_added_and_kept_within_a_byte>),
      cmocka_unit_test(judged<noise_is_as_strong_as_asked>),
      cmocka_unit_test(judged<noise_is_another_in_each_frame_row_and_seed>),
      cmocka_unit_test(judged<neighbours_leave_no_gap>),
      cmocka_unit_test(judged<a_square_covers_the_pixels_within>),
      cmocka_unit_test(judged<what_is_beside_the_picture_is_left_out>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
