// What all threads of a running application share: its mode, the stop latch, the Start.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/blackboard/doorbell.hpp"

namespace flexrf {

/// Where the application stands. Only ever rises.
enum class Mode : std::uint8_t {
  starting,  ///< devices and units are being initialised
  running,
  finishing,  ///< no more input will come: queues drain, units complete what they began
  stopping,   ///< controlled stop: units come to rest
  safe,       ///< every device is made safe; units no longer step
  ended,      ///< threads leave their loops
};
/// The word for it, in files and on the wire: "safe".
const char* name_of(Mode mode) noexcept;
/// As it stands in a sentence, after "is": "in its safe state".
const char* phrase_of(Mode mode) noexcept;

/// Why the application leaves `running`.
enum class EndCause : std::uint8_t {
  none,
  end_of_input,
  virtual_time_over,
  signal,     ///< SIGINT, SIGTERM
  requested,  ///< panel, test
  fault,      ///< a thread hangs, a unit cannot be initialised
};
/// The word for it, in files and on the wire: "end of input".
const char* name_of(EndCause cause) noexcept;

/// What Start checks of each thread that owns an actuator.
struct MotionWitness {
  const char* thread = "";
  /// Control::withdrawals() up to which it has had a whole cycle in which its actuators were inhibited.
  const std::atomic<std::uint32_t>* inhibited_for = nullptr;
};

/// What Start checks of each actuator.
struct SafetyWitness {
  const char* device = "";
  /// It was told to be safe and has not confirmed it.
  const std::atomic<bool>* unconfirmed = nullptr;
};

class Control {
 public:
  constexpr explicit Control(std::span<Doorbell* const> bells) noexcept : bells_(bells) {}

  /// Start waits for each of them. They live as long as this; before anything runs.
  void use_witnesses(std::span<const MotionWitness> threads,
                     std::span<const SafetyWitness> actuators) noexcept {
    threads_ = threads;
    actuators_ = actuators;
  }

  Mode mode() const noexcept { return mode_.load(std::memory_order_acquire); }
  /// Any thread; ignored when the mode is further already. Wakes every thread.
  void rise_to(Mode mode) noexcept {
    Mode now = mode_.load(std::memory_order_relaxed);
    while (now < mode && !mode_.compare_exchange_weak(now, mode, std::memory_order_acq_rel)) {
    }
    wake_all();
  }

  /// The first cause stays. Any thread.
  void set_cause(EndCause cause) noexcept {
    EndCause none = EndCause::none;
    cause_.compare_exchange_strong(none, cause, std::memory_order_acq_rel);
  }
  /// not_permitted in any other mode.
  Status check_running() const noexcept {
    const Mode now = mode();
    if (now == Mode::running) return {};
    return Status::error(StatusCode::not_permitted, "the application is %s, not running", phrase_of(now));
  }
  EndCause cause() const noexcept { return cause_.load(std::memory_order_acquire); }

  /// Stop motion: a latch, handled by each thread in its next control period. Any thread, any signal handler.
  void stop_motion() noexcept {
    stop_motion_.store(true, std::memory_order_seq_cst);
    withdraw();
    wake_all();
  }
  /// Clears the latch; nothing moves before start_motion(). An emergency-stop input that still demands the
  /// safe state latches it again in its next cycle.
  void clear_stop_motion() noexcept {
    safe_state_.store(false, std::memory_order_seq_cst);
    stop_motion_.store(false, std::memory_order_seq_cst);
  }

  /// A device that guards motion does not permit it: until end_demand() there is no Start, and nothing moves.
  /// Any thread.
  void begin_demand() noexcept { demands_.fetch_add(1, std::memory_order_seq_cst); }
  void end_demand() noexcept {
    demands_.fetch_sub(1, std::memory_order_seq_cst);
    wake_all();
  }
  /// Stop motion, and each thread makes its actuators safe, until somebody clears it. Any thread.
  void latch_safe_state() noexcept {
    safe_state_.store(true, std::memory_order_seq_cst);
    stop_motion();
  }
  bool safe_state_latched() const noexcept { return safe_state_.load(std::memory_order_acquire); }

