// FingerControl: a gripper that exists in memory only, for mocks and for drivers over a scene.
#pragma once

#include "hal/gripper/interface/finger_model.hpp"
#include "hal/gripper/interface/gripper.hpp"

namespace flexrf {

/// What such a gripper does with what it is told: its fingers move as fast as commanded, without inertia, and
/// rest at the goal or at what they meet. Allocates nothing. One thread.
class FingerControl {
 public:
  enum class Fault : std::uint8_t {
    none,
    silent,   ///< it is not heard
    stuck,    ///< the fingers do not move
    tripped,  ///< it reports a fault of its own, until activate()
    off,      ///< without power: not heard, and afterwards not activated
  };

  struct Plan {
    const char* whose = "";     ///< for messages: "the mock's"; lives for ever
    double closed_width = 0;    ///< m
    double open_width = 1;      ///< m
    double speed = 0.05;        ///< m/s, of a goal that does not say
    double activation = 0;      ///< s; 0: it is activated from the start
    double travel_timeout = 3;  ///< s
    bool halts = true;          ///< the fingers can stop anywhere
  };

  void begin(const Plan& plan) noexcept;
  /// To the time of this cycle.
  void advance(Duration elapsed) noexcept;

  // As of the interface Gripper; a driver asks whether it may act.

  void go(const GripperGoal& goal) noexcept;
  void activate() noexcept;
  void halt() noexcept;
  bool is_ready() const noexcept { return is_heard() && known_.activated; }
  bool is_at_rest() const noexcept { return !known_.moving; }

  bool is_heard() const noexcept { return fault_ != Fault::silent && fault_ != Fault::off; }
  /// What it says when it is heard, but for the opening.
  const GripperState& known() const noexcept { return known_; }
  const Status& trouble() const noexcept { return trouble_; }
  /// The goal in force, speed and force too.
  const std::optional<GripperGoal>& goal() const noexcept { return goal_; }
  FingerModel& fingers() noexcept { return fingers_; }
  const FingerModel& fingers() const noexcept { return fingers_; }
  void set_fault(Fault which) noexcept;

 private:
  void stand_still(GripperObject object) noexcept;

  Plan plan_;
  FingerModel fingers_{0, 1};
  Fault fault_ = Fault::none;
  GripperState known_;
  Status trouble_;
  std::optional<GripperGoal> goal_;
  Duration spent_{};  // on what it is at
  bool activating_ = false;
};

}  // namespace flexrf
