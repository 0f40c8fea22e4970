#include "motion/set_point_follower.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf {
namespace {

constexpr double same_place = 1e-12;  // of the position, or of 1

// The greatest velocity from which the axis comes to rest within `distance` when each cycle is slower by
// `change` than the one before, and the last ones by what is left.
double braked_within(double distance, double change, double time) noexcept {
  if (distance <= 0) return 0;
  if (!std::isfinite(distance)) return distance;
  const double way = distance / time;  // sum of the velocities of all cycles
  const double whole = std::floor(std::sqrt(0.25 + 2 * way / change) - 0.5);
  return (way + change * whole * (whole + 1) / 2) / (whole + 1);
}

}  // namespace

void SetPointFollower::seed(double at) noexcept {
  set_point_ = wanted_ = wanted_before_ = at;
  velocity_ = 0;
  brakes_ = false;
}

void SetPointFollower::command(double wanted) noexcept {
  wanted_ = std::clamp(wanted, limits_.lowest, limits_.highest);
  brakes_ = false;
}

double SetPointFollower::next(double time) noexcept {
  if (!(time > 0)) return set_point_;
  const double change = limits_.acceleration * time;
  const double pursued = brakes_ ? 0 : pursue(time);
  velocity_ = within_range(std::clamp(pursued, velocity_ - change, velocity_ + change), time);
  set_point_ += velocity_ * time;
  if (brakes_) wanted_ = set_point_;
  // What is in reach is met exactly, whatever the additions made of it.
  if (std::abs(set_point_ - wanted_) < same_place * std::max(1.0, std::abs(wanted_))) set_point_ = wanted_;
  wanted_before_ = wanted_;
  return set_point_;
}

// As fast as what is wanted moves, and beside that only so fast that it is not passed.
double SetPointFollower::pursue(double time) const noexcept {
  const double most = limits_.velocity;
  const double ahead = std::clamp((wanted_ - wanted_before_) / time, -most, most);
  const double behind = wanted_ - set_point_ - ahead * time;
  const double closing = braked_within(std::abs(behind), limits_.acceleration * time, time);
  return std::clamp(ahead + std::copysign(closing, behind), -most, most);
}

// So slow that the axis can stop at the end of its range.
double SetPointFollower::within_range(double velocity, double time) const noexcept {
  const double change = limits_.acceleration * time;
  const double down = braked_within(set_point_ - limits_.lowest, change, time);
  const double up = braked_within(limits_.highest - set_point_, change, time);
  return std::clamp(velocity, -down, up);
}

}  // namespace flexrf
