#include "hal/gpio/chip/canopen/simulator/simulated_cia401_module.hpp"

#include "hal/canopen/cia401.hpp"

namespace flexrf {
namespace {

using canopen::Message;
using canopen::NmtCommand;
using canopen::NmtState;
using canopen::Outbox;
using canopen::PdoDirection;
namespace module = canopen::cia401::objects;

constexpr std::uint8_t last_synchronous = 240;
constexpr std::uint8_t first_by_events = 254;
constexpr std::uint16_t heartbeat_lost = 0x8130;
constexpr std::uint16_t short_pdo = 0x8210;

}  // namespace

SimulatedCia401Module::SimulatedCia401Module(const Options& options)
    : options_{options},
      objects_{options.node, options.input_bytes, options.output_bytes},
      server_{options.node, objects_} {}

void SimulatedCia401Module::power_on(Time now) {
  powered_ = true;
  boot(now, true);
}

void SimulatedCia401Module::power_off() {
  powered_ = booted_ = false;
  outputs_ = 0;
}

void SimulatedCia401Module::reset_itself(Time now) {
  boot(now, true);
}

void SimulatedCia401Module::boot(Time now, bool all) {
  objects_.reset(all);
  objects_.set_pre_operational(true);
  server_ = canopen::SdoServer{options_.node, objects_};
  booted_ = false;
  nmt_ = NmtState::boot_up;
  boots_at_ = now + options_.boot_delay;
  master_.begin({});
  master_lost_ = toggle_ = false;
  sent_ = {};
  if (all) {
    in_error_ = false;
    objects_.set(canopen::objects::error_register, 0);
    outputs_ = 0;
  }
  read_inputs();
}

void SimulatedCia401Module::receive(const Message& message, Time now, Outbox& outbox) {
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
    hear_master(std::chrono::milliseconds(supervised & 0xFFFF), now, outbox);
    return;
  }
  if (nmt_ == NmtState::stopped) return;
  if (const auto answer = server_.receive(message)) {
    outbox.push(*answer);
    put_outputs();
    return;
  }
  if (nmt_ != NmtState::operational) return;
  if (message.identifier == (objects_.get(canopen::objects::sync) & 0x7FF)) {
    const auto plan = objects_.pdo(PdoDirection::sent_by_node, 1);
    if (plan && plan->transmission <= last_synchronous) tell_inputs(now, outbox);
  } else {
    take_outputs(message, outbox);
  }
}

void SimulatedCia401Module::advance(Time now, Outbox& outbox) {
  if (!powered_) return;
  if (!booted_) {
    if (now < boots_at_) return;
    booted_ = true;
    nmt_ = NmtState::pre_operational;
    beats_at_ = now;
    outbox.push(canopen::heartbeat_message(NmtState::boot_up, options_.node));
  }
  const std::chrono::milliseconds period{objects_.get(canopen::objects::producer_heartbeat)};
  if (period.count() > 0 && now >= beats_at_) {
    beats_at_ = now + period;
    if (!silent_) outbox.push(canopen::heartbeat_message(nmt_, options_.node));
  }
  if (!master_lost_ && master_.is_lost(now)) lose_master(outbox);
  tell_if_due(now, outbox);
}

void SimulatedCia401Module::obey(NmtCommand command, Time now) {
  switch (command) {
    case NmtCommand::start:
      enter(NmtState::operational);
      return;
    case NmtCommand::stop:
      enter(NmtState::stopped);
      return;
    case NmtCommand::enter_pre_operational:
      enter(NmtState::pre_operational);
      return;
    case NmtCommand::reset_node:
      boot(now, true);
      return;
    case NmtCommand::reset_communication:
      boot(now, false);
      return;
  }
}

void SimulatedCia401Module::enter(NmtState state) {
  if (state == NmtState::operational && nmt_ != NmtState::operational) sent_ = {};
  nmt_ = state;
  objects_.set_pre_operational(state == NmtState::pre_operational);
  if (state == NmtState::operational) in_error_ = false;
  if (state == NmtState::stopped) in_error_ = true;
  put_outputs();
}

// Of a module that was given a heartbeat nobody may ask (CiA 301).
void SimulatedCia401Module::answer_guard(const Message& question, Time now, Outbox& outbox) {
  if (question.identifier != canopen::identifier_of(canopen::heartbeat_base, options_.node)) return;
  if (objects_.get(canopen::objects::producer_heartbeat) != 0) return;
  if (!silent_) {
    outbox.push(canopen::guard_answer(nmt_, toggle_, options_.node));
    toggle_ = !toggle_;
  }
  const std::uint64_t life =
      objects_.get(canopen::objects::guard_time) * objects_.get(canopen::objects::life_time_factor);
  if (life != 0) hear_master(std::chrono::milliseconds(life), now, outbox);
}

void SimulatedCia401Module::hear_master(Duration limit, Time now, Outbox& outbox) {
  if (!master_.is_supervising()) master_.begin(limit);
  master_.observe(now);
  if (!master_lost_) return;
  master_lost_ = false;
  say(0, outbox);
}

