// ServoGroup: several drives that move as one arm, all or none.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "hal/robot_arm/interface/robot_arm.hpp"
#include "hal/servo_drive/interface/servo_drive.hpp"

namespace flexrf {

/// Its drives take cyclic positions, one for each joint. A fault of one switches all off. One thread, that of
/// the drives, but for begin(): the lifecycle thread; never blocks, never allocates.
class ServoGroup {
 public:
  /// Drives and chain outlive the group; as many drives as the chain has joints.
  void begin(std::span<ServoDrive* const> drives, const KinematicChain& chain) noexcept;

  /// Before the drives send: whether they may move. A drive that has to find its home is sent there when all
  /// are enabled, one after the other from the base to the tool; one that had started before and failed is
  /// sent again only after a new permission.
  void lead(bool may_move) noexcept;
  /// After the drives received, and after they sent.
  void watch() noexcept;

  /// Nothing until each drive tells where it is, and knows it.
  std::optional<JointState> state() const noexcept;
  /// Of the drive that told its position longest ago; no time while state() is nothing.
  Time measured_at() const noexcept;
  /// Set-point less position, of each joint; rad, or m where it slides.
  void following_error(std::array<double, max_joints>& error) const noexcept;
  /// All drives are enabled and know where they are: commands are followed.
  bool is_ready() const noexcept { return ready_; }
  /// Finite; kept to the chain's limits. Without effect while it is not ready, and not remembered.
  void command(const JointPositions& set_points) noexcept;
  /// True: all drives are where make_safe() leads them.
  bool make_safe() noexcept;

  /// What stopped all of them, and which joint it was; ok while nothing did.
  const Status& fault() const noexcept { return fault_; }

 private:
  void fail(std::size_t joint, const Status& cause) noexcept;
  bool all_enabled() const noexcept;
  bool all_homed() noexcept;

  std::array<ServoDrive*, max_joints> drives_{};
  const KinematicChain* chain_ = nullptr;
  std::size_t count_ = 0;
  bool ready_ = false;
  std::array<bool, max_joints> sent_home_{};  // with this permission to move
  Status fault_;
};

}  // namespace flexrf
