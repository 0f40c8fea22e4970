// TabletopScene: a table at which an arm works, shared with its gripper and a camera.
#pragma once

#include "hal/scene/interface/scene.hpp"
#include "hal/scene/interface/scene_arm.hpp"
#include "hal/scene/world/tabletop_world.hpp"
#include "tabletop_scene_driver.hpp"

namespace flexrf {

/// In each cycle the arm and the fingers are where they say, as of the cycle's time, and what they touch
/// gives way. Until both have said something, or while one is silent, everything stays.
class TabletopScene final : public TabletopSceneDriver {
 public:
  Status initialise() override;
  void receive(const Tick& tick) noexcept override;
  const SceneState& state() const noexcept override { return world_.state(); }

 private:
  void do_as_a_person_asks() noexcept;
  void answer(const char* refusal) noexcept;
  void step(const Tick& tick) noexcept;
  void tell() noexcept;

  SceneArm chain_{};
  bool told_chain_ = false;
  TabletopWorld world_;
};

}  // namespace flexrf
