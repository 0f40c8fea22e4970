// Numbers of the scene: the same on every machine, to the last bit.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace flexrf {

/// Of the table, in m, or a direction.
struct PlaneVector {
  double x = 0;
  double y = 0;

  constexpr PlaneVector operator+(PlaneVector other) const noexcept { return {x + other.x, y + other.y}; }
  constexpr PlaneVector operator-(PlaneVector other) const noexcept { return {x - other.x, y - other.y}; }
  constexpr PlaneVector operator-() const noexcept { return {-x, -y}; }
  constexpr PlaneVector operator*(double factor) const noexcept { return {x * factor, y * factor}; }
  constexpr bool operator==(const PlaneVector&) const noexcept = default;
};

constexpr double dot(PlaneVector one, PlaneVector other) noexcept {
  return one.x * other.x + one.y * other.y;
}
/// Above 0: `other` is to the left of `one`.
constexpr double cross(PlaneVector one, PlaneVector other) noexcept {
  return one.x * other.y - one.y * other.x;
}
/// A quarter of a turn to the left.
constexpr PlaneVector left_of(PlaneVector vector) noexcept {
  return {-vector.y, vector.x};
}
inline double length(PlaneVector vector) noexcept {
  return std::sqrt(dot(vector, vector));
}
/// Of one that is not 0.
inline PlaneVector unit(PlaneVector vector) noexcept {
  return vector * (1 / length(vector));
}

/// Those of the C library differ in the last bit from processor to processor, as it takes other code where
/// one can multiply and add at once. These are sums and products alone, which IEEE 754 rounds alike
/// everywhere, as is a square root; what includes this is compiled with -ffp-contract=off, so that the
/// compiler makes no such instruction either. Within 1e-15 of the true value.
struct SineCosine {
  double sine = 0;
  double cosine = 1;
};
/// `angle` in rad, at most a million turns.
SineCosine sine_cosine(double angle) noexcept;
/// Of (x, y), in rad from -pi to pi; 0 for (0, 0).
double arc_tangent(double y, double x) noexcept;

inline PlaneVector turned(PlaneVector vector, SineCosine by) noexcept {
  return {by.cosine * vector.x - by.sine * vector.y, by.sine * vector.x + by.cosine * vector.y};
}

/// About a unit vector, by rad.
Eigen::Matrix3d turn_about(const Eigen::Vector3d& axis, double angle) noexcept;

}  // namespace flexrf
