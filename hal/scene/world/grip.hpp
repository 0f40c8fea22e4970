// What is between a hand's fingers, and where they are stopped by it.
#pragma once

#include "hal/scene/interface/scene_shapes.hpp"
#include "hal/scene/world/part_pushing.hpp"

namespace flexrf {

/// The space between the fingers, as seen from above.
struct FingerSpace {
  bool upright = false;   ///< the hand points downwards, within 45 degrees; else it grips nothing
  PlaneVector middle;     ///< between the fingertips
  PlaneVector closing;    ///< unit vector from one finger to the other
  double half_width = 0;  ///< m, of a finger
  double low = 0;         ///< m, height of the fingertips
  double high = 0;        ///< m, where the palm begins
};
FingerSpace finger_space(const HandModel& hand, const Eigen::Isometry3d& tool) noexcept;

/// A part between the fingers.
struct Between {
  std::size_t parts = 0;  ///< so many are
  std::size_t part = 0;   ///< the last of them
  Extent extent;          ///< its, m from the middle along the closing direction, as it lies now
  /// Where closing fingers stop, in m: a part that lies askew turns between them until it lies flush. Of
  /// several parts beside each other what they take together. 0: nothing stops them.
  double stop_width = 0;
  double stop_turn = 0;  ///< rad by which the part is turned then
};
/// A part counts when fingers reach down along it, and over it, by 2 mm at least, and it lies between them
/// with its whole width there. `opening`: m.
Between find_between(const SceneState& state, const PartPushing& bodies, const FingerSpace& space,
                     double opening) noexcept;

}  // namespace flexrf
