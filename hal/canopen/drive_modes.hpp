// What the modes of CiA 402 ask for beside the state machine: handshakes.
#pragma once

#include <optional>

#include "base/status.hpp"
#include "base/time.hpp"
#include "hal/canopen/cia402.hpp"

namespace flexrf::canopen::cia402 {

/// Profile position: hands one set-point after the other to the drive, by new set-point (controlword bit 4)
/// and its acknowledge (statusword bit 12).
class SetPointHandshake {
 public:
  /// `speed`: before the first command. `at_once` false: of a drive that takes a set-point only when it is at
  /// the one before (controlword bit 5 is 0), and may say until then that it has that one.
  explicit SetPointHandshake(Duration timeout, double speed = 0, bool at_once = true) noexcept
      : timeout_{timeout}, at_once_{at_once}, speed_{speed} {}

  /// At every enabling: nothing is on its way. `actual`: where the axis is, for target().
  void reset(std::int32_t actual) noexcept;
  /// The newest one counts: one that has not been offered yet is forgotten. `speed`: of its profile.
  void command(std::int32_t target, double speed) noexcept { waiting_ = {target, speed}; }
  /// Once for each cycle in which operation is enabled: the bits to add to the controlword. The new set-point
  /// bit rises a cycle after its target and its speed are told: a drive may act on each object as it is
  /// written, on the controlword before the target beside it, or after it at the next SYNC. `is_told` false:
  /// what does not go beside the controlword has not arrived yet, and the bit waits for it.
  std::uint16_t advance(std::uint16_t statusword, Time now, bool is_told = true) noexcept;
  /// For object 607A, beside the bits.
  std::int32_t target() const noexcept { return target_; }
  /// Of that target.
  double speed() const noexcept { return speed_; }
  /// The drive goes to target(), and nothing else is on its way to it.
  bool is_taken() const noexcept {
    return (step_ == Step::free || step_ == Step::withdrawn) && (!waiting_ || !at_once_);
  }
  /// The drive may be on its way to a target, and go on to it after a halt.
  bool may_be_under_way() const noexcept { return is_under_way_ || step_ == Step::offered; }
  /// The last command waits until the drive is at the one before.
  bool is_kept_waiting() const noexcept { return waiting_ && !at_once_ && is_under_way_; }
  /// The drive took the last command and says that it is there; before it took it, it may say so of the one
  /// before.
  bool is_reached(std::uint16_t statusword) const noexcept {
    return step_ == Step::free && !waiting_ && (statusword & status_bit::target_reached) != 0;
  }
  const Status& problem() const noexcept { return problem_; }

 private:
  enum class Step : std::uint8_t { free, prepared, offered, withdrawn };

  struct Waiting {
    std::int32_t target = 0;
    double speed = 0;
  };

  void give_up(std::uint16_t statusword) noexcept;

  Duration timeout_;
  bool at_once_;
  bool is_under_way_ = false;  // to a target that it took
  Step step_ = Step::free;
  std::optional<Waiting> waiting_;
  std::int32_t target_ = 0;
  double speed_;
  Time since_{};
  Status problem_;
};

/// Interpolated position: points are followed once interpolation is enabled (controlword bit 4) and active
/// (statusword bit 12); before that they are ignored.
class InterpolationSwitch {
 public:
  explicit InterpolationSwitch(Duration timeout) noexcept : timeout_{timeout} {}

  /// Operation is not enabled: all begins anew.
  void reset() noexcept { *this = InterpolationSwitch{timeout_}; }
  /// Another mode in between, as homing is: it is enabled anew afterwards.
  void lower() noexcept { step_ = Step::off; }
  /// Once for each cycle in which operation is enabled in this mode: the bit to add to the controlword. It
  /// rises a cycle after the first point, where the axis is, is told.
  std::uint16_t advance(std::uint16_t statusword, Time now) noexcept;
  bool is_active() const noexcept { return step_ == Step::active; }
  /// Since reset().
  bool was_active() const noexcept { return was_active_; }
  const Status& problem() const noexcept { return problem_; }

 private:
  enum class Step : std::uint8_t { off, prepared, asked, active };

  Duration timeout_;
  Step step_ = Step::off;
  bool was_active_ = false;
  Time since_{};
  Status problem_;
};

/// A homing run, by start (controlword bit 4) and the statusword's bits 10, 12 and 13.
class HomingRun {
 public:
  enum class State : std::uint8_t { idle, running, done, failed };

  /// `timeout`: for the whole run. `settle`: so long after it heard of the start the drive may still say what
  /// it said of the run before. Time in which it is not heard does not count, as it may not hear us either.
  /// `tells_reached` false: a drive that says that its home was found by bit 12 alone, and leaves bit 10;
  /// then it has to be at rest, too.
  HomingRun(Duration timeout, Duration settle, bool tells_reached) noexcept
      : timeout_{timeout}, settle_{settle}, tells_reached_{tells_reached} {}

  void start() noexcept;
  /// Once for each cycle in which operation is enabled in mode homing: the bits to add to the controlword.
  /// `is_new`: the statusword came since the cycle before.
  std::uint16_t advance(std::uint16_t statusword, bool is_new, bool at_rest, Time now) noexcept;
  /// Operation is not enabled any more: what was running has failed.
  void interrupt() noexcept;

  State state() const noexcept { return state_; }
  const Status& problem() const noexcept { return problem_; }

 private:
  /// Statuswords after the start that cannot be about it: a set-point takes a SYNC, and its effect another.
  static constexpr int latency = 2;
  /// Cycles without a new statusword, as happens when both ends' clocks drift, before it counts as not heard.
  static constexpr int most_unheard = 2;

  void fail(const Status& problem) noexcept;
  void hear(bool is_new, Time now) noexcept;
  bool is_about_this_run(bool is_in_progress, Time now) noexcept;

  Duration timeout_;
  Duration settle_;
  bool tells_reached_;
  State state_ = State::idle;
  bool lowered_ = false;  // bit 4 was sent low, so that it rises
  bool raised_ = false;
  bool saw_it_running_ = false;  // what the drive says is of this run
  int heard_ = 0;                // new statuswords since the start, or since it was not heard
  int unheard_ = 0;
  Time heard_since_{};
  Time since_{};
  Status problem_;
};

}  // namespace flexrf::canopen::cia402
