#include "hal/canopen/servo_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/servo_drive/interface/range_end.hpp"
#include "hal/servo_drive/interface/servo_restraints.hpp"

namespace flexrf::canopen::cia402 {
namespace {

constexpr double largest_object = std::numeric_limits<std::int32_t>::max();
// From what a drive says to what it does for that are two or three cycles.
constexpr double cycles_ahead = 8;     // see slowed_before_end()
constexpr double whole_torque = 1000;  // how objects count the rated torque
constexpr double no_end = std::numeric_limits<double>::infinity();

std::uint64_t to_object(double increments) {
  return static_cast<std::uint64_t>(std::llround(std::clamp(increments, -largest_object, largest_object)));
}

// As a counter of 32 bits holds it that runs over.
std::int32_t wrapped(std::int64_t increments) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(increments));
}

}  // namespace

Status ServoAxis::begin(const AxisPlan& plan, Time now, Outbox& outbox) noexcept {
  if (const Status status = check(plan); !status.is_ok()) return status;
  plan_ = plan;
  power_.begin(plan.limits);
  cyclic_ = SetPointFollower{{.lowest = plan.endless ? -no_end : plan.lowest,
                              .highest = plan.endless ? no_end : plan.highest,
                              .velocity = plan.fastest,
                              .acceleration = plan.acceleration}};
  handshake_ = SetPointHandshake{plan.set_point_timeout, plan.fastest, plan.changes_target_at_once};
  interpolation_ = InterpolationSwitch{plan.set_point_timeout};
  homing_.begin({.run = plan.homing_timeout,
                 .settle = plan.homing_settle,
                 .tells_reached = plan.homing_tells_reached,
                 .mode = plan.mode_timeout,
                 .stop = plan.limits.stop},
                plan.mode, plan.homing_method != 0);
  beat_.begin(plan.heartbeat_period, now);
  unmapped_.forget();
  sdo_stop_.forget();
  state_.reset();
  fault_ = {};
  mode_wanted_.reset();
  statusword_ = 0;
  mode_shown_ = Mode::none;
  mode_said_ = plan.mode;
  was_operational_ = false;
  bring_ups_ = node_.times_operational();
  was_commanded_ = halts_ = is_off_for_mode_ = drops_target_ = false;
  may_have_torque_ = false;
  off_heard_ = stood_ = 0;
  velocity_heard_ = Time{};
  position_velocity_ = 0;
  velocity_ = asked_velocity_ = 0;
  ignored_ = 0;
  most_torque_ = 1;
  target_object_ = 0;
  counted_.reset();
  from_positions_.forget();
  restraint_ = held_ = {};
  return node_.begin(node_plan(), now, outbox);
}

void ServoAxis::end(Outbox& outbox) noexcept {
  node_.end(outbox);
  state_.reset();
}

void ServoAxis::receive(const Message& message, Time now, Outbox& outbox) noexcept {
  // Process data first, as they come in every cycle; a drive that lost only its heartbeat goes on sending
  // them.
  if ((node_.is_operational() || node_.was_lost()) && take_process_data(message, now)) return;
  node_.receive(message, now, outbox);
}

// True: it is process data. What is truncated says nothing.
bool ServoAxis::take_process_data(const Message& message, Time now) noexcept {
  std::uint64_t values[3] = {};
  if (message.identifier == motion_.identifier) {
    if (!state_ || !unpack(motion_, message, values)) return true;
    take_motion(values, now);
    return true;
  }
  if (message.identifier != states_.identifier) return false;
  if (!unpack(states_, message, values)) return true;
  statusword_ = static_cast<std::uint16_t>(values[0]);
  note_torque();
  if (!node_.is_operational()) return true;
  if (!state_) state_.emplace();
  state_->position = position_of(static_cast<std::int32_t>(with_sign(values[1], 32)));
  position_velocity_ = from_positions_.take(way_, now);
  if (!hears_of_velocity(now)) state_->velocity = position_velocity_;
  state_->at_internal_limit = (statusword_ & status_bit::internal_limit) != 0;
  stood_ = handshake_.is_reached(statusword_) && is_at_rest(now) ? std::min(stood_ + 1, standing_cycles) : 0;
  state_->target_reached = has_reached(statusword_);
  if (plan_.maps_mode) mode_shown_ = static_cast<Mode>(with_sign(values[2], 8));
  heard_ = now;
  heard_now_ = true;
  return true;
}

