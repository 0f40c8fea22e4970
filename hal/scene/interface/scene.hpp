// Scene: a world that is only imagined, shared by an arm, its gripper and a camera.
#pragma once

#include "scene_interface.hpp"
#include "types/scene_arm.hpp"
#include "types/scene_state.hpp"

namespace flexrf {

/// Its frame is the arm's base: z up, the table's top at z = 0. Geometry decides what happens in it: fingers
/// hold only what is between them, what is touched moves. All that a unit may know of it comes through the
/// devices that share it; what is published here is the truth, for those devices and for tests. Everything:
/// the thread the scene lives in.
class Scene : public SceneInterface {
 public:
  using SceneInterface::SceneInterface;

  /// As of this cycle.
  virtual const SceneState& state() const noexcept = 0;
};

}  // namespace flexrf
