// KeyboardRobot: a keyboard and an arm in one unit.
#pragma once

#include <optional>

#include "keyboard_robot_unit.hpp"
#include "runtime/log/log.hpp"
#include "units/arm_motion/arm_motion.hpp"

namespace flexrf::user {

class KeyboardRobot final : public KeyboardRobotUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return idle_; }

 private:
  void follow_keys() noexcept;

  ArmMotion motion_;
  Pose target_{};
  Pose kept_{};  // the last one moved to
  LogLimit refusals_;
  bool moved_ = false;            // the target was, since the last motion began
  bool is_to_be_seeded_ = false;  // it did not follow, or told nothing, since it was seeded
  bool was_inhibited_ = false;    // in the cycle before
  bool idle_ = true;
};

}  // namespace flexrf::user
