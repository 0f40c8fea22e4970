#include "hal/gpio/chip/canopen/io_module.hpp"

#include <algorithm>
#include <array>

namespace flexrf::canopen {
namespace {

constexpr std::uint8_t bits_of_byte = 8;
constexpr std::uint8_t on_its_own = 255;
constexpr std::uint8_t with_each_sync = 1;
constexpr std::uint8_t stops = 2;  // of object 1029
// For one that has not the byte of this place.
constexpr std::array<const char*, cia401::most_bytes> fewer_inputs = {
    "input_bytes = 0", "input_bytes = 1", "input_bytes = 2", "input_bytes = 3",
    "input_bytes = 4", "input_bytes = 5", "input_bytes = 6", "input_bytes = 7"};
constexpr std::array<const char*, cia401::most_bytes> fewer_outputs = {
    "output_bytes = 0", "output_bytes = 1", "output_bytes = 2", "output_bytes = 3",
    "output_bytes = 4", "output_bytes = 5", "output_bytes = 6", "output_bytes = 7"};

constexpr std::uint8_t byte_of(std::uint64_t lines, std::uint8_t byte) noexcept {
  return static_cast<std::uint8_t>(lines >> (bits_of_byte * (byte - 1U)));
}

long long in_ms(Duration duration) {
  return static_cast<long long>(duration.count() / 1'000'000);
}

}  // namespace

Status IoModule::check(const IoModulePlan& plan) const noexcept {
  if (plan.input_bytes > cia401::most_bytes || plan.output_bytes > cia401::most_bytes ||
      (plan.input_bytes == 0 && plan.output_bytes == 0)) {
    return Status::error(
        StatusCode::invalid_argument,
        "node %u: it has 1 to %u bytes of inputs, or of outputs, or both: set input_bytes and "
        "output_bytes",
        unsigned{plan.node}, unsigned{cia401::most_bytes});
  }
  if (plan.refresh < Duration{} || plan.refresh > std::chrono::milliseconds(0xFFFF)) {
    return Status::error(StatusCode::invalid_argument,
                         "node %u: its refresh is at most 65.535 s, as the module counts it",
                         unsigned{plan.node});
  }
  return {};
}

Status IoModule::begin(const IoModulePlan& plan, std::uint64_t safe, Time now, Outbox& outbox) noexcept {
  if (const Status status = check(plan); !status.is_ok()) return status;
  plan_ = plan;
  is_there_ = false;
  is_coming_ = true;
  inputs_.reset();
  beat_.begin(plan_.heartbeat_period, now);
  return node_.begin(node_plan(safe), now, outbox);
}

NodePlan IoModule::node_plan(std::uint64_t safe) noexcept {
  told_ = {.direction = PdoDirection::sent_by_node,
           .identifier = transmit_pdo_identifier(1, plan_.node),
           .transmission = plan_.refresh == Duration{} ? with_each_sync : on_its_own,
           .event_timer = static_cast<std::uint16_t>(in_ms(plan_.refresh)),
           .event_timer_helps = "refresh = 0",
           .forbids_remote = plan_.forbids_remote,
           .helps = plan_.forbids_remote ? "forbids_remote = false" : ""};
  asked_ = {.direction = PdoDirection::received_by_node,
            .identifier = receive_pdo_identifier(1, plan_.node),
            .transmission = on_its_own};
  for (std::uint8_t byte = 1; byte <= plan_.input_bytes; ++byte) {
    told_.add(cia401::objects::input(byte), bits_of_byte, fewer_inputs[byte - 1U]);
  }
  for (std::uint8_t byte = 1; byte <= plan_.output_bytes; ++byte) {
    asked_.add(cia401::objects::output(byte), bits_of_byte, fewer_outputs[byte - 1U]);
  }

  NodePlan node{.node = plan_.node,
                .master = plan_.master,
                .boot_timeout = plan_.boot_timeout,
                .sdo_timeout = plan_.sdo_timeout,
                .heartbeat_period = plan_.heartbeat_period,
                .heartbeat_limit = plan_.heartbeat_limit,
                .is_guarded = plan_.is_guarded,
                .master_heartbeat_limit = plan_.is_supervised_by_it ? plan_.heartbeat_limit : Duration{}};
  Configuration& list = node.configuration;
  list.expect(objects::device_type, cia401::profile_number, 0xFFFF, "device profile");
  if (plan_.vendor != 0) list.expect(objects::vendor, plan_.vendor, 0xFFFFFFFF, "vendor");
  if (plan_.product != 0) list.expect(objects::product, plan_.product, 0xFFFFFFFF, "product");
  plan_outputs(list, safe);
  plan_inputs(list);
  return node;
}

// Outputs first: what they were before it booted may still stand in object 6200.
void IoModule::plan_outputs(Configuration& list, std::uint64_t safe) const noexcept {
  for (std::uint8_t byte = 1; byte <= plan_.output_bytes; ++byte) {
    const std::uint8_t lines = byte_of(safe, byte);
    // What is on is turned round on this side, or not at all: so 6200 and 6207 mean the same.
    list.write_if_there(cia401::objects::output_polarity(byte), 1, 0);
    list.write(cia401::objects::output(byte), 1, lines, fewer_outputs[byte - 1U]);
    list.write_if_there(cia401::objects::output_mask(byte), 1, cia401::all_lines);
    if (!plan_.tells_error_values) continue;
    constexpr const char* helps = "tells_error_values = false";
    list.write(cia401::objects::error_mode(byte), 1, cia401::all_lines, helps);
    list.write(cia401::objects::error_value(byte), 1, lines, helps);
  }
  if (plan_.output_bytes == 0) return;
  // Some take their error values in every state that is not operational, some only when they are stopped. One
  // without this object becomes pre-operational.
  list.write_if_there(objects::error_behaviour, 1, stops);
  list.configure_pdo(asked_);
}

void IoModule::plan_inputs(Configuration& list) const noexcept {
  if (plan_.input_bytes == 0) return;
  for (std::uint8_t byte = 1; byte <= plan_.input_bytes; ++byte) {
    list.write_if_there(cia401::objects::input_polarity(byte), 1, 0);
    list.write_if_there(cia401::objects::interrupt_mask(byte), 1, cia401::all_lines);
  }
  list.write_if_there(cia401::objects::interrupts, 1, 1);
  list.configure_pdo(told_);
}

std::uint64_t IoModule::receive(const Message& message, Time now, Outbox& outbox) noexcept {
  if (!node_.is_operational() || plan_.input_bytes == 0 || message.identifier != told_.identifier) {
    node_.receive(message, now, outbox);
    return 0;
  }
  std::uint64_t bytes[PdoPlan::most_entries] = {};
  // What is truncated says nothing.
  if (!unpack(told_, message, bytes)) return 0;
  std::uint64_t lines = 0;
  for (std::size_t i = 0; i < told_.count; ++i) lines |= bytes[i] << (bits_of_byte * i);
  const std::uint64_t changed = inputs_ ? *inputs_ ^ lines : 0;
  inputs_ = lines;
  heard_ = now;
  silent_cycles_ = 0;
  return changed;
}

void IoModule::look(bool usable, Time now) noexcept {
  const bool was_there = is_there_;
  is_there_ = usable && node_.is_operational();
  if (!is_there_) {
    inputs_.reset();
    forget_outputs();
  } else if (!was_there) {
    heard_ = now;
    silent_cycles_ = 0;
    if (plan_.input_bytes == 0) inputs_ = 0;
  }
  silent_cycles_ = std::min(silent_cycles_ + 1, most_silent_cycles + 1);
  const bool silent = is_there_ && is_silent(now);
  if (silent) inputs_.reset();
  trouble_ = find_trouble(usable, silent);
}

bool IoModule::has_outputs(std::uint64_t bits, Time now, Outbox& outbox) noexcept {
  SdoClient& client = node_.client();
  if (client.state() == SdoClient::State::busy) return false;
  if (asks_) {
    asks_ = false;
    const bool is_right = is_confirmed(byte_of(bits, static_cast<std::uint8_t>(confirmed_ + 1)));
    confirmed_ = is_right ? static_cast<std::uint8_t>(confirmed_ + 1) : std::uint8_t{0};
  }
  if (confirmed_ >= plan_.output_bytes) return true;
  asks_ = client.read(cia401::objects::output(static_cast<std::uint8_t>(confirmed_ + 1)), now, outbox);
  return false;
}

bool IoModule::is_confirmed(std::uint8_t lines) noexcept {
  const SdoClient& client = node_.client();
  if (client.state() == SdoClient::State::done) return (client.number() & 0xFF) == lines;
  return client.status().code() != StatusCode::timeout;
}

bool IoModule::is_silent(Time now) const noexcept {
  if (plan_.input_bytes == 0) return false;
  return plan_.refresh == Duration{} ? silent_cycles_ > most_silent_cycles
                                     : now - heard_ > most_silent * plan_.refresh;
}

Status IoModule::find_trouble(bool usable, bool silent) noexcept {
  const unsigned node = plan_.node;
  const Status& problem = node_.problem();
  is_coming_ = false;
  if (node_.state() == NodeState::refused) {
    return Status::error(problem.code(),
                         "%s; put it right, then initialise this device, or switch the module off and on",
                         problem.cause());
  }
  if (!usable)
    return Status::error(StatusCode::unavailable, "node %u: its bus is not usable; see to the bus", node);
  if (!problem.is_ok()) return problem;
  if (silent) {
    return Status::error(
        StatusCode::timeout, "node %u is operational and does not tell its inputs (TPDO 1): %s", node,
        plan_.refresh == Duration{}
            ? "does it hear SYNC?"
            : "is its event timer slower than `refresh`? One without a timer needs `refresh = 0`");
  }
  is_coming_ = !inputs_ || !is_there_;
  if (is_coming_) {
    return Status::error(StatusCode::unavailable, "node %u is %s; it has not told its inputs yet", node,
                         name_of(node_.state()));
  }
  if (const auto& emergency = node_.emergency()) {
    return Status::error(StatusCode::device_fault, "node %u says: %s (%04X)", node,
                         describe_error_code(emergency->code), unsigned{emergency->code});
  }
  return {};
}

void IoModule::send(Time now, Outbox& outbox) noexcept {
  node_.advance(now, outbox);
  if (plan_.refresh == Duration{}) outbox.push({sync_identifier, 0, {}});
  if (beat_.is_due(now)) outbox.push(heartbeat_message(NmtState::operational, plan_.master));
}

std::optional<Message> IoModule::outputs(std::uint64_t bits) const noexcept {
  if (plan_.output_bytes == 0) return std::nullopt;
  std::uint64_t bytes[PdoPlan::most_entries] = {};
  for (std::uint8_t byte = 1; byte <= plan_.output_bytes; ++byte) bytes[byte - 1U] = byte_of(bits, byte);
  return pack(asked_, bytes);
}

}  // namespace flexrf::canopen
