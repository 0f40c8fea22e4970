#include "hal/canopen/servo_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexrf::canopen::cia402 {
namespace {

constexpr std::uint32_t milliseconds_exponent = 0xFD;  // ten to the power of -3, as i8
constexpr double largest_increments = std::numeric_limits<std::int32_t>::max();

std::uint64_t to_object(double increments) {
  return static_cast<std::uint64_t>(
      std::llround(std::clamp(increments, -largest_increments, largest_increments)));
}

}  // namespace

Status ServoAxis::begin(const AxisPlan& plan, Time now, Outbox& outbox) noexcept {
  if (const Status status = check(plan); !status.is_ok()) return status;
  plan_ = plan;
  power_.begin(plan.limits);
  cyclic_ = CyclicSetPoint{plan.fastest};
  beat_.begin(plan.heartbeat_period, now);
  state_.reset();
  fault_ = {};
  mode_wanted_.reset();
  statusword_ = 0;
  mode_shown_ = Mode::none;
  was_operational_ = false;
  bring_ups_ = node_.times_operational();
  velocity_ = 0;
  last_set_point_ = 0;
  return node_.begin(node_plan(), now, outbox);
}

void ServoAxis::end(Outbox& outbox) noexcept {
  node_.end(outbox);
  state_.reset();
}

Status ServoAxis::check(const AxisPlan& plan) const noexcept {
  const auto wrong = [&plan](const char* what) {
    return Status::error(StatusCode::invalid_argument, "the axis with node %u: %s", unsigned{plan.node},
                         what);
  };
  if (plan.mode != Mode::cyclic_position && plan.mode != Mode::cyclic_velocity) {
    return wrong("its mode is neither cyclic position nor cyclic velocity");
  }
  if (plan.period < std::chrono::milliseconds(1) || plan.period > std::chrono::milliseconds(255) ||
      plan.period % std::chrono::milliseconds(1) != Duration{}) {
    return wrong("its period is not a whole number of ms from 1 to 255, as the drive counts it");
  }
  if (!std::isfinite(plan.increments_per_unit) || plan.increments_per_unit == 0) {
    return wrong("its increments per unit are 0 or not finite");
  }
  if (!(plan.lowest < plan.highest)) return wrong("its lowest position is not below its highest");
  if (!(plan.fastest > 0) || !std::isfinite(plan.fastest))
    return wrong("its greatest velocity is not above 0");
  const double farthest = std::max(std::abs(plan.lowest), std::abs(plan.highest));
  if (!(farthest * std::abs(plan.increments_per_unit) <= largest_increments)) {
    return wrong("its range has more increments than the drive can count");
  }
  return {};
}

NodePlan ServoAxis::node_plan() noexcept {
  commands_ = {.direction = PdoDirection::received_by_node,
               .identifier = receive_pdo_identifier(1, plan_.node)};
  commands_.add(objects::controlword, 16);
  commands_.add(plan_.mode == Mode::cyclic_position ? objects::target_position : objects::target_velocity,
                32);
  commands_.add(objects::mode, 8);
  states_ = {.direction = PdoDirection::sent_by_node, .identifier = transmit_pdo_identifier(1, plan_.node)};
  states_.add(objects::statusword, 16);
  states_.add(objects::actual_position, 32);
  states_.add(objects::mode_display, 8);
  motion_ = {.direction = PdoDirection::sent_by_node,
             .number = 2,
             .identifier = transmit_pdo_identifier(2, plan_.node)};
  motion_.add(objects::actual_velocity, 32);

  NodePlan node{.node = plan_.node,
                .master = plan_.master,
                .boot_timeout = plan_.boot_timeout,
                .sdo_timeout = plan_.sdo_timeout,
                .heartbeat_period = plan_.heartbeat_period,
                .heartbeat_limit = plan_.heartbeat_limit,
                .master_heartbeat_limit = plan_.heartbeat_limit};
  Configuration& list = node.configuration;
  list.expect(canopen::objects::device_type, profile_number, 0xFFFF, "device profile");
  if (plan_.vendor != 0) list.expect(canopen::objects::vendor, plan_.vendor, 0xFFFFFFFF, "vendor");
  if (plan_.product != 0) list.expect(canopen::objects::product, plan_.product, 0xFFFFFFFF, "product");
  list.write(objects::abort_connection, 2, static_cast<std::uint16_t>(plan_.abort_connection));
  list.write(objects::period_value, 1,
             static_cast<std::uint32_t>(plan_.period / std::chrono::milliseconds(1)));
  list.write(objects::period_exponent, 1, milliseconds_exponent);
  for (const PdoPlan& pdo : {commands_, states_, motion_}) list.configure_pdo(pdo);
  return node;
}

