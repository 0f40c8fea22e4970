#pragma once

#include <array>
#include <cstddef>

namespace flexrf {

// Largest magnitudes along one coordinate, all above 0 and finite; its unit is the caller's, time is in s.
struct MotionLimits {
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};

struct MotionState {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
};

// A motion along one coordinate in pieces of constant jerk: the shortest one within its limits. Ends at rest.
// Plain data; nothing allocates.
class JerkProfile {
 public:
  // From rest at 0 to rest at `distance` (of either sign): the seven-segment profile.
  static JerkProfile rest_to_rest(double distance, const MotionLimits& limits);

  // From any state to rest, somewhere. The velocity limit plays no part, and an acceleration beyond its limit
  // is led back within it.
  static JerkProfile stop(const MotionState& from, const MotionLimits& limits);

  double duration() const { return duration_; }  // s

  // The state `time` s after the start; before it the first state, after the end the last one, at rest.
  MotionState at(double time) const;

  const MotionState& end() const { return end_; }

 private:
  static constexpr std::size_t max_segments = 7;
  struct Segment {
    double duration;
    double jerk;
    MotionState start;
  };

  void append(double duration, double jerk);

  std::array<Segment, max_segments> segments_{};
  std::size_t count_ = 0;
  double duration_ = 0;
  MotionState end_{};
};

}  // namespace flexrf
