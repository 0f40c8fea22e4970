// ObjectFilter: where one thing on the table is, from what is measured of it now and then (Kalman 1960).
#pragma once

#include <Eigen/Core>

namespace flexrf::user {

/// How things move, and how well they are measured; standard deviations.
struct FilterNoise {
  double measured_position = 0.001;  ///< m, of one measurement
  double measured_angle = 0.02;      ///< rad
  double drift = 0.002;              ///< m, by which a thing that lies is elsewhere after 1 s
  double turn = 0.05;                ///< rad, likewise
  double first_speed = 0.2;          ///< m/s, of a thing on a belt that was not seen before
  double belt_acceleration = 0.3;    ///< m/s^2
};

/// x and y are filtered alike and apart, so that one covariance of position and velocity serves both. A thing
/// that lies has a constant position and some drift; on a belt it has a constant velocity and some
/// acceleration.
class ObjectFilter {
 public:
  void begin(const Eigen::Vector2d& position, double angle, bool on_belt, const FilterNoise& noise) noexcept;

  /// Goes on by so many s, at least 0.
  void predict(double elapsed, bool on_belt, const FilterNoise& noise) noexcept;
  /// Back by so many s, at least 0, along its velocity; how well it is known stays as it is.
  void go_back(double elapsed) noexcept { position_ -= velocity_ * elapsed; }

  /// `symmetry`: the angle is one of so many that look the same; 0: it has none.
  void correct(const Eigen::Vector2d& position, double angle, int symmetry,
               const FilterNoise& noise) noexcept;

  const Eigen::Vector2d& position() const noexcept { return position_; }
  const Eigen::Vector2d& velocity() const noexcept { return velocity_; }
  double angle() const noexcept { return angle_; }
  double deviation() const noexcept;  ///< m, of each of x and y

 private:
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_ = Eigen::Vector2d::Zero();
  double angle_ = 0;
  double position_variance_ = 0;
  double covariance_ = 0;  // of position and velocity
  double velocity_variance_ = 0;
  double angle_variance_ = 0;
};

}  // namespace flexrf::user
