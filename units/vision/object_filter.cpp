#include "units/vision/object_filter.hpp"

#include <cmath>

#include "units/vision/part_model.hpp"

namespace flexrf::user {
namespace {

double square(double value) {
  return value * value;
}

}  // namespace

void ObjectFilter::begin(const Eigen::Vector2d& position, double angle, bool on_belt,
                         const FilterNoise& noise) noexcept {
  position_ = position;
  velocity_.setZero();
  angle_ = angle;
  position_variance_ = square(noise.measured_position);
  covariance_ = 0;
  velocity_variance_ = on_belt ? square(noise.first_speed) : 0;
  angle_variance_ = square(noise.measured_angle);
}

void ObjectFilter::predict(double elapsed, bool on_belt, const FilterNoise& noise) noexcept {
  angle_variance_ += square(noise.turn) * elapsed;
  if (!on_belt) {
    velocity_.setZero();
    covariance_ = velocity_variance_ = 0;
    position_variance_ += square(noise.drift) * elapsed;
    return;
  }
  position_ += velocity_ * elapsed;
  const double jolt = square(noise.belt_acceleration);
  position_variance_ += elapsed * (2 * covariance_ + elapsed * velocity_variance_) +
                        jolt * square(square(elapsed)) / 4 + square(noise.drift) * elapsed;
  covariance_ += elapsed * velocity_variance_ + jolt * elapsed * square(elapsed) / 2;
  velocity_variance_ += jolt * square(elapsed);
}

void ObjectFilter::correct(const Eigen::Vector2d& position, double angle, int symmetry,
                           const FilterNoise& noise) noexcept {
  const double total = position_variance_ + square(noise.measured_position);
  const double gain = position_variance_ / total;
  const double velocity_gain = covariance_ / total;
  const Eigen::Vector2d difference = position - position_;
  position_ += gain * difference;
  velocity_ += velocity_gain * difference;
  velocity_variance_ -= velocity_gain * covariance_;
  covariance_ *= 1 - gain;
  position_variance_ *= 1 - gain;
  const double angle_gain = angle_variance_ / (angle_variance_ + square(noise.measured_angle));
  angle_ = within_symmetry(angle_ + angle_gain * within_symmetry(angle - angle_, symmetry), symmetry);
  angle_variance_ *= 1 - angle_gain;
}

double ObjectFilter::deviation() const noexcept {
  return std::sqrt(position_variance_);
}

}  // namespace flexrf::user
