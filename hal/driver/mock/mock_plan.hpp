#pragma once

#include <vector>

#include "base/time.hpp"

namespace flexrf {

/// What a hand will do with a mock, each at its time after the mock's first cycle. plan: before the run, in
/// the order of their times; all else in the thread the mock lives in.
template <class Mock>
class MockPlan {
 public:
  void plan(Duration after, void (*act)(Mock&)) { acts_.push_back({after, act}); }

  /// The next run begins at its beginning.
  void rewind() noexcept {
    started_ = Time{};
    next_ = 0;
  }
  /// Does what is due.
  void follow(Mock& mock, Time now) noexcept {
    if (started_ == Time{}) started_ = now;
    while (next_ < acts_.size() && started_ + acts_[next_].after <= now) acts_[next_++].act(mock);
  }
  Time next_event() const noexcept {
    if (next_ == acts_.size()) return Time::max();
    return started_ == Time{} ? Time{} : started_ + acts_[next_].after;
  }

 private:
  struct Act {
    Duration after;
    void (*act)(Mock&);
  };

  std::vector<Act> acts_;
  std::size_t next_ = 0;
  Time started_{};
};

}  // namespace flexrf