void ServoAxis::take_motion(const std::uint64_t* values, Time now) noexcept {
  for (std::size_t i = 0; i < motion_.count; ++i) {
    if (motion_.entries[i].object == objects::actual_velocity) {
      velocity_heard_ = now;
      state_->velocity = static_cast<double>(with_sign(values[i], 32)) / to_velocity_object(1);
    } else {
      state_->torque = static_cast<double>(with_sign(values[i], 16)) / whole_torque;
    }
  }
}

// Called with each statusword: after some without torque, one after the other, the drive is off, unless it is
// being enabled.
void ServoAxis::note_torque() noexcept {
  const bool is_led = node_.is_operational() && power_.goal() == DrivePower::Goal::enabled;
  off_heard_ = is_led || has_torque(state_of(statusword_)) ? 0 : std::min(off_heard_ + 1, off_cycles);
  if (has_torque(state_of(statusword_))) may_have_torque_ = true;
  if (off_heard_ == off_cycles) may_have_torque_ = false;
}

bool ServoAxis::hears_of_velocity(Time now) const noexcept {
  return plan_.maps_velocity && velocity_heard_ != Time{} &&
         now - velocity_heard_ <= silent_cycles * plan_.period;
}

// By two sources, because either may be frozen: the velocity that the drive sends, and the change of its
// positions.
bool ServoAxis::is_at_rest(Time now) const noexcept {
  constexpr double clearly = 10;
  const double by_positions = std::abs(position_velocity_);
  const double doubt = from_positions_.doubt(2 / std::abs(plan_.increments_per_unit));
  if (hears_of_velocity(now))
    return std::abs(state_->velocity) <= plan_.rest_velocity &&
           by_positions <= std::max(clearly * plan_.rest_velocity, 2 * doubt);
  return from_positions_.is_known() && by_positions <= std::max(plan_.rest_velocity, doubt);
}

/// The drive's counter runs over after 2^32 increments; an endless axis goes on.
double ServoAxis::position_of(std::int32_t increments) noexcept {
  const std::int32_t before = counted_.value_or(increments);
  const bool goes_on = plan_.endless && counted_;
  count_ = goes_on ? count_ + wrapped(std::int64_t{increments} - before) : increments;
  counted_ = increments;
  way_ = static_cast<double>(count_) / plan_.increments_per_unit;
  return told(way_);
}

double ServoAxis::told(double way) const noexcept {
  if (plan_.modulo == 0) return way;
  const double within_it = way - plan_.modulo * std::floor(way / plan_.modulo);
  return within_it < plan_.modulo ? within_it : 0;  // a hair below 0 is rounded up to it
}