  /// The clock that a Start is stamped with; null: CLOCK_MONOTONIC. To be called while no Start can be given.
  void use_clock(const Time* clock) noexcept { clock_ = clock; }
  /// When motion was permitted last by a Start; a further Start meanwhile does not count. No time: by none.
  Time started_at() const noexcept { return Time{Duration{started_at_.load(std::memory_order_acquire)}}; }

  /// autostart: actuators may move from power-on. Before anything is initialised, so that no unit takes the
  /// moment in between for an inhibition.
  void permit_motion_at_power_on() noexcept { permission_.fetch_or(granted, std::memory_order_seq_cst); }
  /// Nothing moves, and Start is refused with this reason, until permit_motion(); after that everything waits
  /// for a new Start. Any thread but a real-time one.
  void forbid_motion(const Status& reason) noexcept {
    {
      const std::lock_guard lock(forbidding_);
      forbidden_because_ = reason;
      forbidden_.store(true, std::memory_order_seq_cst);
    }
    require_start();
  }
  void permit_motion() noexcept { forbidden_.store(false, std::memory_order_seq_cst); }

  /// Why Start would be refused now. Any thread but a real-time one.
  Status check_start() const noexcept {
    // First: an emergency-stop input's demand from before the application runs does not withdraw autostart.
    if (const Status running = check_running(); !running) return running;
    if (stop_motion_.load(std::memory_order_seq_cst)) {
      return Status::error(StatusCode::not_permitted, "Stop motion is latched; clear it before Start");
    }
    if (forbidden_.load(std::memory_order_seq_cst)) {
      const std::lock_guard lock(forbidding_);
      return forbidden_because_;
    }
    if (demands_.load(std::memory_order_seq_cst) != 0) {
      return Status::error(
          StatusCode::not_permitted,
          "an emergency-stop input does not permit motion; release it, or see to its wiring");
    }
    for (const SafetyWitness& witness : actuators_) {
      if (!witness.unconfirmed->load(std::memory_order_acquire)) continue;
      return Status::error(
          StatusCode::not_permitted,
          "%s was told to be safe and has not confirmed it; see to it that it stands, and give "
          "Start when it has, or when it was initialised anew",
          witness.device);
    }
    for (const MotionWitness& witness : threads_) {
      if (witness.inhibited_for->load(std::memory_order_acquire) == withdrawals()) continue;
      return Status::error(StatusCode::not_permitted,
                           "thread %s has not inhibited its actuators since the last stop; give Start again "
                           "when it has had a cycle",
                           witness.thread);
    }
    return {};
  }
  /// A person's Start: actuators may move. Refused where check_start() says so, and where the permission was
  /// withdrawn at the same time: it is never kept for later. Any thread but a real-time one.
  Status start_motion() noexcept {
    const std::uint64_t before = permission_.load(std::memory_order_seq_cst);
    if (const Status status = check_start(); !status) return status;
    if ((before & granted) == 0) {
      // Stored before the permission is granted: a thread that sees the permission reads its time.
      const Time now = clock_ != nullptr ? *clock_ : MonotonicClock::now();
      started_at_.store(nanoseconds(now), std::memory_order_release);
    }
    // Whatever withdraws it says why first, and then makes this another word.
    std::uint64_t seen = before;
    if (!permission_.compare_exchange_strong(seen, before | granted, std::memory_order_seq_cst) &&
        seen != (before | granted)) {
      return Status::error(
          StatusCode::not_permitted,
          "motion was stopped, or Start was needed anew, at the same time; give Start again");
    }
    wake_all();
    return {};
  }
  /// After a restart or a reconfiguration nothing moves before the next Start.
  void require_start() noexcept {
    withdraw();
    wake_all();
  }
  /// How often the permission to move was withdrawn, so that nobody overlooks one that was given again at
  /// once.
  std::uint32_t withdrawals() const noexcept {
    return static_cast<std::uint32_t>(permission_.load(std::memory_order_seq_cst) / one_withdrawal);
  }
  bool motion_stopped() const noexcept { return stop_motion_.load(std::memory_order_acquire); }
  bool may_move() const noexcept {
    return (permission_.load(std::memory_order_acquire) & granted) != 0 &&
           !stop_motion_.load(std::memory_order_acquire) && !forbidden_.load(std::memory_order_acquire) &&
           demands_.load(std::memory_order_acquire) == 0;
  }