void ServoAxis::receive(const Message& message, Time now, Outbox& outbox) noexcept {
  node_.receive(message, now, outbox);
  if (!node_.is_operational()) return;
  std::uint64_t values[3] = {};
  if (unpack(states_, message, values)) {
    if (!state_) state_.emplace();
    statusword_ = static_cast<std::uint16_t>(values[0]);
    state_->position = static_cast<double>(with_sign(values[1], 32)) / plan_.increments_per_unit;
    state_->at_internal_limit = (statusword_ & status_bit::internal_limit) != 0;
    mode_shown_ = static_cast<Mode>(with_sign(values[2], 8));
    heard_ = now;
  } else if (state_ && unpack(motion_, message, values)) {
    state_->velocity = static_cast<double>(with_sign(values[0], 32)) / plan_.increments_per_unit;
  }
}

void ServoAxis::send(bool may_move, Time now, Duration elapsed, Outbox& outbox) noexcept {
  node_.advance(now, outbox);
  watch(now);
  outbox.push({sync_identifier, 0, {}});
  if (beat_.is_due(now)) outbox.push(heartbeat_message(NmtState::operational, plan_.master));
  if (!node_.is_operational()) return;
  if (!state_) {
    // It is not heard, and may well hear us.
    const std::uint64_t values[] = {command::quick_stop, last_set_point_,
                                    static_cast<std::uint64_t>(plan_.mode)};
    if (!fault_.is_ok()) outbox.push(pack(commands_, values));
    return;
  }
  const bool wanted = may_move && fault_.is_ok();
  const bool enables = mode_is_taken(wanted, now) && wanted && fault_.is_ok();
  power_.pursue(enables ? DrivePower::Goal::enabled : DrivePower::Goal::off);
  const bool at_rest = std::abs(state_->velocity) <= plan_.rest_velocity;
  const std::uint16_t word = power_.advance(statusword_, at_rest, now);
  if (!power_.problem().is_ok()) fail(power_.problem());
  if (power_.was_just_enabled() || !power_.is_enabled()) {
    cyclic_.seed(state_->position);
    velocity_ = 0;
  }
  state_->enabled = power_.is_enabled();
  last_set_point_ = to_object(set_point_for(elapsed) * plan_.increments_per_unit);
  const std::uint64_t values[] = {word, last_set_point_, static_cast<std::uint64_t>(plan_.mode)};
  outbox.push(pack(commands_, values));
}

void ServoAxis::command_position(double position) noexcept {
  if (!power_.is_enabled() || plan_.mode != Mode::cyclic_position) return;
  if (!std::isfinite(position)) {
    fail(Status::error(StatusCode::invalid_argument, "it was commanded to a position that is not a number"));
    return;
  }
  cyclic_.command(std::clamp(position, plan_.lowest, plan_.highest));
}

void ServoAxis::command_velocity(double velocity) noexcept {
  if (!power_.is_enabled() || plan_.mode != Mode::cyclic_velocity) return;
  if (!std::isfinite(velocity)) {
    fail(Status::error(StatusCode::invalid_argument, "it was commanded to a velocity that is not a number"));
    return;
  }
  velocity_ = std::clamp(velocity, -plan_.fastest, plan_.fastest);
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

void ServoAxis::watch(Time now) noexcept {
  const bool operational = node_.is_operational();
  const bool is_new = node_.times_operational() != bring_ups_;
  if (was_operational_ && (!operational || is_new)) {
    if (power_.goal() == DrivePower::Goal::enabled && fault_.is_ok()) {
      fault_ = node_.problem().is_ok() ? Status::error(StatusCode::unavailable,
                                                       "node %u was gone and came back", unsigned{plan_.node})
                                       : node_.problem();
    }
    power_.begin(plan_.limits);
    state_.reset();
  }
  if (node_.state() == NodeState::refused && fault_.is_ok()) fault_ = node_.problem();
  if (is_new) heard_ = now;
  bring_ups_ = node_.times_operational();
  was_operational_ = operational;
  if (operational && now - heard_ > silent_cycles * plan_.period) {
    state_.reset();
    fail(Status::error(StatusCode::unavailable, "no process data for %d cycles: does it get SYNC?",
                       silent_cycles));
  }
}

// A drive may take its time to change its mode, and is enabled only then.
bool ServoAxis::mode_is_taken(bool wanted, Time now) noexcept {
  if (mode_shown_ == plan_.mode || !wanted) {
    mode_wanted_.reset();
    return true;
  }
  if (!mode_wanted_) mode_wanted_ = now;
  if (now - *mode_wanted_ > plan_.mode_timeout) {
    fail(Status::error(StatusCode::timeout, "the drive does not take mode %d, it shows %d: does it have it?",
                       static_cast<int>(plan_.mode), static_cast<int>(mode_shown_)));
  }
  return false;
}

double ServoAxis::set_point_for(Duration elapsed) noexcept {
  if (plan_.mode == Mode::cyclic_position) {
    const double set_point = power_.is_enabled() ? cyclic_.next(elapsed) : state_->position;
    state_->following_error = set_point - state_->position;
    return set_point;
  }
  if (!power_.is_enabled()) return 0;
  const bool would_leave = (velocity_ > 0 && state_->position >= plan_.highest) ||
                           (velocity_ < 0 && state_->position <= plan_.lowest);
  return would_leave ? 0 : velocity_;
}

}  // namespace flexrf::canopen::cia402
