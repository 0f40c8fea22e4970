#include "hal/scene/renderer/hand_eye.hpp"

#include "hal/scene/interface/scene_math.hpp"
#include "hal/scene/world/scene_random.hpp"

namespace flexrf {
namespace {

/// Each direction as likely as any other.
Eigen::Vector3d any_direction(SceneRandom& random) noexcept {
  while (true) {
    Eigen::Vector3d vector;
    for (Eigen::Index i = 0; i < 3; ++i) vector[i] = random.between(-1, 1);
    const double square = vector.squaredNorm();
    if (square > 0.01 && square <= 1) return vector / std::sqrt(square);
  }
}

}  // namespace

HandEye disturbed(const HandEye& told, const HandEyeErrors& errors, std::uint64_t seed) noexcept {
  SceneRandom random;
  random.seed(seed);
  HandEye real = told;
  const Eigen::Vector3d aside = any_direction(random);
  const Eigen::Vector3d axis = any_direction(random);
  const double sign = random.below(2) == 0 ? 1 : -1;
  real.pose.translation() += aside * errors.position;
  real.pose.linear() = told.pose.linear() * turn_about(axis, errors.orientation);
  real.focal_length *= 1 + sign * errors.focal_length;
  return real;
}

}  // namespace flexrf