void ServoAxis::send(bool may_move, Time now, Duration elapsed, Outbox& outbox) noexcept {
  node_.advance(now, outbox);
  watch(may_move, now);
  outbox.push({sync_identifier, 0, {}});
  if (beat_.is_due(now)) outbox.push(heartbeat_message(NmtState::operational, plan_.master));
  if (!node_.is_operational()) {
    if (may_have_torque_ && node_.was_lost()) stop_unheard(now, outbox);
    return;
  }
  if (!state_) {
    if (may_have_torque_ || !fault_.is_ok()) stop_unheard(now, outbox);
    return;
  }
  sdo_stop_.forget();
  if (is_told_by_sdo()) settle_unmapped(now, outbox);
  const bool wanted = may_move && fault_.is_ok();
  if (!plan_.changes_mode_enabled && mode_shown_ != homing_.mode()) is_off_for_mode_ = true;
  if (!wanted || !homing_.is_running()) is_off_for_mode_ = false;
  const bool at_rest = is_at_rest(now);
  if (!wanted || power_.is_off()) drops_target_ = false;
  const bool drops = drops_target_ && !homing_.is_running() && (at_rest || !power_.is_enabled());
  const bool enables = mode_is_taken(wanted, now) && wanted && fault_.is_ok() && !drops;
  power_.pursue(enables ? DrivePower::Goal::enabled : DrivePower::Goal::off);
  if (enables) {
    may_have_torque_ = true;
    off_heard_ = 0;  // what the drive said so far is from before
  }
  std::uint16_t word = power_.advance(statusword_, at_rest, now);
  if (!power_.problem().is_ok()) fail(power_.problem());
  if (enables && power_.is_enabled()) is_off_for_mode_ = false;
  if (!power_.is_enabled() && !is_off_for_mode_) homing_.interrupt();
  const bool homes = homing_.is_running() && !homing_.is_resting();
  if (!power_.is_enabled()) interpolation_.reset();
  if (homes) interpolation_.lower();
  const bool ignores = plan_.mode == Mode::interpolated_position && !interpolation_.is_active();
  if (power_.was_just_enabled() || !power_.is_enabled() || homes || ignores) seed();
  if (power_.is_enabled()) word |= mode_bits(at_rest, now);
  state_->enabled = is_enabled();
  // Where it stops by itself, it stops in the mode that it moves in.
  if ((power_.is_enabled() && plan_.changes_mode_enabled) || power_.is_off()) mode_said_ = homing_.mode();
  const double target = target_for(elapsed);
  target_object_ = plan_.endless && !is_led_in(Mode::cyclic_velocity, Mode::profile_velocity)
                       ? static_cast<std::uint32_t>(wrapped(std::llround(target)))
                       : to_object(target);
  watch_following();
  heard_now_ = false;
  tell_restraint();
  say(word, outbox);
}

// A drive that we do not hear may still hear us; and one whose process data do not come may answer an SDO.
void ServoAxis::stop_unheard(Time now, Outbox& outbox) noexcept {
  power_.pursue(DrivePower::Goal::off);
  say(command::quick_stop, outbox);
  if (!may_have_torque_) return;
  unmapped_.forget();  // there is one client, and what it is asked now is something else
  const auto answer = sdo_stop_.advance(plan_.limits.stop, node_.client(), now, outbox);
  if (!answer) return;
  statusword_ = *answer;
  note_torque();
}

// In the cyclic modes bit 12 says whether set-points are followed or ignored. One that is ignored is no error
// of the drive, which stays enabled: it may be about something of its own, and drives older than these modes
// leave the bit 0 for ever. So it is told, and an axis that then falls behind is in fault for that.
// Interpolated position knows more, see InterpolationSwitch.
void ServoAxis::watch_following() noexcept {
  const bool is_led = is_led_in(Mode::cyclic_position, Mode::cyclic_velocity) && power_.is_enabled() &&
                      !homing_.is_running() && mode_shown_ == plan_.mode;
  if (!is_led || (heard_now_ && (statusword_ & status_bit::follows) != 0)) {
    ignored_ = 0;
  } else if (heard_now_) {
    ignored_ = std::min(ignored_ + 1, ignoring_cycles);
  }
}

// What was said in this cycle goes before what stands since the command, and that before its consequence.
void ServoAxis::tell_restraint() noexcept {
  const bool is_of_speed =
      held_.reason == servo_restraints::too_fast || held_.reason == servo_restraints::own_speed;
  if (plan_.mode == Mode::profile_position && is_of_speed && state_->target_reached) held_ = {};
  if (restraint_.reason != nullptr || !power_.is_enabled()) return;
  restraint_ = held_;
  if (handshake_.is_kept_waiting()) restraint_ = {.reason = servo_restraints::target_waits};
  if (ignored_ == ignoring_cycles) restraint_ = {.reason = servo_restraints::set_points_ignored};
  const bool is_led = is_led_in(Mode::cyclic_position, Mode::interpolated_position);
  if (restraint_.reason == nullptr && is_led && is_outpaced())
    restraint_ = {servo_restraints::led_too_fast, told(cyclic_.wanted()), told(cyclic_.set_point())};
}

