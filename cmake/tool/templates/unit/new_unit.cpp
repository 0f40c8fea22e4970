#include "units/new_unit/new_unit.hpp"

namespace flexrf::user {

void NewUnit::step(const flexrf::Tick& /*tick*/) {
  const auto pose = wanted.latest();
  if (!pose) return;  // nothing in, nothing out: who reads us sees the item grow old
  auto result = *pose;
  result.position[2] += runtime.height;
  raised.publish(result, pose.sampled_at());
  ++feedback.passed;
}

}  // namespace flexrf::user
