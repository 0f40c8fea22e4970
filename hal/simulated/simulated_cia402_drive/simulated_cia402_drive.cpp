// Its communication: boot-up, network management, SDO, PDOs, heartbeats, emergencies.
#include "hal/simulated/simulated_cia402_drive/simulated_cia402_drive.hpp"

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
    if (nmt_ != NmtState::operational) command(now);
    return;
  }
  if (nmt_ != NmtState::operational) return;
  if (message.identifier == canopen::sync_identifier) {
    synchronise(now, outbox);
    command(now);
  } else {
    take_pdo(message, now, outbox);
    command(now);
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
  command(now);
  move(now, outbox);
}

void SimulatedCia402Drive::obey(NmtCommand command, Time now) {
  switch (command) {
    case NmtCommand::start:
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
  for (std::uint16_t number = 1; number <= DriveObjects::pdos; ++number) {
    const auto plan = objects_.pdo(PdoDirection::sent_by_node, number);
    if (!plan || plan->transmission > last_synchronous) continue;
    std::uint64_t values[canopen::PdoPlan::most_entries] = {};
    for (std::size_t i = 0; i < plan->count; ++i) values[i] = objects_.get(plan->entries[i].object);
    outbox.push(canopen::pack(*plan, values));
  }
}

void SimulatedCia402Drive::apply(const canopen::PdoPlan& plan, const Message& message, Time now,
                                 Outbox& outbox) {
  std::uint64_t values[canopen::PdoPlan::most_entries] = {};
  if (!canopen::unpack(plan, message, values)) {
    emit(0x8210, outbox);
    return;
  }
  for (std::size_t i = 0; i < plan.count; ++i) {
    objects_.set(plan.entries[i].object, static_cast<std::int64_t>(values[i]));
    if (options_.acts_on_each_object) command(now);
  }
  targets_fresh_ = true;
  // It goes to a cyclic position within the period that it was told, as drives do that interpolate.
  const double period = static_cast<double>(objects_.get(axis::period_value)) *
                        std::pow(10.0, static_cast<double>(objects_.get_signed(axis::period_exponent)));
  const double distance =
      std::abs(static_cast<double>(objects_.get_signed(axis::target_position)) - motion_.position());
  cyclic_speed_ = distance / std::max(period, 1e-6);
  if (state_ == DriveState::operation_enabled && is_cyclic_position()) {
    longest_jump_ = std::max(longest_jump_, distance);
  }
}

bool SimulatedCia402Drive::is_cyclic_position() const {
  return objects_.get_signed(axis::mode) == static_cast<int>(canopen::cia402::Mode::cyclic_position);
}

void SimulatedCia402Drive::supervise(Time now, Outbox& outbox) {
  if (master_lost_ || !master_.is_lost(now)) return;
  master_lost_ = true;
  emit(0x8130, outbox);
  if (state_ != DriveState::operation_enabled) return;
  switch (objects_.get_signed(axis::abort_connection)) {
    case 1:
      objects_.set(axis::error_code, 0x8130);
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

void SimulatedCia402Drive::emit(std::uint16_t error_code, Outbox& outbox) {
  if (booted_)
    outbox.push(canopen::emergency_message({.code = error_code, .error_register = 1}, options_.node));
}

void SimulatedCia402Drive::trip(std::uint16_t error_code, bool persists, Outbox& outbox) {
  cause_persists_ = persists;
  objects_.set(axis::error_code, error_code);
  state_ = DriveState::fault_reaction;
  emit(error_code, outbox);
}

}  // namespace flexrf
