#pragma once

#include "types/key_event.hpp"
#include "types/pose.hpp"

namespace flexrf {

/// Moves or turns a pose as a key says, in the base frame, and tells whether it was a key for that:
/// w/s along +x/-x, a/d along +y/-y, q/e along +z/-z, by `step` m; u/o about x, up/down about y, left/right
/// about z, by `turn` rad.
bool move_by_key(Pose& pose, const KeyEvent& event, double step, double turn) noexcept;

}  // namespace flexrf
