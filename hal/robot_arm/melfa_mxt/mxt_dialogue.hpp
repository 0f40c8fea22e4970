// What a PC and a MELFA controller say to each other over MXT, from finding each other to the end of the
// session. The controller's robot program has to be at its MXT instruction.
#pragma once

#include <optional>

#include "base/status.hpp"
#include "hal/robot_arm/melfa_mxt/mxt_packet.hpp"
#include "hal/robot_arm/paced/answer_pacing.hpp"
#include "hal/robot_arm/paced/datagram_link.hpp"
#include "hal/robot_arm/paced/joint_follower.hpp"

namespace flexrf::melfa {

struct DialoguePlan {
  double cycle = 0.00711;  ///< of the controller, s
  PacingLimits pacing;
};

/// What the controller said last.
struct ToldJoints {
  JointAngles commanded{};  ///< rad
  JointAngles measured{};   ///< rad
  JointAngles velocity{};   ///< rad/s, from the measured ones
};

/// One thread; never blocks, never allocates, but for begin() and close(): the lifecycle thread.
class MxtDialogue {
 public:
  /// Error: the plan or the chain makes no sense. Link and chain outlive the dialogue.
  Status begin(const DialoguePlan& plan, const KinematicChain& chain, DatagramLink& link);
  /// Ends the session and waits for the controller to know it, three times at most.
  void close();

  /// All that arrived. Then commands, then send().
  void receive(Time now) noexcept;
  /// Finite. Without effect while it does not lead, and not remembered.
  void command(const JointAngles& wanted) noexcept;
  /// When the packet before is answered or given up, the next one.
  void send(bool may_move, Time now) noexcept;

  /// To rest, then the end of the session; until reopen() nothing more is sent.
  void end() noexcept { ends_ = true; }
  bool has_ended() const noexcept { return phase_ == Phase::ended; }
  void reopen() noexcept;

  /// Nothing while the controller is not heard.
  const std::optional<ToldJoints>& told() const noexcept { return told_; }
  /// When the answer that told it arrived; no time: nothing is told.
  Time told_at() const noexcept { return told_ ? told_at_ : Time{}; }
  /// Commands are followed.
  bool is_leading() const noexcept { return phase_ == Phase::leading && !follower_.brakes(); }
  /// While it leads: that the joints are led faster than they may go or accelerate.
  Restraint restraint() const noexcept { return follower_.restraint(); }
  const PacingCounters& counters() const noexcept { return pacing_.counters(); }
  /// Answers tell of a position of this joint, counted from 1, which the chain does not have: they are of
  /// another arm, or the chain lacks an axis, which every packet would command to 0. They are foreign. 0:
  /// none did.
  std::size_t unknown_joint() const noexcept { return unknown_joint_; }
  /// The controller fell silent while it was led.
  bool has_lost_it() const noexcept { return lost_; }

 private:
  enum class Phase : std::uint8_t { monitoring, leading, ending, ended };

  void take(const Packet& reply, Time at, Time now) noexcept;
  bool has_unknown_joint(const std::optional<Joints>& joints) noexcept;
  void tell(std::uint16_t what, Time now) noexcept;
  void lead(bool may_move, Time now) noexcept;
  void finish(Time now) noexcept;
  void await();
  bool is_at_rest() const noexcept;

  DialoguePlan plan_;
  const KinematicChain* chain_ = nullptr;
  DatagramLink* link_ = nullptr;
  AnswerPacing pacing_;
  JointFollower follower_;
  Phase phase_ = Phase::monitoring;
  bool ends_ = false;
  bool lost_ = false;
  int ends_said_ = 0;
  std::uint64_t strangers_ = 0;
  std::size_t unknown_joint_ = 0;
  std::optional<ToldJoints> told_;
  Time told_at_{};   // its arrival
  Time taken_at_{};  // the cycle that took it
  Time now_{};
};

}  // namespace flexrf::melfa
