#include "hal/scene/interface/joint_samples.hpp"

namespace flexrf {

std::array<double, max_joints> joints_between(const JointSample& before, const JointSample& after,
                                              Time time) noexcept {
  const double whole = seconds(after.time - before.time);
  if (whole <= 0) return joints_after(before, time);
  const double part = seconds(time - before.time) / whole;
  const double rest = 1 - part;
  std::array<double, max_joints> positions{};
  for (std::size_t i = 0; i < max_joints; ++i) {
    positions[i] = before.position[i] * rest * rest * (1 + 2 * part) +
                   after.position[i] * part * part * (1 + 2 * rest) +
                   whole * part * rest * (before.velocity[i] * rest - after.velocity[i] * part);
  }
  return positions;
}

std::array<double, max_joints> joints_after(const JointSample& last, Time time) noexcept {
  const double elapsed = seconds(time - last.time);
  std::array<double, max_joints> positions{};
  for (std::size_t i = 0; i < max_joints; ++i) positions[i] = last.position[i] + last.velocity[i] * elapsed;
  return positions;
}

}  // namespace flexrf