// By more than another cycle makes up for. What a cycle that came early or late makes of a motion at its
// greatest velocity is less.
bool ServoAxis::is_outpaced() const noexcept {
  return std::abs(cyclic_.wanted() - cyclic_.set_point()) > plan_.fastest * seconds(plan_.period);
}

// The first cause counts: what follows from it says less.
void ServoAxis::fail(const Status& cause) noexcept {
  if (!fault_.is_ok()) return;
  const auto& emergency = node_.emergency();
  fault_ = emergency
               ? Status::error(cause.code(), "node %u: %s; it says: %s (%04X)", unsigned{plan_.node},
                               cause.cause(), describe_error_code(emergency->code), unsigned{emergency->code})
               : Status::error(cause.code(), "node %u: %s", unsigned{plan_.node}, cause.cause());
}

void ServoAxis::watch(bool may_move, Time now) noexcept {
  const bool operational = node_.is_operational();
  const bool is_new = node_.times_operational() != bring_ups_;
  if (was_operational_ && (!operational || is_new)) {
    const bool was_led = power_.goal() == DrivePower::Goal::enabled || is_off_for_mode_ || drops_target_;
    if (was_led && fault_.is_ok()) {
      fault_ = node_.problem().is_ok() ? Status::error(StatusCode::unavailable,
                                                       "node %u was gone and came back", unsigned{plan_.node})
                                       : node_.problem();
    }
    power_.begin(plan_.limits);
    homing_.forget();
    unmapped_.forget();
    sdo_stop_.forget();
    from_positions_.forget();
    state_.reset();
  }
  if (node_.state() == NodeState::refused && fault_.is_ok()) fault_ = node_.problem();
  if (is_new) heard_ = now;
  bring_ups_ = node_.times_operational();
  was_operational_ = operational;
  if (operational && now - heard_ > silent_cycles * plan_.period) {
    state_.reset();
    // One that is off and shall be so may go and come.
    if (!may_move && power_.goal() == DrivePower::Goal::off) return;
    fail(Status::error(StatusCode::unavailable,
                       "no process data for %d cycles: is the cable in, is it powered, does it get SYNC?",
                       silent_cycles));
  }
}

bool ServoAxis::is_told_by_sdo() const noexcept {
  return !plan_.maps_mode || (plan_.mode == Mode::profile_position && plan_.tells_speed && !plan_.maps_speed);
}

// What it refuses on the way to a homing ends the homing alone, in its time.
void ServoAxis::settle_unmapped(Time now, Outbox& outbox) noexcept {
  UnmappedObjects::Wanted wanted;
  if (!plan_.maps_mode) wanted.mode = mode_said_;
  if (plan_.mode == Mode::profile_position && plan_.tells_speed && !plan_.maps_speed)
    wanted.speed = speed_object();
  const Status refusal = unmapped_.advance(wanted, node_, now, outbox);
  if (!refusal.is_ok() && mode_said_ == plan_.mode) fail(refusal);
  if (!plan_.maps_mode) mode_shown_ = unmapped_.shown_mode();
}

