#include "hal/scene/interface/scene_math.hpp"

namespace flexrf {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double half_pi = 1.57079632679489661923;
// half_pi in three parts, of which the first two have zeros at their ends: a multiple of them is exact (Cody
// and Waite 1980).
constexpr double half_pi_high = 1.57079632673412561417;
constexpr double half_pi_middle = 6.07710050630396597660e-11;
constexpr double half_pi_low = 2.02226624879595063154e-21;

// Taylor's series, far enough for an eighth of a turn.
double sine_series(double angle) noexcept {
  const double square = angle * angle;
  double sum = -1.0 / 1307674368000.0;
  sum = sum * square + 1.0 / 6227020800.0;
  sum = sum * square - 1.0 / 39916800.0;
  sum = sum * square + 1.0 / 362880.0;
  sum = sum * square - 1.0 / 5040.0;
  sum = sum * square + 1.0 / 120.0;
  sum = sum * square - 1.0 / 6.0;
  return angle + angle * square * sum;
}
double cosine_series(double angle) noexcept {
  const double square = angle * angle;
  double sum = 1.0 / 20922789888000.0;
  sum = sum * square - 1.0 / 87178291200.0;
  sum = sum * square + 1.0 / 479001600.0;
  sum = sum * square - 1.0 / 3628800.0;
  sum = sum * square + 1.0 / 40320.0;
  sum = sum * square - 1.0 / 720.0;
  sum = sum * square + 1.0 / 24.0;
  sum = sum * square - 0.5;
  return 1 + square * sum;
}

/// Of 0 to 1: twice made half as large, then the series.
double arc_tangent_of_part(double part) noexcept {
  double tangent = part;
  for (int halving = 0; halving < 2; ++halving) tangent = tangent / (1 + std::sqrt(1 + tangent * tangent));
  const double square = tangent * tangent;
  double sum = 0;
  for (int power = 23; power >= 3; power -= 2) sum = (power % 4 == 1 ? 1.0 : -1.0) / power + sum * square;
  return 4 * (tangent + tangent * square * sum);
}

}  // namespace

SineCosine sine_cosine(double angle) noexcept {
  const double quarters = std::floor(angle / half_pi + 0.5);
  const double rest =
      ((angle - quarters * half_pi_high) - quarters * half_pi_middle) - quarters * half_pi_low;
  const double sine = sine_series(rest);
  const double cosine = cosine_series(rest);
  switch (static_cast<long>(quarters) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

double arc_tangent(double y, double x) noexcept {
  const double across = std::abs(x);
  const double along = std::abs(y);
  if (across == 0 && along == 0) return 0;
  double angle =
      along <= across ? arc_tangent_of_part(along / across) : half_pi - arc_tangent_of_part(across / along);
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

Eigen::Matrix3d turn_about(const Eigen::Vector3d& axis, double angle) noexcept {
  const auto [sine, cosine] = sine_cosine(angle);
  const double rest = 1 - cosine;
  const double x = axis.x();
  const double y = axis.y();
  const double z = axis.z();
  Eigen::Matrix3d turn;
  turn << cosine + x * x * rest, x * y * rest - z * sine, x * z * rest + y * sine,  //
      y * x * rest + z * sine, cosine + y * y * rest, y * z * rest - x * sine,      //
      z * x * rest - y * sine, z * y * rest + x * sine, cosine + z * z * rest;
  return turn;
}

}  // namespace flexrf
