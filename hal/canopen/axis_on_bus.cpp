#include "hal/canopen/axis_on_bus.hpp"

#include "hal/canopen/can_message.hpp"
#include "runtime/log/log.hpp"

namespace flexrf::canopen {
namespace {

static_assert(cia402::ServoAxis::full_speed == ServoDrive::full_speed);

// What is not asked for and answered, but said in every cycle: only the newest counts.
bool is_cyclic(const Message& message) {
  const auto base = static_cast<std::uint16_t>(message.identifier & 0x780);
  return message.identifier == sync_identifier || base == heartbeat_base || base == 0x200 || base == 0x300;
}

}  // namespace

Status AxisOnBus::open(const cia402::AxisPlan& plan, CanBus& bus, const char* name) {
  plan_ = plan;
  bus_ = &bus;
  name_ = name;
  outbox_.clear();
  began_ = told_oddities_ = false;
  last_sent_ = Time{};
  // Tried here, for its errors; begun in the first cycle, whose time counts.
  if (const Status status = axis_.begin(plan_, Time{}, outbox_); !status.is_ok()) return status;
  outbox_.clear();
  if (const Status status = bus_->claim_node(plan_.node, name_); !status.is_ok()) return status;
  if (last_word_ < 0) last_word_ = bus_->claim_last_word();
  const std::uint8_t node = plan_.node;
  const CanIdentifier heard[] = {
      {identifier_of(emergency_base, node)}, {transmit_pdo_identifier(1, node)},
      {transmit_pdo_identifier(2, node)},    {identifier_of(sdo_answer_base, node)},
      {identifier_of(heartbeat_base, node)},
  };
  return bus_->open(inbox_, heard, 64);
}

void AxisOnBus::close() {
  // No message: the thread that could send it no longer steps. Without our heartbeat the drive stays off.
  if (bus_ == nullptr) return;
  bus_->close(inbox_);
  bus_->release_node(name_);
  bus_->release_last_word(last_word_);
  last_word_ = CanBus::no_last_word;
}

void AxisOnBus::receive(const Tick& tick) noexcept {
  if (!began_) {
    began_ = axis_.begin(plan_, tick.now, outbox_).is_ok();
    last_sent_ = tick.now;
  }
  while (const CanFrame* frame = inbox_.take()) {
    if (frame->extended || frame->remote) continue;
    const Message message = to_message(*frame);
    axis_.receive(message, tick.now, outbox_);
  }
}

void AxisOnBus::send(const Tick& tick, bool may_move) noexcept {
  axis_.send(may_move, tick.now, tick.now - last_sent_, outbox_);
  last_sent_ = tick.now;
  for (; !outbox_.is_empty(); outbox_.pop()) {
    const Message& message = outbox_.front();
    // What the bus refuses is not kept: the protocol's own time-outs ask again, with what is true then.
    if (is_cyclic(message)) {
      bus_->post(to_frame(message));
    } else {
      bus_->queue(to_frame(message));
    }
  }
  if (last_word_ < 0) return;
  if (const auto word = axis_.last_word()) {
    bus_->prepare_last_word(last_word_, to_frame(*word), to_frame({sync_identifier, 0, {}}));
  }
}

void AxisOnBus::tell_oddities(const char* name) noexcept {
  if (told_oddities_ || !axis_.node().is_operational()) return;
  told_oddities_ = true;
  if (axis_.quick_stop_coasts()) {
    log_warning(
        name,
        "node {} only switches its torque off at a quick stop (object 605A is 0), and the axis coasts: set "
        "`quick_stop_option`, or the object by its maker's tool",
        unsigned{plan_.node});
  }
  if (!axis_.has_own_ramps()) return;
  log_warning(
      name,
      "node {} takes no acceleration (it has no object 6083): its ramps are its own, and `acceleration` "
      "is to be what they are",
      unsigned{plan_.node});
}

std::optional<ServoState> AxisOnBus::state() const noexcept {
  const auto& state = axis_.state();
  if (!state) return std::nullopt;
  return ServoState{.position = state->position,
                    .velocity = state->velocity,
                    .following_error = state->following_error,
                    .enabled = state->enabled,
                    .at_internal_limit = state->at_internal_limit,
                    .target_reached = state->target_reached,
                    .homing = homing(),
                    .measured_at = axis_.heard_at()};
}

ServoHoming AxisOnBus::homing() const noexcept {
  switch (axis_.homing()) {
    case cia402::Homing::running:
      return ServoHoming::running;
    case cia402::Homing::failed:
      return ServoHoming::failed;
    case cia402::Homing::homed:
      return ServoHoming::homed;
    case cia402::Homing::not_homed:
      break;
  }
  return ServoHoming::not_homed;
}

cia402::Mode mode_of(ServoMode mode) noexcept {
  switch (mode) {
    case ServoMode::cyclic_velocity:
      return cia402::Mode::cyclic_velocity;
    case ServoMode::profile_position:
      return cia402::Mode::profile_position;
    case ServoMode::profile_velocity:
      return cia402::Mode::profile_velocity;
    case ServoMode::cyclic_position:
      break;
  }
  return cia402::Mode::cyclic_position;
}

}  // namespace flexrf::canopen
