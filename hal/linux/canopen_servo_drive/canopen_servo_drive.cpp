#include "hal/linux/canopen_servo_drive/canopen_servo_drive.hpp"

#include <cmath>

namespace flexrf {
namespace {

// What is not asked for and answered, but said in every cycle: only the newest counts.
bool is_cyclic(const canopen::Message& message) {
  const auto base = static_cast<std::uint16_t>(message.identifier & 0x780);
  return message.identifier == canopen::sync_identifier || base == canopen::heartbeat_base || base == 0x200;
}

CanFrame to_frame(const canopen::Message& message) {
  CanFrame frame;
  frame.identifier = message.identifier;
  frame.length = message.size;
  frame.data = message.data;
  return frame;
}

Duration whole_milliseconds(double time) {
  return std::chrono::milliseconds(std::llround(time * 1e3));
}

}  // namespace

canopen::cia402::AxisPlan CanopenServoDrive::plan_from_configuration() const noexcept {
  canopen::cia402::AxisPlan plan;
  plan.node = configuration.node;
  plan.master = configuration.master;
  plan.vendor = configuration.vendor;
  plan.product = configuration.product;
  plan.mode = configuration.takes_velocities ? canopen::cia402::Mode::cyclic_velocity
                                             : canopen::cia402::Mode::cyclic_position;
  plan.period = whole_milliseconds(configuration.period);
  plan.increments_per_unit = configuration.increments_per_unit;
  plan.lowest = configuration.lowest;
  plan.highest = configuration.highest;
  plan.fastest = configuration.fastest;
  plan.rest_velocity = configuration.rest_velocity;
  plan.abort_connection = configuration.abort_connection;
  plan.boot_timeout = whole_milliseconds(configuration.boot_timeout);
  plan.sdo_timeout = whole_milliseconds(configuration.sdo_timeout);
  plan.heartbeat_period = whole_milliseconds(configuration.heartbeat_period);
  plan.heartbeat_limit = whole_milliseconds(configuration.heartbeat_limit);
  plan.limits.hop = whole_milliseconds(configuration.hop_timeout);
  plan.limits.enable = whole_milliseconds(configuration.enable_timeout);
  plan.limits.stop = whole_milliseconds(configuration.stop_timeout);
  plan.limits.fault_resets = configuration.fault_resets;
  return plan;
}

Status CanopenServoDrive::initialise() {
  plan_ = plan_from_configuration();
  outbox_.clear();
  began_ = made_safe_ = false;
  last_sent_ = Time{};
  // Tried here, for its errors; begun in the first cycle, whose time counts.
  if (const Status status = axis_.begin(plan_, Time{}, outbox_); !status.is_ok()) return status;
  outbox_.clear();
  const std::uint8_t node = plan_.node;
  const CanIdentifier heard[] = {
      {canopen::identifier_of(canopen::emergency_base, node)},
      {canopen::transmit_pdo_identifier(1, node)},
      {canopen::transmit_pdo_identifier(2, node)},
      {canopen::identifier_of(canopen::sdo_answer_base, node)},
      {canopen::identifier_of(canopen::heartbeat_base, node)},
  };
  return bus->open(inbox_, heard, 64);
}

void CanopenServoDrive::stop() {
  // No message: the thread that could send it no longer steps. Without our heartbeat the drive stays off.
  bus->close(inbox_);
}

void CanopenServoDrive::receive(const Tick& tick) noexcept {
  if (!began_) {
    began_ = axis_.begin(plan_, tick.now, outbox_).is_ok();
    last_sent_ = tick.now;
  }
  while (const auto frame = inbox_.pop()) {
    if (frame->extended || frame->remote) continue;
    axis_.receive({static_cast<std::uint16_t>(frame->identifier), frame->length, frame->data}, tick.now,
                  outbox_);
  }
  const auto& state = axis_.state();
  feedback.enabled = state && state->enabled;
  if (!state) return;
  feedback.position = state->position;
  feedback.velocity = state->velocity;
  feedback.following_error = state->following_error;
  feedback.at_internal_limit = state->at_internal_limit;
}

void CanopenServoDrive::send(const Tick& tick) noexcept {
  if (is_inhibited()) made_safe_ = false;
  const bool may_move = !is_inhibited() && !made_safe_ && fault().is_ok();
  axis_.send(may_move, tick.now, tick.now - last_sent_, outbox_);
  last_sent_ = tick.now;
  if (!axis_.fault().is_ok()) fail(axis_.fault());
  for (; !outbox_.is_empty(); outbox_.pop()) {
    const canopen::Message& message = outbox_.front();
    // What the bus refuses is not kept: the protocol's own time-outs ask again, with what is true then.
    if (is_cyclic(message)) {
      bus->post(to_frame(message));
    } else {
      bus->queue(to_frame(message));
    }
  }
}

bool CanopenServoDrive::make_safe() noexcept {
  made_safe_ = true;
  return axis_.is_off();
}

std::optional<ServoState> CanopenServoDrive::state() const noexcept {
  const auto& state = axis_.state();
  if (!state) return std::nullopt;
  return ServoState{.position = state->position,
                    .velocity = state->velocity,
                    .following_error = state->following_error,
                    .enabled = state->enabled,
                    .at_internal_limit = state->at_internal_limit};
}

void CanopenServoDrive::command_position(double position) noexcept {
  if (!is_inhibited() && !made_safe_) axis_.command_position(position);
}

void CanopenServoDrive::command_velocity(double velocity) noexcept {
  if (!is_inhibited() && !made_safe_) axis_.command_velocity(velocity);
}

}  // namespace flexrf
