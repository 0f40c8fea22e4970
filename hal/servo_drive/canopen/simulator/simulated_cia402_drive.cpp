// Its communication: boot-up, network management, SDO, PDOs, heartbeats, emergencies.
#include "hal/servo_drive/canopen/simulator/simulated_cia402_drive.hpp"

namespace flexrf {
namespace {

using canopen::Message;
using canopen::NmtCommand;
using canopen::NmtState;
using canopen::Outbox;
using canopen::PdoDirection;
using canopen::cia402::DriveState;
namespace axis = canopen::cia402::objects;

constexpr std::uint8_t last_synchronous = 240;

bool writes_target(const Message& request) {
  const auto index = static_cast<std::uint16_t>(canopen::read_number(request.data.data() + 1, 2));
  const bool is_write = (request.data[0] & 0xE0) == 0x20;
  return is_write && (index == axis::target_position.index || index == axis::target_velocity.index ||
                      index == axis::interpolation_point.index);
}

}  // namespace

SimulatedCia402Drive::SimulatedCia402Drive(const Options& options)
    : options_{options}, server_{options.node, objects_}, motion_{options.first_position} {}

void SimulatedCia402Drive::power_on(Time now) {
  powered_ = true;
  boot(now, true);
}

void SimulatedCia402Drive::power_off() {
  powered_ = booted_ = false;
  motion_.brake();
}

void SimulatedCia402Drive::reset_itself(Time now) {
  motion_.brake();
  boot(now, true);
}

void SimulatedCia402Drive::boot(Time now, bool all) {
  objects_.reset(all);
  objects_.set_pre_operational(true);
  server_ = canopen::SdoServer{options_.node, objects_};
  booted_ = false;
  nmt_ = NmtState::boot_up;
  boots_at_ = now + options_.boot_delay;
  master_.begin({});
  master_lost_ = toggle_ = false;
  pending_ = {};
  sent_ = {};
  errors_ &= all ? 0 : static_cast<std::uint8_t>(Error::fault);
  show_errors();
  if (all) {
    was_homed_ = false;
    state_ = DriveState::not_ready;
    last_command_ = 0;
    mode_bits_ = 0;
  } else if (state_ == DriveState::operation_enabled) {
    enter(DriveState::quick_stop_active, now);
  }
}

void SimulatedCia402Drive::receive(const Message& message, Time now, Outbox& outbox) {
  if (!powered_ || !booted_) return;
  if (message.remote) {
    answer_guard(message, now, outbox);
    return;
  }
  if (const auto command = canopen::nmt_command_for(message, options_.node)) {
    obey(*command, now);
    return;
  }
  const auto supervised = static_cast<std::uint32_t>(objects_.get(canopen::objects::consumer_heartbeat));
  if (supervised != 0 && canopen::heartbeat_of(message, static_cast<std::uint8_t>(supervised >> 16))) {
    if (!master_.is_supervising()) master_.begin(std::chrono::milliseconds(supervised & 0xFFFF));
    master_.observe(now);
    master_lost_ = false;
    return;
  }
  if (nmt_ == NmtState::stopped) return;
  if (const auto answer = server_.receive(message)) {
    outbox.push(*answer);
    if (writes_target(message)) take_cyclic_target();
    command(now, outbox);
    return;
  }
  if (nmt_ != NmtState::operational) return;
  if (message.identifier == (objects_.get(canopen::objects::sync) & 0x7FF)) {
    synchronise(now, outbox);
    command(now, outbox);
  } else {
    take_pdo(message, now, outbox);
    command(now, outbox);
  }
}

void SimulatedCia402Drive::advance(Time now, Outbox& outbox) {
  if (!powered_) return;
  if (!booted_) {
    if (now < boots_at_) return;
    booted_ = true;
    nmt_ = NmtState::pre_operational;
    beats_at_ = moved_ = now;
    if (state_ == DriveState::not_ready) enter(DriveState::switch_on_disabled, now);
    outbox.push(canopen::heartbeat_message(NmtState::boot_up, options_.node));
  }
  const std::chrono::milliseconds period{objects_.get(canopen::objects::producer_heartbeat)};
  if (period.count() > 0 && now >= beats_at_) {
    beats_at_ = now + period;
    if (!silent_) outbox.push(canopen::heartbeat_message(nmt_, options_.node));
  }
  supervise(now, outbox);
  command(now, outbox);
  move(now, outbox);
  if (nmt_ == NmtState::operational) send_by_events(now, outbox);
}

void SimulatedCia402Drive::obey(NmtCommand command, Time now) {
  switch (command) {
    case NmtCommand::start:
      if (nmt_ != NmtState::operational) sent_ = {};
      nmt_ = NmtState::operational;
      break;
    case NmtCommand::stop:
      nmt_ = NmtState::stopped;
      break;
    case NmtCommand::enter_pre_operational:
      nmt_ = NmtState::pre_operational;
      break;
    case NmtCommand::reset_node:
      motion_.brake();
      boot(now, true);
      return;
    case NmtCommand::reset_communication:
      boot(now, false);
      return;
  }
  objects_.set_pre_operational(nmt_ == NmtState::pre_operational);
}

// Of a drive that was given a heartbeat nobody may ask (CiA 301).
void SimulatedCia402Drive::answer_guard(const Message& question, Time now, Outbox& outbox) {
  if (question.identifier != canopen::identifier_of(canopen::heartbeat_base, options_.node)) return;
  if (objects_.get(canopen::objects::producer_heartbeat) != 0) return;
  if (!silent_) {
    outbox.push(canopen::guard_answer(nmt_, toggle_, options_.node));
    toggle_ = !toggle_;
  }
  const std::uint64_t life =
      objects_.get(canopen::objects::guard_time) * objects_.get(canopen::objects::life_time_factor);
  if (life == 0) return;
  if (!master_.is_supervising()) master_.begin(std::chrono::milliseconds(life));
  master_.observe(now);
  master_lost_ = false;
}

void SimulatedCia402Drive::take_pdo(const Message& message, Time now, Outbox& outbox) {
  for (std::uint16_t number = 1; number <= DriveObjects::pdos; ++number) {
    const auto plan = objects_.pdo(PdoDirection::received_by_node, number);
    if (!plan || plan->identifier != message.identifier) continue;
    if (plan->transmission <= last_synchronous) {
      pending_[number - 1U] = message;
    } else {
      apply(*plan, message, now, outbox);
    }
  }
}

void SimulatedCia402Drive::synchronise(Time now, Outbox& outbox) {
  for (std::uint16_t number = 1; number <= DriveObjects::pdos; ++number) {
    auto& pending = pending_[number - 1U];
    const auto plan = objects_.pdo(PdoDirection::received_by_node, number);
    if (plan && pending) apply(*plan, *pending, now, outbox);
    const bool awaited = plan && plan->transmission <= last_synchronous;
    if (awaited && !pending && state_ == DriveState::operation_enabled) ++missed_;
    pending.reset();
  }
  ++synchronised_;
  publish();
  send_at_sync(now, outbox);
}

Message SimulatedCia402Drive::pdo_now(const canopen::PdoPlan& plan) const {
  std::uint64_t values[canopen::PdoPlan::most_entries] = {};
  for (std::size_t i = 0; i < plan.count; ++i) values[i] = objects_.get(plan.entries[i].object);
  return canopen::pack(plan, values);
}

// Types 1 to 240: with each so many SYNCs; 0: with the SYNC behind a change.
void SimulatedCia402Drive::send_at_sync(Time now, Outbox& outbox) {
  for (std::uint16_t number = 1; number <= DriveObjects::pdos; ++number) {
    const auto plan = objects_.pdo(PdoDirection::sent_by_node, number);
    if (!plan || plan->transmission > last_synchronous) continue;
    Sent& sent = sent_[number - 1U];
    const Message message = pdo_now(*plan);
    ++sent.syncs;
    const bool is_due = plan->transmission == 0 ? sent.last != message : sent.syncs >= plan->transmission;
    if (!is_due) continue;
    sent = {.last = message, .at = now};
    outbox.push(message);
  }
}

// Types 254 and 255: when something in it changes, and each event time; no two within the inhibit time.
void SimulatedCia402Drive::send_by_events(Time now, Outbox& outbox) {
  constexpr std::uint8_t first_by_events = 254;
  for (std::uint16_t number = 1; number <= DriveObjects::pdos; ++number) {
    const auto plan = objects_.pdo(PdoDirection::sent_by_node, number);
    if (!plan || plan->transmission < first_by_events) continue;
    Sent& sent = sent_[number - 1U];
    const Message message = pdo_now(*plan);
    const std::chrono::microseconds inhibited{100 * objects_.get(plan->communication(3))};
    const std::chrono::milliseconds event_time{objects_.get(plan->communication(5))};
    const Duration since = now - sent.at;
    if (sent.last && since < inhibited) continue;
    const bool is_time = event_time.count() > 0 && since >= event_time;
    if (sent.last == message && !is_time) continue;
    sent = {.last = message, .at = now};
    outbox.push(message);
  }
}

void SimulatedCia402Drive::apply(const canopen::PdoPlan& plan, const Message& message, Time now,
                                 Outbox& outbox) {
  std::uint64_t values[canopen::PdoPlan::most_entries] = {};
  if (!canopen::unpack(plan, message, values)) {
    raise(Error::short_pdo, 0x8210, outbox);
    return;
  }
  end(Error::short_pdo, outbox);
  for (std::size_t i = 0; i < plan.count; ++i) {
    objects_.set(plan.entries[i].object, static_cast<std::int64_t>(values[i]));
    if (options_.acts_on_each_object) command(now, outbox);
  }
  take_cyclic_target();
}

// It goes to a cyclic position within the period that it was told, as drives do that interpolate.
void SimulatedCia402Drive::take_cyclic_target() {
  targets_fresh_ = true;
  const double period = static_cast<double>(objects_.get(axis::period_value)) *
                        std::pow(10.0, static_cast<double>(objects_.get_signed(axis::period_exponent)));
  const double distance = std::abs(cyclic_target() - motion_.position());
  cyclic_speed_ = distance / std::max(period, 1e-6);
  if (state_ == DriveState::operation_enabled && is_led_by_positions()) {
    longest_jump_ = std::max(longest_jump_, distance);
  }
}

// Its counter of 32 bits runs over, and a target is where it is nearer.
double SimulatedCia402Drive::place_of(std::int64_t target) const {
  const std::int64_t here = std::llround(motion_.position());
  return static_cast<double>(here + static_cast<std::int32_t>(static_cast<std::uint32_t>(target) -
                                                              static_cast<std::uint32_t>(here)));
}

bool SimulatedCia402Drive::is_led_by_positions() const {
  return interpolates() ||
         objects_.get_signed(axis::mode) == static_cast<int>(canopen::cia402::Mode::cyclic_position);
}

// In interpolated position mode the controlword enables interpolation beside the operation, and until then
// points are taken and not gone to.
bool SimulatedCia402Drive::interpolates() const {
  const bool is_its_mode =
      objects_.get_signed(axis::mode) == static_cast<int>(canopen::cia402::Mode::interpolated_position);
  return is_its_mode && (objects_.get(axis::controlword) & canopen::cia402::control_bit::interpolate) != 0;
}

double SimulatedCia402Drive::cyclic_target() const {
  const bool is_point =
      objects_.get_signed(axis::mode) == static_cast<int>(canopen::cia402::Mode::interpolated_position);
  return place_of(objects_.get_signed(is_point ? axis::interpolation_point : axis::target_position));
}

void SimulatedCia402Drive::supervise(Time now, Outbox& outbox) {
  if (master_lost_ || !master_.is_lost(now)) return;
  master_lost_ = true;
  raise(Error::heartbeat, 0x8130, outbox);
  if (state_ != DriveState::operation_enabled) return;
  switch (objects_.get_signed(axis::abort_connection)) {
    case 1:
      objects_.set(axis::error_code, 0x8130);
      errors_ |= static_cast<std::uint8_t>(Error::fault);
      show_errors();
      enter(DriveState::fault_reaction, now);
      break;
    case 2:
      motion_.brake();
      enter(DriveState::switch_on_disabled, now);
      break;
    case 3:
      enter(DriveState::quick_stop_active, now);
      break;
    default:
      break;
  }
}

void SimulatedCia402Drive::raise(Error error, std::uint16_t code, Outbox& outbox) {
  errors_ |= static_cast<std::uint8_t>(error);
  show_errors();
  emit(code, outbox);
}

// When the last of them has gone it says that too.
void SimulatedCia402Drive::end(Error error, Outbox& outbox) {
  const auto rest = static_cast<std::uint8_t>(errors_ & ~static_cast<std::uint8_t>(error));
  if (rest == errors_) return;
  errors_ = rest;
  show_errors();
  if (errors_ == 0) emit(0x0000, outbox);
}

// Object 1001: bit 0 with any error, bit 4 with one of the communication.
void SimulatedCia402Drive::show_errors() {
  const bool is_of_communication = (errors_ & ~static_cast<std::uint8_t>(Error::fault)) != 0;
  objects_.set(canopen::objects::error_register,
               (errors_ != 0 ? 0x01 : 0) | (is_of_communication ? 0x10 : 0));
}

void SimulatedCia402Drive::emit(std::uint16_t error_code, Outbox& outbox) {
  if (!booted_) return;
  const auto error_register = static_cast<std::uint8_t>(objects_.get(canopen::objects::error_register));
  outbox.push(
      canopen::emergency_message({.code = error_code, .error_register = error_register}, options_.node));
}

void SimulatedCia402Drive::trip(std::uint16_t error_code, bool persists, Outbox& outbox) {
  cause_persists_ = persists;
  objects_.set(axis::error_code, error_code);
  state_ = DriveState::fault_reaction;
  raise(Error::fault, error_code, outbox);
}

}  // namespace flexrf
