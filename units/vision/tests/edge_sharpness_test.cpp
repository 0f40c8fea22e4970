#include "units/vision/edge_sharpness.hpp"

#include <cmath>
#include <vector>

#include "tests/cmocka.hpp"

namespace flexrf::edge_sharpness_test {
namespace {

using namespace flexrf::user;

constexpr std::size_t width = 320;
constexpr std::size_t height = 240;

/// `value(column, row)`, rounded.
template <class Value>
std::vector<std::uint8_t> picture_of(const Value& value) {
  std::vector<std::uint8_t> luminance(width * height);
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = 0; column < width; ++column)
      luminance[row * width + column] = static_cast<std::uint8_t>(
          std::lround(value(static_cast<double>(column), static_cast<double>(row))));
  return luminance;
}

/// From 60 to 160 at `edge`, blurred by a Gaussian of `deviation` pixels.
double step(double at, double edge, double deviation) {
  return 110 + 50 * std::erf((at - edge) / (deviation * std::sqrt(2.0)));
}

/// The middle two pixels of a step hold erf(1 / (deviation * sqrt(2))) of it.
void a_blurred_step_has_what_its_gaussian_says(void**) {
  for (const double deviation : {0.5, 1.0, 1.5, 2.0, 3.0}) {
    const auto picture =
        picture_of([&](double column, double /*row*/) { return step(column, 150, deviation); });
    const auto told = edge_sharpness(picture, width);
    assert_true(told.has_value());
    assert_true(std::abs(*told - std::erf(1 / (deviation * std::sqrt(2.0)))) < 0.05);
  }
}

void columns_count_as_rows_do(void**) {
  const auto across = picture_of([](double column, double /*row*/) { return step(column, 100, 2); });
  const auto down = picture_of([](double /*column*/, double row) { return step(row, 100, 2); });
  assert_true(std::abs(*edge_sharpness(across, width) - *edge_sharpness(down, width)) < 0.03);
}

/// A camera that moves along rows blurs what stands across them, and not what lies along them.
void motion_in_one_direction_is_no_blur(void**) {
  const auto picture = picture_of([](double column, double row) {
    return 0.5 * (step(column, 80, 4) + step(column, 240, 4)) - 50 + step(row, 120, 0.4);
  });
  assert_true(*edge_sharpness(picture, width) > 0.8);
}

void a_bare_table_tells_nothing(void**) {
  const auto bare = picture_of([](double column, double row) { return 120 + 0.05 * column + 0.05 * row; });
  assert_false(edge_sharpness(bare, width).has_value());
}

/// All contrasts shrink with the light.
void it_is_told_in_little_light(void**) {
  const auto picture = picture_of([](double column, double /*row*/) { return 0.3 * step(column, 150, 2); });
  const auto told = edge_sharpness(picture, width);
  assert_true(told.has_value());
  assert_true(std::abs(*told - 0.38) < 0.06);
}

}  // namespace
}  // namespace flexrf::edge_sharpness_test

int main() {
  using namespace flexrf::edge_sharpness_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_blurred_step_has_what_its_gaussian_says), cmocka_unit_test(columns_count_as_rows_do),
      cmocka_unit_test(motion_in_one_direction_is_no_blur), cmocka_unit_test(a_bare_table_tells_nothing),
      cmocka_unit_test(it_is_told_in_little_light)};
  return cmocka_run_group_tests_name("edge sharpness", tests, nullptr, nullptr);
}
