// LineFilter: what a line is when its bounces are left out.
#pragma once

#include "base/time.hpp"

namespace flexrf {

/// A level counts once it has lasted for the whole of `debounce` [line-filter-1], judged by the times of the
/// edges [line-filter-2].
class LineFilter {
 public:
  /// Forgets all: the next level counts at once [line-filter-3].
  void reset(Duration debounce) noexcept {
    debounce_ = debounce;
    seen_ = false;
  }
  /// The line is this since `at`. In order.
  void put(bool on, Time at) noexcept {
    if (!seen_) {
      seen_ = true;
      on_ = on;
      since_ = at;
    } else if (on == raw_) {
      return;
    } else {
      settle(at);  // what it was until now may have lasted long enough
    }
    raw_ = on;
    raw_since_ = at;
    if (debounce_ <= Duration{}) settle(at);
  }
  /// Time has passed.
  void settle(Time now) noexcept {
    if (!seen_ || raw_ == on_ || now - raw_since_ < debounce_) return;
    on_ = raw_;
    since_ = raw_since_;
  }
  bool on() const noexcept { return on_; }
  Time since() const noexcept { return since_; }
  /// When a level that has begun will count, if it lasts; Time::max(): it counts already.
  Time settles_at() const noexcept { return seen_ && raw_ != on_ ? raw_since_ + debounce_ : Time::max(); }

 private:
  Duration debounce_{};
  bool seen_ = false;
  bool on_ = false;
  bool raw_ = false;
  Time since_{};
  Time raw_since_{};
};

}  // namespace flexrf
