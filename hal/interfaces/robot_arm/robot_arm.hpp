// RobotArm: an arm that follows joint positions cyclically.
#pragma once

#include <optional>

#include "hal/interfaces/robot_arm/arm_supervision.hpp"
#include "hal/interfaces/robot_arm/kinematic_chain.hpp"
#include "robot_arm_interface.hpp"
#include "types/joint_positions.hpp"
#include "types/joint_state.hpp"

namespace flexrf {

/// Everything: the thread the arm lives in.
class RobotArm : public RobotArmInterface {
 public:
  const KinematicChain& kinematic_chain() const noexcept { return *chain; }

  /// What the sensors said last, as of this cycle; nothing while they say nothing.
  virtual std::optional<JointState> state() const noexcept = 0;

  /// Where the joints shall be (rad, or m where one slides), sent at the end of the cycle and held until the
  /// next command. An arm keeps to its own limits whatever it is commanded; what is not finite puts it in
  /// fault. Without effect while is_inhibited(), and not remembered.
  virtual void command(const JointPositions& set_points) noexcept = 0;

 protected:
  /// In initialise(), by every driver.
  /// `configuration`: the driver's.
  void begin_supervision(const auto& configuration) noexcept {
    supervision_.begin(*chain, {configuration.following_time, configuration.silence});
  }
  /// At the end of receive(), by every driver: an arm that does not follow what its drives are asked to
  /// (feedback.following_error), or does not say where it is, is in fault.
  void supervise(Time now) noexcept {
    const bool may_move = !is_inhibited() && fault().is_ok();
    if (const Status found = supervision_.look(state(), feedback.following_error, may_move, now); !found)
      set_fault(found);
  }

 private:
  ArmSupervision supervision_;
};

}  // namespace flexrf
