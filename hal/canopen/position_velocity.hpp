// PositionVelocity: how fast an axis moves whose drive does not say it.
#pragma once

#include <array>
#include <cstddef>

#include "base/time.hpp"

namespace flexrf::canopen::cia402 {

/// From some of the last positions, so that an increment more or less in a cycle counts for little; of an
/// axis at rest that is as many cycles old. One thread; never blocks, never allocates.
class PositionVelocity {
 public:
  /// Where it is counts anew, as after a homing.
  void forget() noexcept { *this = PositionVelocity{}; }
  /// In each cycle in which a position came. In its unit of measure a second.
  double take(double position, Time now) noexcept {
    const Heard oldest = heard_[count_ < cycles ? 0 : next_];
    window_ = count_ > 0 && now > oldest.at ? seconds(now - oldest.at) : 0;
    heard_[next_] = {position, now};
    next_ = (next_ + 1) % cycles;
    if (count_ < cycles) ++count_;
    return window_ > 0 ? (position - oldest.position) / window_ : 0;
  }
  /// take() was called often enough since forget() for its result to count.
  bool is_known() const noexcept { return count_ == cycles && window_ > 0; }
  /// The error of the last velocity if a position is off by one increment, in its unit a second. `increment`:
  /// in the positions' unit, above 0.
  double doubt(double increment) const noexcept { return window_ > 0 ? increment / window_ : 0; }

 private:
  static constexpr std::size_t cycles = 8;

  struct Heard {
    double position = 0;
    Time at{};
  };

  std::array<Heard, cycles> heard_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  double window_ = 0;  // s, from the oldest of them to the newest
};

}  // namespace flexrf::canopen::cia402
