// How a Robotiq gripper is led: what it is told next, from what it said last. Without I/O.
#pragma once

#include <string_view>

#include "hal/gripper/interface/gripper.hpp"
#include "hal/gripper/robotiq/robotiq_registers.hpp"

namespace flexrf::robotiq {

struct ControlPlan {
  double open_width = 0.085;  ///< m, at open_count
  double closed_width = 0;    ///< m, at closed_count
  std::uint8_t open_count = 0;
  std::uint8_t closed_count = 255;
  double slowest = 0.02;   ///< m/s, at count 0
  double fastest = 0.15;   ///< m/s, at count 255
  double weakest = 20;     ///< N, at count 0
  double strongest = 235;  ///< N, at count 255
  double speed = 0.05;     ///< where a goal has none
  double force = 40;       ///< likewise
  Duration travel_timeout = std::chrono::seconds(3);
  Duration activation_timeout = std::chrono::seconds(10);
};

/// Never blocks, never allocates. One thread. A cycle: receive() of what was told, then commands, then
/// action().
class Control {
 public:
  void begin(const ControlPlan& plan) noexcept;

  /// `told`: nothing while it is not heard. `is_taken`: it has what action() said last, and `told` is newer.
  /// `silence`: why it is not heard, for a person.
  void receive(const std::optional<Told>& told, bool is_taken, Time now, std::string_view silence) noexcept;

  void activate() noexcept;
  void command(const GripperGoal& goal) noexcept;
  /// Ends what it is at; what it holds stays held.
  void halt() noexcept;
  /// What it is at has ended, and it has what it was told.
  bool is_at_rest() const noexcept { return phase_ == Phase::idle && (!action_ || taken_); }
  bool is_active() const noexcept;

  /// What it shall be told; nothing while it is to be left as it is.
  const std::optional<Action>& action() const noexcept { return action_; }
  /// Once after each time that there was no action: it is to be told even if it was told the same before.
  bool take_anew() noexcept;

  const std::optional<GripperState>& state() const noexcept { return state_; }
  const Status& trouble() const noexcept { return trouble_; }

 private:
  enum class Phase : std::uint8_t { idle, resetting, activating, going, halting };

  void lose(std::string_view silence) noexcept;
  void adopt(const Told& told) noexcept;
  void follow(const Told& told) noexcept;
  bool is_borne_out(const Told& told) noexcept;
  void watch_grip(const Told& told) noexcept;
  void check_time() noexcept;
  void tell(const Action& action) noexcept;
  void renew_state() noexcept;
  void renew_trouble() noexcept;

  ControlPlan plan_;
  Phase phase_ = Phase::idle;
  std::optional<Told> told_;
  std::optional<Action> action_;
  bool anew_ = false;
  bool taken_ = false;
  bool was_active_ = false;  // when it was last heard
  Time now_{};
  std::optional<Time> began_;  // what it is at
  bool moved_ = false;         // since it has this goal
  std::uint8_t stands_at_ = 0;
  Time stands_since_{};
  GripperObject object_ = GripperObject::unknown;
  Status latched_;  // until the next command or activation
  Status silence_;
  std::optional<GripperState> state_;
  Status trouble_;
};

}  // namespace flexrf::robotiq
