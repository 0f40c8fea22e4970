#include "hal/gripper/robotiq/robotiq_control.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace flexrf::robotiq {
namespace {

constexpr Duration old_fault = std::chrono::seconds(1);
/// When the fingers have stood for so long, gOBJ is no longer that of the goal before.
constexpr Duration old_status = std::chrono::milliseconds(300);
/// Counts beside its goal at which a gripper has arrived; and at most, where its fingers meet or its travel
/// ends: a 2F-85 that is sent to 255 ends near 228.
constexpr int beside_goal = 4;
constexpr int end_of_travel = 40;

std::uint8_t count_of(double value, double at_first, double at_last, double first, double last) {
  const double share = std::clamp((value - at_first) / (at_last - at_first), 0.0, 1.0);
  return static_cast<std::uint8_t>(std::lround(first + share * (last - first)));
}

GripperObject object_of(Found found) {
  switch (found) {
    case Found::while_opening:
      return GripperObject::gripped_inside;
    case Found::while_closing:
      return GripperObject::gripped;
    case Found::nothing:
      return GripperObject::none;
    case Found::moving:
      break;
  }
  return GripperObject::unknown;
}

}  // namespace

void Control::begin(const ControlPlan& plan) noexcept {
  *this = Control{};
  plan_ = plan;
}

bool Control::is_active() const noexcept {
  return told_ && told_->is_active() && told_->fault < first_major_fault &&
         (phase_ == Phase::idle || phase_ == Phase::going || phase_ == Phase::halting);
}

void Control::tell(const Action& action) noexcept {
  anew_ = anew_ || !action_;
  action_ = action;
  taken_ = false;
}

bool Control::take_anew() noexcept {
  const bool anew = anew_;
  anew_ = false;
  return anew;
}

void Control::receive(const std::optional<Told>& told, bool is_taken, Time now,
                      std::string_view silence) noexcept {
  now_ = now;
  if (!told) {
    lose(silence);
  } else {
    silence_ = {};
    taken_ = is_taken;
    const bool is_first = !told_;
    told_ = told;
    if (is_first) {
      adopt(*told);
    } else {
      follow(*told);
    }
    was_active_ = told->is_active();
  }
  renew_trouble();
  renew_state();
}

/// Whether it goes on with what it was at is not known, and nothing is said to it until it is heard.
void Control::lose(std::string_view silence) noexcept {
  silence_ = Status::error(StatusCode::unavailable, "the gripper is not heard: %.*s",
                           static_cast<int>(silence.size()), silence.data());
  told_.reset();
  action_.reset();
  anew_ = false;
  began_.reset();
  phase_ = Phase::idle;
  object_ = GripperObject::unknown;
}

/// It may have been led by somebody before, and hold something.
void Control::adopt(const Told& told) noexcept {
  if (was_active_ && !told.activate) {
    latched_ = Status::error(StatusCode::device_fault,
                             "the gripper was switched off, and no longer knows where its fingers are; "
                             "activate it");
  }
  object_ = told.is_active() && told.go ? object_of(told.found) : GripperObject::unknown;
}

void Control::follow(const Told& told) noexcept {
  switch (phase_) {
    case Phase::resetting:
      if (!taken_ || told.activate) break;
      tell({.activate = true});
      phase_ = Phase::activating;
      return;
    case Phase::activating:
      if (!taken_ || !told.activate) break;
      // A fault from before may be told for a moment yet.
      if (told.activation == Activation::active ||
          (told.fault >= first_major_fault && began_ && now_ - *began_ > old_fault))
        phase_ = Phase::idle;
      break;
    case Phase::going:
      // Until its echoes are those of this goal, what it found belongs to the one before.
      if (told.fault >= first_major_fault || !told.activate) phase_ = Phase::idle;
      if (!taken_ || !told.go || told.requested != action_->position || !is_borne_out(told)) break;
      object_ = object_of(told.found);
      phase_ = Phase::idle;
      break;
    case Phase::halting:
      if (taken_ && !told.go) phase_ = Phase::idle;
      break;
    case Phase::idle:
      watch_grip(told);
      break;
  }
  const bool resets = action_ && (!action_->activate || phase_ == Phase::activating);
  if (was_active_ && !told.activate && !resets) {
    // It must not come to know again by itself what it was told.
    action_.reset();
    phase_ = Phase::idle;
    object_ = GripperObject::unknown;
    latched_ = Status::error(StatusCode::device_fault,
                             "the gripper was switched off or reset by somebody else; activate it");
  }
  check_time();
}

/// Right after a command gOBJ may still be that of the goal before, while gPR already echoes the new one. So
/// gOBJ counts when the position gPO agrees with it (manual of the 2F-85, 4.4).
bool Control::is_borne_out(const Told& told) noexcept {
  if (told.position != stands_at_) {
    stands_at_ = told.position;
    stands_since_ = now_;
  }
  moved_ = moved_ || told.found == Found::moving;
  const bool is_new = moved_ || now_ - stands_since_ >= old_status;
  const int to_go = int{told.requested} - int{told.position};
  switch (told.found) {
    case Found::moving:
      return false;
    case Found::nothing:
      return std::abs(to_go) <= (is_new ? end_of_travel : beside_goal);
    case Found::while_closing:
      return is_new || to_go >= 0;
    case Found::while_opening:
      break;
  }
  return is_new || to_go <= 0;
}

