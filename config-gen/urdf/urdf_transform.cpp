#include "config-gen/urdf/urdf_transform.hpp"

#include <charconv>
#include <cmath>
#include <sstream>

namespace flexrf::config_gen {
namespace {

// A quarter turn is meant exactly: the rounding of its cosine would only clutter the constants.
std::array<double, 9> without_rounding(std::array<double, 9> rotation) {
  for (double& entry : rotation) {
    const double whole = std::round(entry);
    if (std::abs(entry - whole) < 1e-12) entry = whole + 0.0;
  }
  return rotation;
}

}  // namespace

UrdfTransform compose(const UrdfTransform& a, const UrdfTransform& b) {
  UrdfTransform result;
  for (std::size_t row = 0; row < 3; ++row) {
    result.position[row] = a.position[row];
    for (std::size_t k = 0; k < 3; ++k) result.position[row] += a.rotation[3 * k + row] * b.position[k];
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += a.rotation[3 * k + row] * b.rotation[3 * column + k];
      result.rotation[3 * column + row] = sum;
    }
  }
  return result;
}

UrdfTransform inverse(const UrdfTransform& transform) {
  UrdfTransform result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      result.rotation[3 * column + row] = transform.rotation[3 * row + column];
    result.position[row] = 0;
    for (std::size_t k = 0; k < 3; ++k)
      result.position[row] -= transform.rotation[3 * row + k] * transform.position[k];
  }
  return result;
}

std::array<double, 9> rotation_of(const std::array<double, 3>& rpy) {
  const double cr = std::cos(rpy[0]), sr = std::sin(rpy[0]);
  const double cp = std::cos(rpy[1]), sp = std::sin(rpy[1]);
  const double cy = std::cos(rpy[2]), sy = std::sin(rpy[2]);
  const std::array<double, 9> rotation = {cy * cp,
                                          sy * cp,
                                          -sp,
                                          cy * sp * sr - sy * cr,
                                          sy * sp * sr + cy * cr,
                                          cp * sr,
                                          cy * sp * cr + sy * sr,
                                          sy * sp * cr - cy * sr,
                                          cp * cr};
  return without_rounding(rotation);
}

std::array<double, 9> rotation_of_quaternion(const std::array<double, 4>& quaternion) {
  const auto [x, y, z, w] = quaternion;
  const double twice = 2 / (x * x + y * y + z * z + w * w);
  return without_rounding({1 - twice * (y * y + z * z), twice * (x * y + z * w), twice * (x * z - y * w),
                           twice * (x * y - z * w), 1 - twice * (x * x + z * z), twice * (y * z + x * w),
                           twice * (x * z + y * w), twice * (y * z - x * w), 1 - twice * (x * x + y * y)});
}

bool parse_number(std::string_view text, double& value) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  const auto last = text.find_last_not_of(" \t\r\n");
  text = text.substr(first, last - first + 1);
  if (text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::abs(value) <= urdf_greatest_number;
}

bool parse_numbers(const std::string& text, std::span<double> values) {
  std::istringstream words(text);
  std::string word;
  std::size_t count = 0;
  while (words >> word) {
    if (count == values.size() || !parse_number(word, values[count])) return false;
    ++count;
  }
  return count == values.size();
}

}  // namespace flexrf::config_gen
