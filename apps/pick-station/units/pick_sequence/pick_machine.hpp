// PickMachine: the states of the cell, from off over homing to the steps of a cycle, and back from whatever
// goes wrong. It knows no ports: it is told what is seen and wished, and says what is to be done.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/status.hpp"
#include "base/time.hpp"
#include "types/gantry_order.hpp"
#include "types/gantry_state.hpp"
#include "types/gripper_object.hpp"
#include "types/pick_mode.hpp"
#include "types/pick_state.hpp"

namespace flexrf::user {

/// Positions in m, as the axes count.
struct PickPlan {
  std::array<double, 2> feeder{};
  std::array<double, 2> tray{};
  double travel_height = 0;
  Duration step_timeout = std::chrono::seconds(10);
  Duration homing_timeout = std::chrono::seconds(90);
};

/// What a person wants; the first ones are presses since the step before.
struct PickWishes {
  bool start = false;
  bool hold = false;
  bool home = false;
  bool reset = false;
  bool next_step = false;
  bool open_gripper = false;
  bool close_gripper = false;
  PickMode mode = PickMode::automatic;
  double speed = 1;
  std::uint32_t batch = 0;
  std::uint8_t grip_attempts = 1;
  Duration patience = std::chrono::seconds(5);
  bool ask_camera = false;
};

/// What is seen in a step.
struct PickView {
  Time now{};
  bool may_move = false;
  bool stop_requested = false;
  const GantryState* gantry = nullptr;  ///< null: it says nothing
  struct {
    bool known = false;
    bool activated = false;
    bool moving = false;
    bool detects = true;
    GripperObject object = GripperObject::unknown;
    const char* trouble = "";
  } gripper;
  std::optional<bool> part;      ///< the feeder's word; nothing: it does not answer
  std::optional<bool> sight;     ///< the camera's
  const char* station = "";      ///< why the feeder does not answer
  bool stop_is_pressed = false;  ///< the emergency stop
};

enum class GripperAct : std::uint8_t { none, activate, open, close };

/// Why it cannot go on.
enum class PickTrouble : std::uint8_t { none, gantry, gripper, nothing_gripped, part_lost, too_slow };

class PickMachine {
 public:
  void begin(const PickPlan& plan) noexcept;
  void step(const PickView& view, const PickWishes& wishes) noexcept;

  // ---- what is to be done

  const GantryOrder& order() const noexcept { return order_; }
  GripperAct gripper_act() const noexcept { return act_; }
  /// To the feeder: bring the next part; until it says that the place is empty.
  bool next_part() const noexcept { return next_part_; }

  // ---- what it is at

  PickState state() const noexcept { return state_; }
  /// Of held: with which state it goes on.
  PickState resumes_with() const noexcept { return resume_; }
  PickTrouble trouble() const noexcept { return trouble_; }
  /// Of a trouble: in words; empty where the trouble says it all.
  const char* cause() const noexcept { return cause_.cause(); }
  /// It waits for a part for longer than its patience.
  bool waits_long() const noexcept { return waits_long_; }
  bool batch_is_done() const noexcept { return batch_is_done_; }
  bool is_in_cycle() const noexcept { return state_ >= PickState::to_feeder && state_ <= PickState::rising; }
  /// Nothing is under way that should be completed.
  bool is_at_rest() const noexcept {
    return !is_in_cycle() && state_ != PickState::homing && state_ != PickState::recovering;
  }

  struct Counters {
    std::uint64_t parts = 0;
    std::uint64_t missed_grips = 0;
    std::uint64_t lost_parts = 0;
    std::uint64_t faults = 0;
    double cycle_time = 0;  ///< s
  };
  const Counters& counters() const noexcept { return counters_; }
  void clear_counters() noexcept { counters_ = {}; }

 private:
  void follow_feeder() noexcept;
  void ask_for_next_part() noexcept;
  void supervise() noexcept;
  void leave_off() noexcept;
  void act() noexcept;
  void idle() noexcept;
  void move_gripper_by_hand() noexcept;
  void wait_for_part() noexcept;
  void grip() noexcept;
  void release() noexcept;
  void prepare_axes() noexcept;
  void begin_cycle() noexcept;
  void finish_cycle() noexcept;

  void enter(PickState state) noexcept;
  void complete(PickState next) noexcept;
  void hold() noexcept;
  void give_up(PickTrouble trouble, const Status& cause = {}) noexcept;
  void fail_of_gantry(const char* otherwise) noexcept;
  void order(GantryCommand command, std::array<double, 2> point = {}) noexcept;
  bool order_is_done() noexcept;
  void move_when_done(PickState next) noexcept;
  bool holds_part() const noexcept;
  bool gripper_rests() const noexcept { return view_->gripper.known && !view_->gripper.moving; }

  PickPlan plan_;
  const PickView* view_ = nullptr;      // of the step under way
  const PickWishes* wishes_ = nullptr;  // likewise
  PickState state_ = PickState::off;
  PickState resume_ = PickState::ready;
  PickTrouble trouble_ = PickTrouble::none;
  Status cause_;
  GantryOrder order_{};
  GripperAct act_ = GripperAct::none;
  Time entered_{};
  Time permitted_since_{};
  std::uint8_t stage_ = 0;  // of a state that has several
  std::uint8_t attempts_ = 0;
  bool next_part_ = false;
  bool saw_place_empty_ = false;  // since the feeder was asked for the next part
  Time asked_since_{};
  bool took_part_ = false;  // and the feeder was not told yet
  bool was_interrupted_ = false;
  bool hold_wished_ = false;
  bool moved_by_hand_ = false;
  bool waits_long_ = false;
  bool batch_is_done_ = false;
  std::uint32_t in_batch_ = 0;
  Time cycle_began_{};  // none: it was interrupted
  Counters counters_;
};

}  // namespace flexrf::user