// A drive may take its time to change its mode, and is enabled only then.
bool ServoAxis::mode_is_taken(bool wanted, Time now) noexcept {
  const Mode needed = homing_.mode();
  const bool may_wait = homing_.is_running() && !is_off_for_mode_;
  if (mode_shown_ == needed || !wanted || may_wait) {
    mode_wanted_.reset();
    return true;
  }
  if (is_off_for_mode_ && !power_.is_off()) return false;
  if (!mode_wanted_) mode_wanted_ = now;
  if (now - *mode_wanted_ <= plan_.mode_timeout) return false;
  if (needed == Mode::homing) {
    homing_.refuse_mode();
  } else {
    fail(Status::error(
        StatusCode::timeout, "the drive does not take mode %d, it shows %d: does it have it%s?",
        static_cast<int>(plan_.mode), static_cast<int>(mode_shown_),
        plan_.mode == Mode::cyclic_position ? ", or is it one with `interpolates = true`" : ""));
  }
  return false;
}

// Nothing is wanted but to stay where it is.
void ServoAxis::seed() noexcept {
  cyclic_.seed(way_);
  handshake_.reset(wrapped(count_));
  velocity_ = 0;
  was_commanded_ = halts_ = false;
  held_ = {};
}

std::uint16_t ServoAxis::mode_bits(bool at_rest, Time now) noexcept {
  if (homing_.is_running()) {
    const bool knew_home = homing_.knows_home();
    const std::uint16_t bits = homing_.advance(
        {.statusword = statusword_, .is_new = heard_now_, .shown = mode_shown_, .at_rest = at_rest}, now);
    // From here on it counts anew, while it is still on its way back into its mode and seeded.
    if (homing_.knows_home() && !knew_home) {
      counted_.reset();
      from_positions_.forget();
    }
    if (!homing_.trouble().is_ok()) fail(homing_.trouble());
    if (!homing_.is_resting()) return bits;
  }
  if (plan_.mode == Mode::interpolated_position) {
    const std::uint16_t bits = interpolation_.advance(statusword_, now);
    if (!interpolation_.problem().is_ok()) fail(interpolation_.problem());
    return bits;
  }
  if (plan_.mode != Mode::profile_position) return 0;
  const bool is_told = !plan_.tells_speed || plan_.maps_speed || unmapped_.has_speed(speed_object());
  std::uint16_t bits = handshake_.advance(statusword_, now, is_told);
  if (!handshake_.problem().is_ok()) fail(handshake_.problem());
  // It would go on to where it was halted on its way to, before it is told where to go now.
  if ((bits & control_bit::new_set_point) != 0) halts_ = false;
  if (halts_) bits |= control_bit::halt;
  return bits;
}

// For object 607A, 60C1 or 60FF.
double ServoAxis::target_for(Duration elapsed) noexcept {
  switch (plan_.mode) {
    case Mode::profile_position:
      state_->following_error = 0;
      return handshake_.target();
    case Mode::cyclic_velocity:
    case Mode::profile_velocity:
      asked_velocity_ = power_.is_enabled() ? velocity_for(elapsed) : 0;
      return to_velocity_object(asked_velocity_);
    default:
      break;
  }
  const double set_point = power_.is_enabled() ? cyclic_.next(seconds(elapsed)) : way_;
  state_->following_error = set_point - way_;
  return set_point * plan_.increments_per_unit;
}

double ServoAxis::velocity_for(Duration elapsed) noexcept {
  if (halts_) {
    const double step = plan_.acceleration * seconds(elapsed);
    velocity_ -= std::clamp(velocity_, -step, step);
  }
  cycles_ = std::min(cycles_ + 1, settle_cycles);
  const double permitted = permitted_velocity();
  if (permitted != velocity_) restraint_ = {servo_restraints::end_of_range, velocity_, permitted};
  return permitted;
}

double ServoAxis::permitted_velocity() const noexcept {
  if (plan_.endless || velocity_ == 0) return velocity_;
  const bool rises = velocity_ > 0;
  const double left = rises ? plan_.highest - state_->position : state_->position - plan_.lowest;
  return slowed_before_end(velocity_, left, cycles_ahead * seconds(plan_.period), plan_.acceleration);
}

double ServoAxis::beside_target() const noexcept {
  const std::int64_t beside = count_ - handshake_.target();
  return static_cast<double>(plan_.endless ? wrapped(beside) : beside) / plan_.increments_per_unit;
}

