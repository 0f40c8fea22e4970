#include "motion/velocity_stream.hpp"

#include <cmath>

namespace flexrf {
namespace {

// What is computed to be at the limit is not beyond it.
constexpr double tolerance = 1e-9;

}  // namespace

void VelocityStream::use(const KinematicChain& chain, const StreamLimits& limits, double max_age) noexcept {
  guarded_.use(chain, limits);
  limits_ = limits;
  max_age_ = max_age;
  wanted_ = {};
  shortened_ = {};
}

void VelocityStream::seed(const JointVector& joints) noexcept {
  guarded_.seed(joints);
  wanted_ = {};
  shortened_ = {};
}

Status VelocityStream::want(const ToolVelocity& wanted, double age) noexcept {
  wanted_ = {};
  shortened_ = {};
  if (!wanted.linear.allFinite() || !wanted.angular.allFinite() || !std::isfinite(age))
    return Status::error(StatusCode::invalid_argument, "the velocity wanted is not a number");
  wanted_ = wanted;
  age_ = age;
  const double linear = wanted.linear.norm();
  const double angular = wanted.angular.norm();
  if (angular > limits_.angular.velocity * (1 + tolerance)) {
    wanted_.angular *= limits_.angular.velocity / angular;
    shortened_ = {"the turning wanted is above its limit", angular, limits_.angular.velocity};
  }
  if (linear > limits_.linear.velocity * (1 + tolerance)) {
    wanted_.linear *= limits_.linear.velocity / linear;
    shortened_ = {"the velocity wanted is above its limit", linear, limits_.linear.velocity};
  }
  return {};
}

void VelocityStream::advance(double elapsed) noexcept {
  if (!(elapsed > 0)) return;
  age_ += elapsed;
  if (is_stale() || wanted_.is_zero()) return guarded_.brake(elapsed);
  guarded_.advance(elapsed, [this](VelocityMotion& motion, double part, double time) {
    motion.advance({.linear = part * wanted_.linear, .angular = part * wanted_.angular}, time);
  });
}

const Restraint& VelocityStream::restraint() const noexcept {
  return guarded_.restraint().reason != nullptr ? guarded_.restraint() : shortened_;
}

}  // namespace flexrf
