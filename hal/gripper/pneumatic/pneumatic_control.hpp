// How two valves are switched and what two reed switches mean. Without I/O.
#pragma once

#include <array>

#include "hal/gripper/interface/gripper.hpp"

namespace flexrf::pneumatic {

enum class End : std::uint8_t { none, open, closed };

struct ControlPlan {
  double open_width = 0.085;  ///< m
  double closed_width = 0;    ///< m
  Duration travel_timeout = std::chrono::seconds(3);
  Duration dead_time = std::chrono::milliseconds(20);
  bool closed_centre = false;
  bool object_between = true;
};

/// What the reed switches say.
struct Reeds {
  bool open = false;
  bool closed = false;
};

/// Never blocks, never allocates. One thread. A cycle: receive(), then commands, then valve().
class Control {
 public:
  void begin(const ControlPlan& plan) noexcept;

  /// `reeds`: nothing while the lines are away. When they come back both valves are off.
  void receive(const std::optional<Reeds>& reeds, Time now) noexcept;

  /// Fully open or fully closed. Without effect while nothing is known of its lines, or its switches
  /// contradict each other.
  void go(End towards) noexcept;
  /// With a closed centre the fingers stop; else they go on.
  void halt() noexcept;
  /// A trouble that is over, or is to be tried again, is forgotten.
  void forgive() noexcept;

  /// The valve that is to be on, towards this end; never both, and never one sooner than the dead time after
  /// the other. Once in each cycle.
  End valve() noexcept;
  /// The valve that is to be on once the dead time is over.
  End wanted_valve() const noexcept { return wanted_; }
  bool is_moving() const noexcept { return phase_ == Phase::going; }
  bool follows() const noexcept { return reeds_ && !contradict(); }

  const std::optional<GripperState>& state() const noexcept { return state_; }
  const Status& trouble() const noexcept { return trouble_; }

 private:
  enum class Phase : std::uint8_t { resting, going };

  bool contradict() const noexcept { return reeds_ && reeds_->open && reeds_->closed; }
  End end() const noexcept;
  void follow() noexcept;
  void give_up() noexcept;
  void watch() noexcept;
  void renew() noexcept;

  ControlPlan plan_;
  Phase phase_ = Phase::resting;
  std::optional<Reeds> reeds_;
  Time now_{};
  Time began_{};
  End target_ = End::none;
  End arrived_ = End::none;  // where it rests, and is to stay
  End wanted_ = End::none;   // the valve
  End on_ = End::none;       // likewise, as it is
  Time off_since_{};
  GripperObject object_ = GripperObject::unknown;
  Status latched_;  // until forgive()
  std::optional<GripperState> state_;
  Status trouble_;
};

}  // namespace flexrf::pneumatic
