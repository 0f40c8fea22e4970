// A MELFA controller with an arm, that exist in memory only: what it answers in real-time external control.
#pragma once

#include <optional>
#include <span>

#include "hal/robot_arm/melfa_mxt/mxt_packet.hpp"
#include "hal/robot_arm/paced/joint_follower.hpp"

namespace flexrf::melfa {

struct ControllerPlan {
  std::size_t joints = 6;
  JointAngles start{};     ///< rad
  JointAngles fastest{};   ///< rad/s; a step that is faster is an alarm
  double cycle = 0.00711;  ///< s
  double lag = 0.02;       ///< s: how the joints follow what is commanded
  bool loops = true;       ///< after the end of a session its program comes to MXT again
};

/// Its program is at MXT, in joints and without a filter. One thread.
class MxtController {
 public:
  explicit MxtController(const ControllerPlan& plan);

  /// `cycles`: since the packet before. Nothing: it does not answer.
  std::optional<PacketBytes> answer(std::span<const std::uint8_t> datagram, std::uint64_t cycles);

  /// Why it stopped; empty while there is none.
  const char* alarm() const { return alarm_; }
  /// As if its own drives had tripped.
  void trip() { alarm_ = "a drive tripped"; }
  /// Without alarm, and its program at MXT.
  void reset();
  /// As if somebody else had led each joint so far, rad; what is measured follows.
  void be_led(double way);
  const JointAngles& measured() const { return measured_; }
  const JointAngles& commanded() const { return commanded_; }
  /// Sessions that were ended as they should be.
  int ends() const { return ends_; }
  /// Something was said to it, and after that no end.
  bool is_in_session() const { return in_session_; }
  /// Packets that commanded a position.
  std::uint64_t moves() const { return moves_; }

 private:
  bool obey(const Packet& packet, std::uint64_t cycles);
  bool take(const Joints& joints, std::uint64_t cycles);

  ControllerPlan plan_;
  JointAngles commanded_{};
  JointAngles measured_{};
  const char* alarm_ = "";
  bool at_mxt_ = true;
  int ends_ = 0;
  bool in_session_ = false;
  std::uint64_t moves_ = 0;
};

}  // namespace flexrf::melfa