  /// Job control is about to stop the process. From here to end_break() no thread is judged by the time it
  /// takes, and afterwards none for what was due, or under way, before `now`. The supervising thread.
  void begin_break() noexcept { judged_from_.store(nanoseconds(Time::max()), std::memory_order_seq_cst); }
  void end_break(Time now) noexcept { judged_from_.store(nanoseconds(now), std::memory_order_seq_cst); }
  /// Time before this is no thread's fault; Time::max(): the process is about to be stopped, or goes on just
  /// now. Any thread.
  Time judged_from() const noexcept { return Time{Duration{judged_from_.load(std::memory_order_seq_cst)}}; }

  /// The longest time in which the process as a whole did nothing although it should have (Standstill). The
  /// supervising thread.
  void note_standstill(Duration missed) noexcept {
    if (missed > longest_standstill()) longest_standstill_.store(missed.count(), std::memory_order_release);
  }
  /// Any thread. 0: there was none.
  Duration longest_standstill() const noexcept {
    return Duration{longest_standstill_.load(std::memory_order_acquire)};
  }
  /// The supervising thread, in every look: who has nothing else to tell time by sees when it looked last.
  void note_look(Time now) noexcept { looked_at_.store(nanoseconds(now), std::memory_order_release); }
  /// No time: it has not looked yet, or nobody does (virtual time).
  Time looked_at() const noexcept { return Time{Duration{looked_at_.load(std::memory_order_acquire)}}; }

  /// Counts units and devices that went into fault. Any thread.
  void note_fault() noexcept { faults_.fetch_add(1, std::memory_order_release); }
  std::uint32_t faults() const noexcept { return faults_.load(std::memory_order_acquire); }

  void wake_all() noexcept {
    for (Doorbell* bell : bells_) bell->ring();
  }

 private:
  // One word, so that a Start and what withdraws it cannot miss each other: whether motion is permitted, and
  // how often that was withdrawn.
  static constexpr std::uint64_t granted = 1;
  static constexpr std::uint64_t one_withdrawal = 2;

  void withdraw() noexcept {
    std::uint64_t seen = permission_.load(std::memory_order_relaxed);
    while (!permission_.compare_exchange_weak(seen, (seen & ~granted) + one_withdrawal,
                                              std::memory_order_seq_cst, std::memory_order_relaxed)) {
    }
  }

  std::span<Doorbell* const> bells_;
  std::span<const MotionWitness> threads_;
  std::span<const SafetyWitness> actuators_;
  std::atomic<Mode> mode_{Mode::starting};
  std::atomic<EndCause> cause_{EndCause::none};
  std::atomic<bool> stop_motion_{false};
  std::atomic<bool> safe_state_{false};
  std::atomic<std::uint64_t> permission_{0};
  const Time* clock_ = nullptr;
  std::atomic<std::int64_t> started_at_{0};  // ns
  std::atomic<bool> forbidden_{false};
  mutable std::mutex forbidding_;
  Status forbidden_because_;                  // under the mutex
  std::atomic<std::int64_t> judged_from_{0};  // ns
  std::atomic<std::int64_t> longest_standstill_{0};
  std::atomic<std::int64_t> looked_at_{0};
  std::atomic<std::uint32_t> demands_{0};
  std::atomic<std::uint32_t> faults_{0};
};

/// Whether a running application's actuators may move, as it stands in a list of words: "waits for Start".
const char* phrase_of_motion(const Control& control) noexcept;

}  // namespace flexrf
