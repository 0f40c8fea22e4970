#include "motion/joint_pace.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf {

void JointPace::command(const KinematicChain& chain, std::span<const double> wanted,
                        std::span<const double> at) noexcept {
  const bool is_first = !is_led_;
  is_led_ = true;
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    if (is_first) at_[i] = at[i];
    wanted_[i] = std::clamp(wanted[i], chain.joints[i].lower, chain.joints[i].upper);
  }
}

Restraint JointPace::look(const KinematicChain& chain, double elapsed) noexcept {
  if (!is_led_) return {};
  Restraint found;
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const double most = chain.joints[i].velocity * elapsed;
    at_[i] += std::clamp(wanted_[i] - at_[i], -most, most);
    const bool is_behind = std::abs(wanted_[i] - at_[i]) > most;
    if (is_behind && found.reason == nullptr) found = outpaced(i, wanted_[i], at_[i]);
  }
  return found;
}

}  // namespace flexrf
