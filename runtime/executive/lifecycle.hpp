// Lifecycle: initialises, stops and restarts units and devices, one at a time, away from the real-time
// threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "runtime/executive/cell.hpp"

namespace flexrf {

/// All functions but post, has_jobs, close and operation: the lifecycle thread; in virtual time, the only
/// thread.
class Lifecycle {
 public:
  /// `threads_run`: ownership is handed over to threads that must acknowledge; in virtual time there are
  /// none.
  Lifecycle(Cell& cell, bool threads_run) noexcept : cell_(&cell), threads_run_(threads_run) {}

  /// In the starting order. The first failure ends it and is returned; a device that is waited for, and what
  /// stands on one, is none.
  Status start_all() noexcept;
  /// Takes back and stops everything, in the reverse order.
  void stop_all() noexcept;

  /// Initialises it and hands it over to its thread. A device with `required = false` that is not there
  /// (not_found, unavailable, timeout) is waited for until it runs, whatever the reason becomes, and so is
  /// what stands on it: its life becomes Life::waiting, and the error says why.
  Status start(ComponentIndex component) noexcept;
  /// Tries to start what is waited for, twice a second at most. A late component that moves something needs a
  /// new Start.
  void seek_missing() noexcept;
  /// A running unit that owns an actuator is brought to rest first: it sees stop_requested and has its
  /// stop_timeout to become idle; then nothing moves before the next Start, and its devices are made safe if
  /// it did not. An actuator is inhibited first.
  Status stop(ComponentIndex component) noexcept;
  /// Stop, destroy, construct in place, initialise; motion needs a new Start.
  Status restart_unit(std::uint16_t unit) noexcept;
  /// Has a job done by the lifecycle thread, between two operations; false, and nothing is done, after
  /// close(). Any non-real-time thread; does not wait.
  bool post(std::function<void()> job);
  bool has_jobs() const noexcept { return has_jobs_.load(std::memory_order_acquire); }
  /// Does what was posted.
  void run_jobs();
  /// Nothing more is taken; what was posted before is done.
  void close();
  /// Restarts what its policy lets restart.
  void restart_by_policy() noexcept;

  /// Virtual time: what the values in force are stamped with. Null: the wall's clock.
  void use_clock(const Time* clock) noexcept { clock_ = clock; }

  /// The units' threads are joined: nobody acknowledges any more. The supervising thread.
  void threads_ended() noexcept { threads_run_.store(false, std::memory_order_release); }

  /// What the lifecycle thread is at, for whoever watches that it does not hang. Any thread.
  struct Operation {
    const char* component;  ///< null: nothing
    Time overdue_at;
  };
  Operation operation() const noexcept;

 private:
  Status take_back(ComponentIndex component) noexcept;
  const char* missing_below(ComponentIndex component) const noexcept;
  bool may_be_missing(ComponentIndex component, bool is_missing) const noexcept;
  Status wait_for(ComponentIndex component, const Status& cause) noexcept;
  void prepare_device(std::uint16_t device) noexcept;
  void begin(ComponentIndex component) noexcept;
  void bring_to_rest(std::uint16_t unit) noexcept;
  bool is_at_rest(std::uint16_t unit) const noexcept;
  bool devices_are_safe(std::uint16_t unit) const noexcept;
  void begin_operation(const char* component, Duration timeout) noexcept;
  void end_operation() noexcept;
  bool may_restart(std::uint16_t unit) const noexcept;
  Time now() const noexcept;

  /// The application's time; operations are timed by the wall's.
  Time stamp() const noexcept { return clock_ != nullptr ? *clock_ : now(); }

  Cell* cell_;
  const Time* clock_ = nullptr;
  std::atomic<bool> threads_run_;
  std::mutex jobs_mutex_;
  std::vector<std::function<void()>> jobs_;
  bool closed_ = false;
  std::atomic<bool> has_jobs_{false};
  std::atomic<const char*> component_{nullptr};
  std::atomic<std::int64_t> overdue_at_{0};
  Time seek_at_{};
  std::vector<std::uint16_t> restarts_ = std::vector<std::uint16_t>(cell_->application().units.size());
};

}  // namespace flexrf