void Control::watch_grip(const Told& told) noexcept {
  if (!told.is_active() || !told.go) return;
  const bool held = object_ == GripperObject::gripped || object_ == GripperObject::gripped_inside;
  if (!held && object_ != GripperObject::lost) return;
  const bool holds = told.found == Found::while_closing || told.found == Found::while_opening;
  object_ = holds ? object_of(told.found) : GripperObject::lost;
}

void Control::check_time() noexcept {
  if (phase_ == Phase::idle) {
    began_.reset();
    return;
  }
  if (!began_) began_ = now_;
  const bool activates = phase_ == Phase::resetting || phase_ == Phase::activating;
  const Duration limit = activates ? plan_.activation_timeout : plan_.travel_timeout;
  if (now_ - *began_ <= limit) return;
  if (activates) {
    tell({});
    phase_ = Phase::idle;
    latched_ = Status::error(StatusCode::timeout,
                             "the gripper was not activated within %g s; is its 24 V on, and nothing in the "
                             "fingers' way?",
                             seconds(limit));
    return;
  }
  if (phase_ == Phase::going) halt();
  phase_ = Phase::idle;
  latched_ = Status::error(StatusCode::timeout,
                           "the fingers did not come to rest within %g s, neither arrived nor at an object; "
                           "is the gripper damaged, or the time too short for its speed?",
                           seconds(limit));
}

void Control::activate() noexcept {
  if (!told_ || phase_ == Phase::resetting || phase_ == Phase::activating) return;
  latched_ = {};
  if (!is_active()) {
    // rACT must rise.
    tell(told_->activate ? Action{} : Action{.activate = true});
    phase_ = told_->activate ? Phase::resetting : Phase::activating;
    began_ = now_;
    object_ = GripperObject::unknown;
  }
  renew_trouble();
  renew_state();
}

void Control::command(const GripperGoal& goal) noexcept {
  if (!is_active()) return;
  const Action before = action_.value_or(Action{});
  const Action next{
      .activate = true,
      .go = true,
      .position =
          count_of(goal.opening, plan_.open_width, plan_.closed_width, plan_.open_count, plan_.closed_count),
      .speed = count_of(goal.speed.value_or(plan_.speed), plan_.slowest, plan_.fastest, 0, 255),
      .force = count_of(goal.force.value_or(plan_.force), plan_.weakest, plan_.strongest, 0, 255)};
  // Commanded in every cycle, it is one way with one time-out.
  if (phase_ == Phase::going && next == before) return;
  tell(next);
  phase_ = Phase::going;
  began_ = now_;
  moved_ = false;
  stands_since_ = now_;
  object_ = GripperObject::unknown;
  latched_ = {};
  renew_trouble();
  renew_state();
}

void Control::halt() noexcept {
  if (!told_) return;
  switch (phase_) {
    case Phase::resetting:
    case Phase::activating:
      tell({});
      phase_ = Phase::idle;
      break;
    case Phase::going: {
      Action stopped = *action_;
      stopped.go = false;
      tell(stopped);
      phase_ = Phase::halting;
      began_ = now_;
      object_ = GripperObject::unknown;
      break;
    }
    case Phase::idle:
      // Led by somebody before, and still on its way.
      if (action_ || !told_->is_active() || !told_->go || told_->found != Found::moving) return;
      tell({.activate = true, .position = told_->requested});
      phase_ = Phase::halting;
      began_ = now_;
      break;
    case Phase::halting:
      return;
  }
  renew_state();
}

void Control::renew_trouble() noexcept {
  if (!silence_.is_ok()) {
    trouble_ = silence_;
    return;
  }
  const char* fault = told_ ? describe_fault(told_->fault) : "";
  const bool activates = phase_ == Phase::resetting || phase_ == Phase::activating;
  if (fault[0] != '\0' && !activates) {
    trouble_ = Status::error(StatusCode::device_fault, "the gripper reports fault 0x%02X: %s",
                             unsigned{told_->fault}, fault);
  } else {
    trouble_ = latched_;
  }
}

void Control::renew_state() noexcept {
  state_.reset();
  if (!told_) return;
  GripperState& state = state_.emplace();
  state.activated = is_active();
  state.moving =
      phase_ != Phase::idle || (!action_ && told_->is_active() && told_->go && told_->found == Found::moving);
  state.object = object_;
  if (told_->is_active()) {
    const double counts = plan_.closed_count - plan_.open_count;
    const double share = (told_->position - plan_.open_count) / counts;
    state.opening = plan_.open_width + share * (plan_.closed_width - plan_.open_width);
  }
}

}  // namespace flexrf::robotiq
