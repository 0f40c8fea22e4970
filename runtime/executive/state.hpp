// What the executive keeps of each unit, device and thread while the application runs. All-zero is the first
// state.
#pragma once

#include <atomic>
#include <cstdint>

#include "base/time.hpp"
#include "runtime/core/histogram.hpp"
#include "runtime/core/shared_status.hpp"
#include "runtime/device/device.hpp"

namespace flexrf {

class Unit;
struct ComponentType;
struct DriverRecord;

/// Life of a unit or device, as the lifecycle thread drives it and everybody may see it.
/// `waiting`: a device that is not there and need not be (DeviceRecord::required), or a component that stands
/// on one. It is not stepped, and is no fault; ComponentState::fault says what it waits for.
enum class Life : std::uint8_t { created, initialised, running, stopped, fault, waiting };
const char* name_of(Life life) noexcept;

/// Who may touch a unit's object now. Ownership passes by this word alone: the lifecycle thread asks, the
/// unit's thread acknowledges between two steps.
enum class Ownership : std::uint8_t {
  lifecycle,   ///< the lifecycle thread
  thread,      ///< the unit's thread
  asked_back,  ///< the unit's thread, which is asked to let go
};

/// Of a unit and of a device alike.
struct ComponentState {
  // First, as it is large and seldom asked for: what every step touches lies together behind it, and of a
  // unit in the same cache lines as what UnitState adds.
  SharedStatus fault;  ///< why; published before life becomes fault or waiting
  /// What is declared of it: of a device by the chosen driver, with ranges as the application narrows them.
  const ComponentType* type = nullptr;
  const DriverRecord* driver = nullptr;  ///< the chosen one; null: it has none, as a unit
  std::atomic<Life> life{Life::created};
  std::atomic<Ownership> ownership{Ownership::lifecycle};
  SharedRestraint restraint;
  std::atomic<bool> active{false};  ///< member of a population: stepped. Others: always true
  std::atomic<bool> idle{true};     ///< what is_idle() said after the last step
  std::atomic<bool> stop_requested{
      false};                           ///< it alone is to come to rest: the lifecycle thread will stop it
  std::atomic<std::uint64_t> steps{0};  ///< of its own: a device takes none
  std::atomic<std::int64_t> execution_maximum{0};  ///< ns, longest step
  std::atomic<std::int64_t> execution_total{0};    ///< ns, all steps
  std::atomic<std::uint64_t> budget_overruns{0};   ///< steps beyond the declared budget, see BudgetWatch

  bool is_owned_by_thread() const noexcept {
    return ownership.load(std::memory_order_acquire) == Ownership::thread;
  }
  bool is_in_fault() const noexcept { return life.load(std::memory_order_acquire) == Life::fault; }
};

struct UnitState : ComponentState {
  Unit* unit = nullptr;
  Time stepped_at{};  ///< the unit's thread only
};

struct DeviceState : ComponentState {
  Device* device = nullptr;
  std::atomic<bool> make_safe{false};  ///< its unit or itself is in fault: its thread makes it safe
  std::atomic<bool> safe{false};       ///< make_safe() said so
  /// It was told to be safe, as an actuator, and has not confirmed it: its thread goes on telling it.
  std::atomic<bool> unconfirmed{false};
  Time unconfirmed_since{};         ///< its thread only; no time: somebody was told
  std::atomic<bool> guards{false};  ///< guards_motion(), as it was or is to be initialised
  bool demands = false;             ///< counted in Control; its thread only, before the start the main thread
  DeviceEnvironment environment;
};

struct ThreadState {
  std::atomic<std::uint64_t> cycles{0};
  std::atomic<std::uint64_t> overruns{0};     ///< cycles that ended after their deadline or the next release
  std::atomic<std::uint64_t> skipped{0};      ///< releases left out by the policy
  std::atomic<std::int64_t> skipped_time{0};  ///< ns, of those
  std::atomic<std::int64_t> longest_standstill{0};  ///< ns; see Standstill. 0: there was none
  std::atomic<std::uint64_t> allocations{0};        ///< allocations and frees in the real-time part
  std::atomic<bool> asked_back{false};              ///< a unit or device of this thread is asked_back
  std::atomic<std::int64_t> step_began{0};          ///< ns; 0 while not stepping: how a hung thread is seen
  std::atomic<const char*> stepped{nullptr};  ///< unit or device that its thread is busy with; null: none
  std::atomic<std::uint64_t> turns{0};  ///< with a step or without: that it runs at all; see HeartbeatWatch
  /// Control::withdrawals() as of its last whole cycle without the permission to move.
  std::atomic<std::uint32_t> inhibited_for{0};
  std::atomic<std::int32_t> thread_id{0};  ///< kernel's, for /proc
  // Of a thread that polls by back-off: what it learned of the time between arrivals, ns; 0 before.
  std::atomic<std::int64_t> backoff_mean{0};
  std::atomic<std::int64_t> backoff_spread{0};
  // What the kernel counted from the thread's first wait to its end; filled in at the end.
  std::atomic<std::uint64_t> minor_faults{0};
  std::atomic<std::uint64_t> major_faults{0};
  std::atomic<std::uint64_t> voluntary_switches{0};
  std::atomic<std::uint64_t> involuntary_switches{0};
  Histogram lateness;
  Histogram execution;
};

}  // namespace flexrf
