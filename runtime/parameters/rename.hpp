// Names that were others in configuration files written before.
#pragma once

namespace flexrf {

/// A unit, device ("arm" to "robot") or parameter ("jog.step_size" to "jog.step") that had another name in
/// files written before.
struct Rename {
  const char* from;
  const char* to;
};

}  // namespace flexrf
