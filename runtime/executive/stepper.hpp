// Stepper: the work of one thread, whoever drives it: its own loop on the wall clock, or the scheduler of
// virtual time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/executive/budget_watch.hpp"
#include "runtime/executive/cell.hpp"

namespace flexrf {

/// Why and when a thread was released.
struct Release {
  Time nominal{};
  Time now{};
  std::uint32_t fired = 0;
  bool timed_out = false;
};

/// All functions: the thread that it steps.
class Stepper {
 public:
  Stepper(Cell& cell, std::uint16_t thread);

  /// Between steps, at every wake: hands back what the lifecycle thread asks for, applies requests. Nothing
  /// to do costs three loads.
  void serve(Time now) noexcept;

  /// One release on the wall clock: receive, step all units, send. Reads the clock once per unit; returns the
  /// end.
  Time run(const Release& release) noexcept;

  // The parts of run(), for virtual time.
  void begin(const Release& release) noexcept;
  void receive(Time now) noexcept;
  /// Steps the unit at this place in the thread's order, if it runs. Whether it did.
  bool step(std::size_t place, Time now) noexcept;
  void send(Time now) noexcept;
  /// The release is over.
  void finish() noexcept;

  /// Puts every unit of the thread in fault (its overrun limit is reached).
  void fault_all(const Status& cause) noexcept;
  /// Every device of the thread says it is safe.
  bool is_safe() const noexcept;
  /// In every turn: logs of budgets what is to be logged by then; at the end, with Time::max(), the rest.
  void say(Time now) noexcept { budgets_.say(now); }
  /// How often a thread is released without a trigger while it needs attention.
  static constexpr Duration attention_interval = std::chrono::milliseconds{5};
  /// Must be released soon even if nothing triggers it: a stop is to be seen, a device to be made safe.
  bool needs_attention() const noexcept;

  const ThreadRecord& record() const noexcept { return *record_; }
  ThreadState& state() noexcept { return *state_; }

 private:
  StepTrace* asked_trace(Time now) const noexcept;
  void begin_step(Time now) noexcept;
  void note_stepped(const char* component) noexcept;
  void give_back() noexcept;
  void apply(const ParameterRequest& request, Time now) noexcept;
  void apply_to_member(const ParameterRequest& request, std::uint16_t unit, Time now) noexcept;
  void follow_motion_permission(Time now) noexcept;
  void follow_safe_state() noexcept;
  void follow_demands(Time now) noexcept;
  void make_safe() noexcept;
  void note_confirmation(std::uint16_t device, bool is_safe) noexcept;
  bool is_to_be_safe(std::uint16_t device) const noexcept;
  void check_device(std::uint16_t device) noexcept;
  void fault_unit(std::uint16_t unit, const Status& cause) noexcept;
  void publish_feedback(SlotControl* slot, const ParameterBlock& block, const void* values,
                        Time now) noexcept;
  bool owns_device(std::uint16_t device) const noexcept;

  Cell* cell_;
  const Application* application_;
  const ThreadRecord* record_;
  ThreadState* state_;
  StepContext* context_;
  BudgetWatch budgets_;
  Tick tick_{};
  bool may_move_ = false;
  std::uint32_t withdrawals_ = 0;           // of the permission to move, as seen last
  std::optional<std::uint32_t> inhibited_;  // withdrawals at the beginning of a cycle without the permission
  bool receives_ = false;                   // has any device at all
  bool making_safe_ = false;
  bool safe_state_ = false;  // demanded by a device and not cleared, as seen last
  bool stopping_ = false;    // the whole application
};

}  // namespace flexrf
