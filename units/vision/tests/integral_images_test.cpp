#include "units/vision/integral_images.hpp"

#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "tests/cmocka.hpp"

namespace flexrf::integral_images_test {
namespace {

using namespace flexrf::user;

struct World {
  FeatureExtractor extractor;
  VisualFeatures features{};
  std::vector<std::uint8_t> pixels =
      std::vector<std::uint8_t>(std::size_t{picture_row_bytes + 8} * picture_height);
  static constexpr std::size_t stride = picture_row_bytes + 8;  // with padding

  std::uint8_t* at(std::uint32_t column, std::uint32_t row) {
    return pixels.data() + row * stride + 3 * column;
  }
  void fill(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    for (std::uint32_t row = 0; row < picture_height; ++row) {
      for (std::uint32_t column = 0; column < picture_width; ++column) {
        at(column, row)[0] = red;
        at(column, row)[1] = green;
        at(column, row)[2] = blue;
      }
    }
  }
  void scatter(std::uint32_t seed) {
    for (std::uint8_t& byte : pixels) {
      seed = seed * 1664525 + 1013904223;
      byte = static_cast<std::uint8_t>(seed >> 24);
    }
  }
  PictureStatistics extract() { return extractor.extract(pixels.data(), stride, features); }
  /// One pixel of the half-size picture, channel by channel.
  int mean(std::uint32_t column, std::uint32_t row, std::size_t channel) {
    return (at(2 * column, 2 * row)[channel] + at(2 * column + 1, 2 * row)[channel] +
            at(2 * column, 2 * row + 1)[channel] + at(2 * column + 1, 2 * row + 1)[channel] + 2) >>
           2;
  }
  int luminance(std::uint32_t column, std::uint32_t row) {
    return (77 * mean(column, row, 0) + 150 * mean(column, row, 1) + 29 * mean(column, row, 2)) >> 8;
  }
};

bool windows_hold_what_their_pixels_add_up_to() {
  const auto world = std::make_unique<World>();
  world->scatter(1);
  world->extract();
  std::vector<int> before;
  for (std::uint32_t row = 0; row < feature_height; ++row)
    for (std::uint32_t column = 0; column < feature_width; ++column)
      before.push_back(world->luminance(column, row));
  world->scatter(2);
  world->extract();
  const VisualFeatures& of = world->features;
  for (const FeatureWindow window :
       {FeatureWindow{0, 0, 1, 1}, FeatureWindow{3, 5, 40, 29}, FeatureWindow{300, 200, 320, 240},
        FeatureWindow{0, 0, 320, 2}, FeatureWindow{319, 0, 320, 240}, FeatureWindow{100, 100, 228, 228}}) {
    std::uint32_t sum = 0, squares = 0, red_green = 0, yellow_blue = 0, edges = 0, changes = 0;
    for (std::uint32_t row = window.top; row < window.bottom; ++row) {
      for (std::uint32_t column = window.left; column < window.right; ++column) {
        const int y = world->luminance(column, row);
        sum += static_cast<std::uint32_t>(y);
        squares += static_cast<std::uint32_t>(y * y);
        const int red = world->mean(column, row, 0);
        const int green = world->mean(column, row, 1);
        const int blue = world->mean(column, row, 2);
        red_green += static_cast<std::uint32_t>((red - green + 255) >> 1);
        yellow_blue += static_cast<std::uint32_t>((red + green - 2 * blue + 510) >> 2);
        changes += static_cast<std::uint32_t>(std::abs(y - before[row * feature_width + column]));
        if (row > 0 && column > 0 && row + 1 < feature_height && column + 1 < feature_width)
          edges += static_cast<std::uint32_t>(
              (std::abs(world->luminance(column + 1, row) - world->luminance(column - 1, row)) +
               std::abs(world->luminance(column, row + 1) - world->luminance(column, row - 1))) >>
              1);
      }
    }
    if (window_sum(of.luminance, window) != sum || window_sum(of.luminance_squared, window) != squares ||
        window_sum(of.red_green, window) != red_green || window_sum(of.yellow_blue, window) != yellow_blue ||
        window_sum(of.edges, window) != edges || window_sum(of.changes, window) != changes)
      return false;
  }
  return of.compares;
}

bool white_does_not_overflow() {
  const auto world = std::make_unique<World>();
  world->fill(255, 255, 255);
  const PictureStatistics of = world->extract();
  // 255 * 255 of all pixels is more than 32 bits hold; a window of it is not.
  const FeatureWindow late{100, 100, 300, 230};
  return of.brightness == 255 && of.deviation == 0 && of.edge == 0 &&
         window_sum(world->features.luminance_squared, late) == 200U * 130U * 65025U;
}

bool noise_has_edges_like_its_deviation(double& ratio) {
  const auto world = std::make_unique<World>();
  world->scatter(3);
  const PictureStatistics of = world->extract();
  ratio = of.edge / of.deviation;
  return ratio > 1.0 && ratio < 1.25;
}

bool what_was_forgotten_is_not_compared() {
  const auto world = std::make_unique<World>();
  const FeatureWindow all{0, 0, feature_width, feature_height};
  world->fill(10, 10, 10);
  world->extract();
  const bool first = !world->features.compares && window_sum(world->features.changes, all) == 0;
  world->fill(14, 14, 14);
  world->extract();
  const bool second = world->features.compares &&
                      window_sum(world->features.changes, all) == 4 * feature_width * feature_height;
  world->extractor.forget();
  world->fill(90, 90, 90);
  world->extract();
  return first && second && !world->features.compares && window_sum(world->features.changes, all) == 0;
}

void sums(void**) {
  assert_true(windows_hold_what_their_pixels_add_up_to());
}
void white(void**) {
  assert_true(white_does_not_overflow());
}
void noise(void**) {
  double ratio = 0;
  if (!noise_has_edges_like_its_deviation(ratio)) fail_msg("%f", ratio);
}
void forgetting(void**) {
  assert_true(what_was_forgotten_is_not_compared());
}

}  // namespace
}  // namespace flexrf::integral_images_test

int main() {
  using namespace flexrf::integral_images_test;
  const CMUnitTest tests[] = {cmocka_unit_test(sums), cmocka_unit_test(white), cmocka_unit_test(noise),
                              cmocka_unit_test(forgetting)};
  return cmocka_run_group_tests_name("integral images", tests, nullptr, nullptr);
}