void SimulatedCia401Module::lose_master(Outbox& outbox) {
  master_lost_ = true;
  in_error_ = true;
  say(heartbeat_lost, outbox);
  constexpr std::uint64_t stays = 1;
  constexpr std::uint64_t stops = 2;
  const std::uint64_t behaviour = objects_.get(canopen::objects::error_behaviour);
  if (nmt_ == NmtState::operational && behaviour != stays) {
    enter(behaviour == stops ? NmtState::stopped : NmtState::pre_operational);
  }
  put_outputs();
}

void SimulatedCia401Module::take_outputs(const Message& message, Outbox& outbox) {
  const auto plan = objects_.pdo(PdoDirection::received_by_node, 1);
  if (!plan || plan->identifier != message.identifier) return;
  std::uint64_t values[canopen::PdoPlan::most_entries] = {};
  if (!canopen::unpack(*plan, message, values)) {
    say(short_pdo, outbox);
    return;
  }
  for (std::size_t i = 0; i < plan->count; ++i) {
    objects_.set(plan->entries[i].object, static_cast<std::int64_t>(values[i]));
  }
  put_outputs();
}

std::uint64_t SimulatedCia401Module::lines(canopen::ObjectAddress (*object)(std::uint8_t) noexcept,
                                           std::uint8_t bytes, std::uint8_t missing) const {
  std::uint64_t all = 0;
  for (std::uint8_t byte = 1; byte <= bytes; ++byte) {
    const canopen::ObjectAddress address = object(byte);
    all |= (objects_.has(address) ? objects_.get(address) : missing) << (8 * (byte - 1U));
  }
  return all;
}

void SimulatedCia401Module::put_outputs() {
  const auto all = [this](auto object, std::uint8_t missing) {
    return lines(object, options_.output_bytes, missing);
  };
  if (in_error_) {
    const std::uint64_t taken = all(module::error_mode, canopen::cia401::all_lines);
    outputs_ = (outputs_ & ~taken) | (all(module::error_value, 0) & taken);
    return;
  }
  const std::uint64_t followed = all(module::output_mask, canopen::cia401::all_lines);
  const std::uint64_t wanted = all(module::output, 0) ^ all(module::output_polarity, 0);
  outputs_ = (outputs_ & ~followed) | (wanted & followed);
}

void SimulatedCia401Module::read_inputs() {
  const std::uint64_t seen = terminals_ ^ lines(module::input_polarity, options_.input_bytes, 0);
  for (std::uint8_t byte = 1; byte <= options_.input_bytes; ++byte) {
    objects_.set(module::input(byte), static_cast<std::int64_t>((seen >> (8 * (byte - 1U))) & 0xFF));
  }
}

void SimulatedCia401Module::drive(std::uint64_t inputs, Time now, Outbox& outbox) {
  const std::uint64_t changed = terminals_ ^ inputs;
  terminals_ = inputs;
  read_inputs();
  if (!powered_ || !booted_ || nmt_ != NmtState::operational) return;
  if (objects_.has(module::interrupts) && objects_.get(module::interrupts) == 0) return;
  if ((changed & lines(module::interrupt_mask, options_.input_bytes, canopen::cia401::all_lines)) == 0)
    return;
  const auto plan = objects_.pdo(PdoDirection::sent_by_node, 1);
  if (plan && plan->transmission >= first_by_events) tell_inputs(now, outbox);
}

void SimulatedCia401Module::tell_inputs(Time now, Outbox& outbox) {
  const auto plan = objects_.pdo(PdoDirection::sent_by_node, 1);
  if (!plan || tells_no_inputs_) return;
  read_inputs();
  std::uint64_t values[canopen::PdoPlan::most_entries] = {};
  for (std::size_t i = 0; i < plan->count; ++i) values[i] = objects_.get(plan->entries[i].object);
  sent_ = {.last = canopen::pack(*plan, values), .at = now};
  outbox.push(*sent_.last);
}

// Once when it becomes operational, and with each event time.
void SimulatedCia401Module::tell_if_due(Time now, Outbox& outbox) {
  if (nmt_ != NmtState::operational) return;
  const auto plan = objects_.pdo(PdoDirection::sent_by_node, 1);
  if (!plan || plan->transmission < first_by_events) return;
  const std::chrono::milliseconds event_time{objects_.get(plan->communication(5))};
  const bool is_time = event_time.count() > 0 && now - sent_.at >= event_time;
  if (!sent_.last || is_time) tell_inputs(now, outbox);
}

void SimulatedCia401Module::trip(std::uint16_t error_code, Outbox& outbox) {
  say(error_code, outbox);
}

// A node that is stopped says no emergencies; but what is wrong stands in object 1001.
void SimulatedCia401Module::say(std::uint16_t error_code, Outbox& outbox) {
  objects_.set(canopen::objects::error_register, error_code == 0 ? 0 : 1);
  if (!booted_ || nmt_ == NmtState::stopped) return;
  outbox.push(canopen::emergency_message(
      {.code = error_code, .error_register = static_cast<std::uint8_t>(error_code == 0 ? 0 : 1)},
      options_.node));
}

}  // namespace flexrf
