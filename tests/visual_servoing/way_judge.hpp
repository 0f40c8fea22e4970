// WayJudge: how far the tip leaves the straight ways that it is led along, by where the arm says it is.
//
// A way begins where the tip is when the picker names another goal, and ends at that goal.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/visual_servoing/servoing_cell.hpp"

namespace flexrf::visual_servoing {

/// The picker turns off so near the ends of its ways, at the most [picker-6]; m.
inline constexpr double most_beside_way = 0.030;

struct Way {
  double began = 0;  // s since the start
  PickerState state = PickerState::off;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  // m, of the tip
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    // m, where the picker leads it by now
  double speed = 0;                                // m/s, where it began
  double farthest = 0;                             // m, of the tip from the line between the two
};

class WayJudge {
 public:
  explicit WayJudge(ServoingCell& cell) : cell_(cell) {}
  /// Once in each cycle.
  void look();
  /// Those that ended.
  const std::vector<Way>& ways() const { return ways_; }

 private:
  ServoingCell& cell_;
  std::vector<Way> ways_;
  Way now_;
  bool is_led_ = false;
  Eigen::Vector3d tip_ = Eigen::Vector3d::Zero();  // in the cycle before
  double looked_ = 0;                              // s since the start
};

}  // namespace flexrf::visual_servoing