double ServoAxis::own_window() const noexcept {
  constexpr std::uint32_t no_window = 0xFFFFFFFF;  // the drive does not compare (CiA 402, object 6067)
  const std::uint32_t window = node_.answered(objects::position_window).value_or(no_window);
  return window == no_window ? 0 : window / std::abs(plan_.increments_per_unit);
}

/// What the statusword says about an axis that comes no nearer to its target; empty: nothing.
const char* ServoAxis::why_target_is_not_reached() const noexcept {
  if ((statusword_ & status_bit::remote) == 0)
    return "the drive says that it does not obey the bus (statusword, bit 9 is 0): is its maker's tool "
           "connected?";
  if ((statusword_ & status_bit::internal_limit) != 0)
    return "the drive says that a limit of its own holds it (statusword, bit 11): a limit switch, or objects "
           "607D and 607F?";
  if ((statusword_ & status_bit::following_error) != 0)
    return "the drive says that it cannot follow (statusword, bit 13): is its load too great, or does it "
           "stick?";
  if ((statusword_ & status_bit::target_reached) != 0)
    return "the drive says that it is there (statusword, bit 10), beyond its own window (object 6067): do "
           "`increments_per_unit` and its own units agree?";
  return "";
}

std::optional<ProfileTarget> ServoAxis::profile_target() const noexcept {
  const bool is_on_its_way = plan_.mode == Mode::profile_position && power_.is_enabled() && was_commanded_ &&
                             !halts_ && !homing_.is_running() && handshake_.is_taken();
  if (!is_on_its_way || !state_ || state_->target_reached) return std::nullopt;
  // A drive that is told no speed has one of its own, that is taken for no less than this.
  const double speed = plan_.tells_speed ? handshake_.speed() : plan_.fastest / 10;
  return ProfileTarget{.position = handshake_.target() / plan_.increments_per_unit,
                       .left = -beside_target(),
                       .speed = speed,
                       .says = why_target_is_not_reached()};
}

bool ServoAxis::has_reached(std::uint16_t statusword) const noexcept {
  if (!power_.is_enabled() || !was_commanded_ || halts_) return false;
  if (plan_.mode == Mode::profile_position) {
    // What the drive says may be about another target: it is there only if it is there.
    const double beside = std::abs(beside_target());
    return handshake_.is_reached(statusword) && (beside <= plan_.fastest * seconds(plan_.period) ||
                                                 (stood_ == standing_cycles && beside <= own_window()));
  }
  if (plan_.mode != Mode::profile_velocity || permitted_velocity() != velocity_) return false;
  return cycles_ == settle_cycles && (statusword & status_bit::target_reached) != 0;
}

std::optional<Message> ServoAxis::last_word() const noexcept {
  if (!state_ || plan_.abort_connection == 0) return std::nullopt;
  // No controlword asks for a fault: where 6007 does, it comes with the lost heartbeat.
  constexpr std::int16_t goes_off = 2;
  return process_data(plan_.abort_connection == goes_off ? command::disable_voltage : command::quick_stop);
}

Message ServoAxis::process_data(std::uint16_t word) const noexcept {
  const std::uint64_t values[] = {word, target_object_, static_cast<std::uint8_t>(mode_said_)};
  return pack(commands_, values);
}

void ServoAxis::say(std::uint16_t word, Outbox& outbox) const noexcept {
  outbox.push(process_data(word));
  if (profile_.count == 0) return;
  const double torque = std::clamp(std::round(most_torque_ * whole_torque), 0.0, 65535.0);
  std::uint64_t profile[PdoPlan::most_entries] = {};
  for (std::size_t i = 0; i < profile_.count; ++i) {
    const bool is_speed = profile_.entries[i].object == objects::profile_velocity;
    profile[i] = is_speed ? speed_object() : static_cast<std::uint64_t>(torque);
  }
  outbox.push(pack(profile_, profile));
}

}  // namespace flexrf::canopen::cia402
