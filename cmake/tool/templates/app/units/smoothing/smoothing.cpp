#include "units/smoothing/smoothing.hpp"

#include <chrono>
#include <cmath>

namespace flexrf::user {

Status Smoothing::initialise() {
  value_ = 0;
  return {};
}

void Smoothing::step(const Tick& tick) {
  if (const auto wanted = level.latest()) {
    const double elapsed = std::chrono::duration<double>(tick.elapsed).count();
    value_ += (wanted->value - value_) * -std::expm1(-elapsed / configuration.time_constant);
  }
  smooth.publish({value_});
}

}  // namespace flexrf::user
