#pragma once

#include <array>
#include <cstddef>

#include "base/time.hpp"

namespace flexrf {

/// What is measured, and told some time later. The thread the mock lives in; allocates nothing.
template <class Value>
class MockDelay {
 public:
  /// A delay of more cycles is cut to so many.
  static constexpr std::size_t most_cycles = 64;

  /// What is on its way is kept.
  void set(Duration delay) noexcept { delay_ = delay; }
  void clear() noexcept { first_ = count_ = 0; }

  /// It is `value` at `now`, which no call before was later than. Returns what is told then: the newest that
  /// is as old as the delay, and before there is one the oldest.
  const Value& pass(const Value& value, Time now) noexcept {
    if (count_ == places) drop();
    at(count_++) = {value, now};
    while (count_ > 1 && at(1).since + delay_ <= now) drop();
    return at(0).value;
  }

 private:
  static constexpr std::size_t places = most_cycles + 1;
  struct Measured {
    Value value{};
    Time since{};
  };

  Measured& at(std::size_t place) noexcept { return measured_[(first_ + place) % places]; }
  void drop() noexcept {
    first_ = (first_ + 1) % places;
    --count_;
  }

  std::array<Measured, places> measured_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  Duration delay_{};
};

}  // namespace flexrf
