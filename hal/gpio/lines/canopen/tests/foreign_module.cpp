#include "hal/gpio/lines/canopen/tests/foreign_module.hpp"

#include <algorithm>
#include <utility>

namespace flexrf {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

// CiA 301, SDO abort codes.
constexpr std::uint32_t done = 0;
constexpr std::uint32_t toggle_not_alternated = 0x0503'0000;
constexpr std::uint32_t unknown_specifier = 0x0504'0001;
constexpr std::uint32_t is_read_only = 0x0601'0002;
constexpr std::uint32_t no_object = 0x0602'0000;
constexpr std::uint32_t not_mappable = 0x0604'0041;
constexpr std::uint32_t pdo_too_long = 0x0604'0042;
constexpr std::uint32_t incompatible = 0x0604'0043;
constexpr std::uint32_t wrong_length = 0x0607'0010;
constexpr std::uint32_t no_sub_index = 0x0609'0011;
constexpr std::uint32_t invalid_value = 0x0609'0030;
constexpr std::uint32_t value_too_low = 0x0609'0032;
constexpr std::uint32_t wrong_state = 0x0800'0022;
constexpr std::uint32_t no_data = 0x0800'0024;

constexpr std::uint32_t is_invalid = 0x8000'0000;         // bit 31 of a COB-ID
constexpr std::uint32_t no_remote_request = 0x4000'0000;  // bit 30 of a TPDO's
constexpr std::uint32_t is_extended = 0x2000'0000;        // bit 29
constexpr std::uint32_t can_id = 0x7FF;

constexpr std::uint8_t most_mapped = 8;  // entries, here each of a byte at least
constexpr std::uint8_t history = 8;      // sub-indices of 1003h
constexpr std::uint8_t event_driven = 254;

constexpr std::uint32_t key_of(std::uint16_t index, std::size_t sub) {
  return static_cast<std::uint32_t>(index << 8U | (sub & 0xFFU));
}
constexpr std::uint8_t byte_of(std::uint64_t value, std::size_t byte) {
  return static_cast<std::uint8_t>(value >> (8 * byte));
}
constexpr std::uint16_t word_of(std::uint32_t value) {
  return static_cast<std::uint16_t>(value & 0xFFFFU);
}

/// CiA 301, restricted CAN-IDs: no configurable communication object may use them.
constexpr bool is_restricted(std::uint32_t id) {
  return id <= 0x7F || (id >= 0x101 && id <= 0x180) || (id >= 0x581 && id <= 0x5FF) ||
         (id >= 0x601 && id <= 0x67F) || (id >= 0x6E0 && id <= 0x6FF) || id >= 0x701;
}

/// CiA 301, dummy mapping: bytes of an RPDO that are for nobody. 0: not a dummy that this module knows.
constexpr std::uint32_t dummy_bits(std::uint16_t index) {
  switch (index) {
    case 0x0002:  // INTEGER8
    case 0x0005:  // UNSIGNED8
      return 8;
    case 0x0003:  // INTEGER16
    case 0x0006:  // UNSIGNED16
      return 16;
    case 0x0004:  // INTEGER32
    case 0x0007:  // UNSIGNED32
      return 32;
    default:
      return 0;
  }
}

}  // namespace

ForeignModule::ForeignModule(const Settings& settings) : settings_(settings) {}

// ---- Object dictionary

void ForeignModule::add(std::uint16_t index, std::uint8_t sub, std::uint8_t size, Access access,
                        std::uint32_t value, Mapping mapping) {
  objects_[key_of(index, sub)] = {.value = value, .size = size, .access = access, .mapping = mapping};
}

/// An array of UNSIGNED8.
void ForeignModule::add_bytes(std::uint16_t index, std::size_t count, Access access, std::uint8_t value,
                              Mapping mapping) {
  add(index, 0, 1, Access::read_only, static_cast<std::uint32_t>(count));
  for (std::size_t sub = 1; sub <= count; ++sub) {
    add(index, static_cast<std::uint8_t>(sub), 1, access, value, mapping);
  }
}

void ForeignModule::remove(std::uint16_t first_index, std::uint16_t last_index) {
  objects_.erase(objects_.lower_bound(key_of(first_index, 0)),
                 objects_.upper_bound(key_of(last_index, 0xFF)));
}

/// 1000h to 1FFFh as after power-on.
void ForeignModule::lay_out_communication() {
  remove(0x1000, 0x1FFF);
  const std::uint32_t node = settings_.node;
  add(0x1000, 0, 4, Access::read_only, 0x0003'0191);  // profile 401, digital inputs and outputs
  add(0x1001, 0, 1, Access::read_only, 0);
  add(0x1003, 0, 1, Access::read_write, 0);
  for (std::uint8_t sub = 1; sub <= history; ++sub) add(0x1003, sub, 4, Access::read_only, 0);
  add(0x1005, 0, 4, Access::read_write, 0x80);
  add(0x1008, 0, 0, Access::read_only, 0);
  add(0x1014, 0, 4, Access::read_write, 0x80 + node);
  if (settings_.heartbeat_consumers > 0) {
    add(0x1016, 0, 1, Access::read_only, static_cast<std::uint32_t>(settings_.heartbeat_consumers));
    for (std::size_t sub = 1; sub <= settings_.heartbeat_consumers; ++sub) {
      add(0x1016, static_cast<std::uint8_t>(sub), 4, Access::read_write, 0);
    }
  }
  add(0x1017, 0, 2, Access::read_write, settings_.heartbeat_milliseconds);
  add(0x1018, 0, 1, Access::read_only, 4);
  add(0x1018, 1, 4, Access::read_only, settings_.vendor);
  add(0x1018, 2, 4, Access::read_only, settings_.product);
  add(0x1018, 3, 4, Access::read_only, settings_.revision);
  add(0x1018, 4, 4, Access::read_only, settings_.serial);
  // Of communication, outputs and inputs.
  if (settings_.has_error_behaviour) add_bytes(0x1029, 3, Access::read_write, 0);

  add(0x1400, 0, 1, Access::read_only, 2);
  add(0x1400, 1, 4, Access::read_write, 0x200 + node);
  add(0x1400, 2, 1, Access::read_write, 255);
  add(0x1800, 0, 1, Access::read_only, 5);
  add(0x1800, 1, 4, Access::read_write, no_remote_request | (0x180 + node));
  add(0x1800, 2, 1, Access::read_write, 255);
  add(0x1800, 3, 2, Access::read_write, 0);
  add(0x1800, 5, 2, Access::read_write, 0);

  const Access access = settings_.has_fixed_mapping ? Access::read_only : Access::read_write;
  const auto map = [&](std::uint16_t index, std::uint16_t object, std::size_t count) {
    add(index, 0, 1, access, static_cast<std::uint32_t>(count));
    for (std::uint8_t sub = 1; sub <= most_mapped; ++sub) {
      add(index, sub, 4, access, sub <= count ? key_of(object, sub) << 8U | 8U : 0);
    }
  };
  map(0x1600, 0x6200, settings_.output_bytes);
  map(0x1A00, 0x6000, settings_.input_bytes);
}

/// 6000h to 9FFFh as after power-on.
void ForeignModule::lay_out_application() {
  remove(0x6000, 0x9FFF);
  const std::size_t inputs = settings_.input_bytes;
  const std::size_t outputs = settings_.output_bytes;
  add_bytes(0x6000, inputs, Access::read_only, 0, Mapping::transmit);
  if (settings_.has_polarity) {
    add_bytes(0x6002, inputs, Access::read_write, 0);
    add_bytes(0x6202, outputs, Access::read_write, 0);
  }
  if (settings_.has_input_filter) add_bytes(0x6003, inputs, Access::read_write, 0);
  if (settings_.has_interrupt_masks) {
    add(0x6005, 0, 1, Access::read_write, settings_.enables_interrupts ? 1 : 0);
    add_bytes(0x6006, inputs, Access::read_write, 0xFF);
    add_bytes(0x6007, inputs, Access::read_write, 0);
    add_bytes(0x6008, inputs, Access::read_write, 0);
  }
  add_bytes(0x6200, outputs, Access::read_write, 0, Mapping::receive);
  if (settings_.has_error_values) {
    add_bytes(0x6206, outputs, Access::read_write, 0xFF);
    add_bytes(0x6207, outputs, Access::read_write, 0);
  }
  if (settings_.has_output_filter) add_bytes(0x6208, outputs, Access::read_write, 0xFF);
}

bool ForeignModule::has(std::uint16_t index) const {
  return objects_.contains(key_of(index, 0));
}

std::uint32_t& ForeignModule::at(std::uint16_t index, std::size_t sub) {
  return objects_.at(key_of(index, sub)).value;
}

std::uint32_t ForeignModule::value_or(std::uint16_t index, std::size_t sub, std::uint32_t other) const {
  const auto found = objects_.find(key_of(index, sub));
  return found == objects_.end() ? other : found->second.value;
}

std::optional<std::uint32_t> ForeignModule::object(std::uint16_t index, std::uint8_t sub) const {
  const auto found = objects_.find(key_of(index, sub));
  if (found == objects_.end() || found->second.size == 0) return std::nullopt;
  return found->second.value;
}

// ---- Time

Time ForeignModule::next_timer() const {
  if (state_ == State::off) return Time::max();
  if (state_ == State::initialising) return boot_at_;
  Time next = Time::max();
  if (value_or(0x1017, 0, 0) != 0) next = heartbeat_at_;
  for (const Consumer& consumer : consumers_) {
    if (consumer.is_watching && !consumer.is_lost) next = std::min(next, consumer.deadline);
  }
  if (request_) next = std::min(next, answer_at_);
  if (is_event_driven()) {
    if (is_pending_) next = std::min(next, std::max(clock_, inhibited_until_));
    const std::uint32_t timer = value_or(0x1800, 5, 0);
    if (timer != 0) next = std::min(next, event_timer_from_ + milliseconds{timer});
  }
  for (const std::optional<Time>& since : differs_since_) {
    if (since) next = std::min(next, *since + settings_.filter_time);
  }
  return next;
}

Time ForeignModule::next_event() const {
  return said_.empty() ? next_timer() : clock_;
}

void ForeignModule::run_until(Time now) {
  for (Time next = next_timer(); next <= now; next = next_timer()) {
    clock_ = std::max(clock_, next);
    run_timers();
  }
}

/// What is due at clock_.
void ForeignModule::run_timers() {
  if (state_ == State::initialising) {
    boot();
    return;
  }
  watch_heartbeats();
  if (request_ && answer_at_ <= clock_) {
    const Data request = *request_;
    request_.reset();
    serve(request);
  }
  const std::uint32_t period = value_or(0x1017, 0, 0);
  if (period != 0 && heartbeat_at_ <= clock_) {
    say(0x700U + settings_.node, {state_byte()}, 1);
    heartbeat_at_ += milliseconds{period};
  }
  scan();
  if (!is_event_driven()) return;
  const std::uint32_t timer = value_or(0x1800, 5, 0);
  if (timer != 0 && event_timer_from_ + milliseconds{timer} <= clock_) {
    event_timer_from_ = clock_;
    is_pending_ = true;
  }
  if (is_pending_ && inhibited_until_ <= clock_) send_pdo();
}

void ForeignModule::advance(Time now) {
  run_until(now);
  clock_ = std::max(clock_, now);
  if (state_ != State::off) scan();
  run_until(clock_);
}

void ForeignModule::hear(const CanFrame& frame, Time now) {
  advance(now);
  if (state_ == State::off || state_ == State::initialising || frame.extended) return;
  const std::uint32_t id = frame.identifier;
  if (frame.remote) {
    const std::uint32_t cob_id = at(0x1800, 1);
    if ((cob_id & no_remote_request) == 0 && id == (cob_id & can_id)) send_pdo();
    return;
  }
  if (id == 0x000) {
    command(frame);
    return;
  }
  if (id > 0x700 && id <= 0x77F && frame.length > 0) {
    heartbeat_from(static_cast<std::uint8_t>(id & 0x7FU));
    return;
  }
  if (state_ == State::stopped) return;
  if (id == 0x600U + settings_.node) {
    // A server that is busy has no place for another request.
    if (frame.length != 8 || request_) return;
    if (settings_.sdo_answer_time == Duration{}) {
      serve(frame.data);
    } else {
      request_ = frame.data;
      answer_at_ = clock_ + settings_.sdo_answer_time;
    }
  } else if (id == (at(0x1005, 0) & can_id)) {
    synchronise();
  } else if (is_valid(0x1400) && id == (at(0x1400, 1) & can_id)) {
    receive_pdo(frame);
  }
}

std::vector<CanFrame> ForeignModule::step(Time now) {
  advance(now);
  return std::exchange(said_, {});
}

void ForeignModule::say(std::uint32_t identifier, const Data& data, std::uint8_t length) {
  CanFrame frame;
  frame.time = clock_;
  frame.identifier = identifier;
  frame.length = length;
  frame.data = data;
  said_.push_back(frame);
}

// ---- NMT and error control

void ForeignModule::power_on(Time now) {
  power_off();
  clock_ = std::max(clock_, now);
  initialise(true);
}

void ForeignModule::power_off() {
  state_ = State::off;
  said_.clear();
  pins_ = {};
  objects_.clear();
}

/// CiA 301: Initialisation; its sub-state Reset Application comes first where `with_application`.
void ForeignModule::initialise(bool with_application) {
  lay_out_communication();
  if (with_application) {
    const auto kept_pins = pins_;
    std::array<std::uint32_t, most_bytes> kept_values{};
    for (std::size_t byte = 0; byte < settings_.output_bytes; ++byte) {
      kept_values[byte] = value_or(0x6200, byte + 1, 0);
    }
    lay_out_application();
    pins_ = {};
    in_error_ = {};
    if (settings_.keeps_outputs_on_reset && state_ != State::off) {
      pins_ = kept_pins;
      for (std::size_t byte = 0; byte < settings_.output_bytes; ++byte) {
        at(0x6200, byte + 1) = kept_values[byte];
      }
    }
    settled_ = terminals_;
    differs_since_ = {};
  }
  state_ = State::initialising;
  boot_at_ = clock_ + settings_.boot_time;
  consumers_.assign(settings_.heartbeat_consumers, {});
  has_length_fault_ = false;
  upload_.reset();
  request_.reset();
  latched_.reset();
  is_pending_ = false;
}

/// The boot-up message; NMT Pre-operational is entered by itself.
void ForeignModule::boot() {
  say(0x700U + settings_.node, {0x00}, 1);
  state_ = State::pre_operational;
  heartbeat_at_ = clock_ + milliseconds{at(0x1017, 0)};
  scan();
  if (settings_.says_no_error_after_boot) say_emergency(0, 0);
  if (settings_.starts_itself) enter(State::operational);
}

void ForeignModule::command(const CanFrame& frame) {
  if (frame.length != 2 || (frame.data[1] != 0 && frame.data[1] != settings_.node)) return;
  switch (frame.data[0]) {
    case 1:
      enter(State::operational);
      break;
    case 2:
      enter(State::stopped);
      break;
    case 128:
      enter(State::pre_operational);
      break;
    case 129:
      initialise(true);
      break;
    case 130:
      if (state_ == State::operational) enter(State::pre_operational);
      initialise(false);
      break;
    default:
      break;
  }
}

void ForeignModule::enter(State next) {
  const State before = state_;
  if (next == before) return;
  state_ = next;
  if (next == State::operational) {
    syncs_ = 0;
    inhibited_until_ = clock_;
    event_timer_from_ = clock_;
    is_pending_ = settings_.sends_tpdo_at_start;
    if (settings_.returns_to_old_outputs) {
      in_error_ = {};
      for (std::size_t byte = 0; byte < settings_.output_bytes; ++byte) drive(byte);
    }
    return;
  }
  latched_.reset();
  is_pending_ = false;
  if (next == State::stopped) {
    upload_.reset();
    request_.reset();
    if (!settings_.keeps_outputs_when_stopped) take_error_values();
  } else if (before == State::operational && !settings_.keeps_outputs_when_paused) {
    take_error_values();
  }
}

std::uint8_t ForeignModule::state_byte() const {
  switch (state_) {
    case State::stopped:
      return 0x04;
    case State::operational:
      return 0x05;
    default:
      return 0x7F;
  }
}

void ForeignModule::heartbeat_from(std::uint8_t node) {
  for (std::size_t i = 0; i < consumers_.size(); ++i) {
    const std::uint32_t entry = at(0x1016, i + 1);
    if ((entry >> 16U & 0xFFU) != node || word_of(entry) == 0) continue;
    Consumer& consumer = consumers_[i];
    const bool is_back = consumer.is_lost;
    consumer = {.is_watching = true, .deadline = clock_ + milliseconds{word_of(entry)}};
    if (is_back) relieve();
  }
}

void ForeignModule::watch_heartbeats() {
  for (std::size_t i = 0; i < consumers_.size(); ++i) {
    Consumer& consumer = consumers_[i];
    if (!consumer.is_watching || consumer.is_lost || consumer.deadline > clock_) continue;
    consumer.is_lost = true;
    report(0x8130, static_cast<std::uint16_t>(at(0x1016, i + 1) >> 16U & 0xFFU));
    take_error_values();
    const std::uint32_t behaviour = value_or(0x1029, 1, 0);
    if (behaviour == 0 && state_ == State::operational) enter(State::pre_operational);
    if (behaviour == 2) enter(State::stopped);
  }
}

// ---- EMCY

void ForeignModule::report(std::uint16_t code, std::uint16_t information) {
  at(0x1001, 0) = 0x11;  // generic, communication
  std::uint32_t& count = at(0x1003, 0);
  count = std::min<std::uint32_t>(count + 1, history);
  for (std::size_t sub = count; sub > 1; --sub) at(0x1003, sub) = at(0x1003, sub - 1);
  at(0x1003, 1) = static_cast<std::uint32_t>(information) << 16U | code;
  say_emergency(code, information);
}

/// One fault is over: when it was the last, there is none any more.
void ForeignModule::relieve() {
  if (has_length_fault_) return;
  for (const Consumer& consumer : consumers_) {
    if (consumer.is_lost) return;
  }
  at(0x1001, 0) = 0;
  say_emergency(0, 0);
}

void ForeignModule::say_emergency(std::uint16_t code, std::uint16_t information) {
  const std::uint32_t cob_id = at(0x1014, 0);
  if (state_ == State::stopped || (cob_id & is_invalid) != 0) return;
  say(cob_id & can_id,
      {byte_of(code, 0), byte_of(code, 1), byte_of(at(0x1001, 0), 0), byte_of(information, 0),
       byte_of(information, 1), 0, 0, 0},
      8);
}

// ---- SDO

void ForeignModule::serve(const Data& request) {
  const auto index = static_cast<std::uint16_t>(request[1] | request[2] << 8U);
  const std::uint8_t sub = request[3];
  switch (request[0] >> 5U) {
    case 1:
      upload_.reset();
      download(request, index, sub);
      break;
    case 2:
      upload_.reset();
      upload(index, sub);
      break;
    case 3:
      upload_segment(request[0]);
      break;
    case 4:  // the client gives up
      upload_.reset();
      break;
    default:  // segments of a download, blocks
      upload_.reset();
      abort(index, sub, unknown_specifier);
      break;
  }
}

/// For something that is not there.
std::uint32_t ForeignModule::missing(std::uint16_t index) const {
  return has(index) ? no_sub_index : no_object;
}

void ForeignModule::upload(std::uint16_t index, std::uint8_t sub) {
  const auto found = objects_.find(key_of(index, sub));
  if (found == objects_.end()) {
    abort(index, sub, missing(index));
  } else if (index == 0x1003 && sub > at(0x1003, 0)) {
    abort(index, sub, no_data);
  } else if (const std::uint32_t size = found->second.size; size > 0) {
    answer(static_cast<std::uint8_t>(0x43U | (4 - size) << 2U), index, sub, found->second.value);
  } else {
    upload_ = Upload{.index = index, .sub = sub, .data = settings_.name};
    answer(0x41, index, sub, static_cast<std::uint32_t>(settings_.name.size()));
  }
}

void ForeignModule::upload_segment(std::uint8_t specifier) {
  if (!upload_) {
    abort(0, 0, unknown_specifier);
    return;
  }
  const auto toggle = static_cast<std::uint8_t>(specifier & 0x10U);
  if (toggle != upload_->toggle) {
    abort(upload_->index, upload_->sub, toggle_not_alternated);
    upload_.reset();
    return;
  }
  const std::size_t left = upload_->data.size() - upload_->sent;
  const std::size_t bytes = std::min<std::size_t>(left, 7);
  const bool is_last = bytes == left;
  Data segment{static_cast<std::uint8_t>(toggle | (7 - bytes) << 1U | (is_last ? 1U : 0U))};
  for (std::size_t i = 0; i < bytes; ++i) {
    segment[i + 1] = static_cast<std::uint8_t>(upload_->data[upload_->sent + i]);
  }
  say(0x580U + settings_.node, segment, 8);
  upload_->sent += bytes;
  upload_->toggle = static_cast<std::uint8_t>(toggle ^ 0x10U);
  if (is_last) upload_.reset();
}

/// Expedited only: no object that can be written here has more than four bytes.
void ForeignModule::download(const Data& request, std::uint16_t index, std::uint8_t sub) {
  const std::uint8_t specifier = request[0];
  if ((specifier & 0x02U) == 0) {
    abort(index, sub, unknown_specifier);
    return;
  }
  const std::uint32_t size = (specifier & 0x01U) != 0 ? 4U - (specifier >> 2U & 0x03U) : 0;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(request[4 + i]) << (8 * i);
  const std::uint32_t code = write(index, sub, size, value);
  if (code != done) {
    abort(index, sub, code);
    return;
  }
  answer(0x60, index, sub, 0);
  written(index, sub);
}

/// `size` 0: the client did not say it.
std::uint32_t ForeignModule::write(std::uint16_t index, std::uint8_t sub, std::uint32_t size,
                                   std::uint32_t value) {
  const auto found = objects_.find(key_of(index, sub));
  if (found == objects_.end()) return missing(index);
  Object& object = found->second;
  if (object.access == Access::read_only) return is_read_only;
  if (size != 0 && size != object.size) return wrong_length;
  if (object.size < 4) value &= (1U << (8U * object.size)) - 1U;
  const std::uint32_t code = check(index, sub, value);
  if (code == done) object.value = value;
  return code;
}

std::uint32_t ForeignModule::check(std::uint16_t index, std::uint8_t sub, std::uint32_t& value) {
  switch (index) {
    case 0x1003:
      return value == 0 ? done : invalid_value;
    case 0x1005:
      // It produces no SYNC (bit 30), and has eleven bits only.
      return (value & ~(is_invalid | can_id)) == 0 && !is_restricted(value & can_id) ? done : invalid_value;
    case 0x1014: {
      const std::uint32_t old = at(0x1014, 0);
      if ((value & ~(is_invalid | can_id)) != 0) return invalid_value;
      if ((old & is_invalid) == 0 && (value & is_invalid) == 0 && value != old) return wrong_state;
      return (value & is_invalid) == 0 && is_restricted(value & can_id) ? invalid_value : done;
    }
    case 0x1016:
      return check_consumer(sub, value);
    case 0x1029:
      return value <= 2 ? done : invalid_value;
    case 0x1400:
    case 0x1800:
      return check_pdo_parameter(index, sub, value);
    case 0x1600:
    case 0x1A00:
      return check_mapping(index, sub, value);
    case 0x6005:
      return value <= 1 ? done : invalid_value;
    default:
      return done;
  }
}

/// `value`: what is stored in its place.
std::uint32_t ForeignModule::check_pdo_parameter(std::uint16_t index, std::uint8_t sub,
                                                 std::uint32_t& value) {
  switch (sub) {
    case 1:
      return check_pdo_cob_id(index, value);
    case 2:
      // 252 and 253, sent upon a remote request only, are optional, and not here.
      return value <= 240 || value >= event_driven ? done : invalid_value;
    case 3:
      return is_valid(index) ? wrong_state : done;
    default:
      if (value == 0 || value >= settings_.least_event_timer) return done;
      if (!settings_.raises_event_timer) return value_too_low;
      value = settings_.least_event_timer;
      return done;
  }
}

std::uint32_t ForeignModule::check_pdo_cob_id(std::uint16_t index, std::uint32_t value) {
  const std::uint32_t old = at(index, 1);
  if (settings_.locks_cob_ids && state_ == State::operational) return wrong_state;
  if ((value & ~(is_invalid | no_remote_request | can_id)) != 0) return invalid_value;
  if (index == 0x1800 && settings_.refuses_remote_requests && (value & no_remote_request) == 0) {
    return invalid_value;
  }
  // While a PDO exists, bits 0 to 29 may not be changed.
  const bool disables = (value & is_invalid) != 0;
  const bool changes = ((value ^ old) & (is_extended | can_id)) != 0;
  if ((old & is_invalid) == 0 && changes && (!disables || settings_.keeps_disabled_cob_ids)) {
    return wrong_state;
  }
  return !disables && is_restricted(value & can_id) ? invalid_value : done;
}

/// CiA 301, how a mapping is changed: the PDO disabled, sub-index 0 set to 0, the entries, then their count.
std::uint32_t ForeignModule::check_mapping(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
  const bool is_receive = index == 0x1600;
  const Mapping direction = is_receive ? Mapping::receive : Mapping::transmit;
  if (is_valid(is_receive ? 0x1400 : 0x1800)) return wrong_state;
  if (sub > 0) {
    if (at(index, 0) != 0) return wrong_state;
    return value == 0 ? done : check_mapped(value, direction);
  }
  if (value > most_mapped) return pdo_too_long;
  std::uint32_t bits = 0;
  for (std::size_t entry = 1; entry <= value; ++entry) {
    const std::uint32_t mapped = at(index, entry);
    if (const std::uint32_t code = check_mapped(mapped, direction); code != done) return code;
    bits += mapped & 0xFFU;
  }
  return bits <= 64 ? done : pdo_too_long;
}

/// `entry`: index, sub-index and bits.
std::uint32_t ForeignModule::check_mapped(std::uint32_t entry, Mapping direction) const {
  const auto index = static_cast<std::uint16_t>(entry >> 16U);
  const std::uint32_t bits = entry & 0xFFU;
  if (dummy_bits(index) != 0) {
    return direction == Mapping::receive && (entry >> 8U & 0xFFU) == 0 && bits == dummy_bits(index)
               ? done
               : not_mappable;
  }
  const auto found = objects_.find(entry >> 8U);
  if (found == objects_.end()) return no_object;
  const Object& object = found->second;
  return object.mapping == direction && bits == 8U * object.size ? done : not_mappable;
}

std::uint32_t ForeignModule::check_consumer(std::uint8_t sub, std::uint32_t value) const {
  if (value >> 24U != 0) return invalid_value;
  const std::uint32_t node = value >> 16U;
  if (node == 0 || node > 127 || word_of(value) == 0) return done;  // not used
  for (std::size_t other = 1; other <= consumers_.size(); ++other) {
    const std::uint32_t entry = value_or(0x1016, other, 0);
    if (other != sub && entry >> 16U == node && word_of(entry) != 0) return incompatible;
  }
  return done;
}

void ForeignModule::written(std::uint16_t index, std::uint8_t sub) {
  switch (index) {
    case 0x1016: {
      Consumer& consumer = consumers_[sub - 1U];
      const bool was_lost = consumer.is_lost;
      consumer = {};
      if (was_lost) relieve();
      break;
    }
    case 0x1017:
      heartbeat_at_ = clock_;
      break;
    case 0x1800:
      restart_tpdo(sub);
      break;
    case 0x6200:
      in_error_[sub - 1U] = 0;
      drive(sub - 1U);
      break;
    case 0x6202:
    case 0x6208:
      drive(sub - 1U);
      break;
    default:
      break;
  }
}

void ForeignModule::abort(std::uint16_t index, std::uint8_t sub, std::uint32_t code) {
  answer(0x80, index, sub, code);
}

void ForeignModule::answer(std::uint8_t specifier, std::uint16_t index, std::uint8_t sub,
                           std::uint32_t data) {
  say(0x580U + settings_.node,
      {specifier, byte_of(index, 0), byte_of(index, 1), sub, byte_of(data, 0), byte_of(data, 1),
       byte_of(data, 2), byte_of(data, 3)},
      8);
}

// ---- PDO

/// 1400h or 1800h.
bool ForeignModule::is_valid(std::uint16_t communication) const {
  return (value_or(communication, 1, is_invalid) & is_invalid) == 0;
}

bool ForeignModule::is_event_driven() const {
  return state_ == State::operational && is_valid(0x1800) && value_or(0x1800, 2, 0) >= event_driven;
}

bool ForeignModule::is_silenced() const {
  return settings_.is_silent_without_them && value_or(0x6005, 0, 1) == 0;
}

/// Into the TPDO.
bool ForeignModule::is_mapped(std::uint16_t index, std::size_t sub) const {
  const std::uint32_t count = value_or(0x1A00, 0, 0);
  for (std::size_t entry = 1; entry <= count; ++entry) {
    if (value_or(0x1A00, entry, 0) >> 8U == key_of(index, sub)) return true;
  }
  return false;
}

void ForeignModule::receive_pdo(const CanFrame& frame) {
  const std::uint32_t count = at(0x1600, 0);
  if (state_ != State::operational || count == 0) return;
  std::uint32_t bits = 0;
  for (std::size_t entry = 1; entry <= count; ++entry) bits += at(0x1600, entry) & 0xFFU;
  if (8U * frame.length < bits) {
    // PDO not processed due to length error. What is too long has bytes that are for nobody.
    if (!has_length_fault_) {
      has_length_fault_ = true;
      report(0x8210, frame.length);
    }
    return;
  }
  if (has_length_fault_) {
    has_length_fault_ = false;
    relieve();
  }
  if (at(0x1400, 2) >= event_driven) {
    apply_pdo(frame.data);
  } else {
    latched_ = frame.data;
  }
}

void ForeignModule::apply_pdo(const Data& data) {
  const std::uint32_t count = at(0x1600, 0);
  std::size_t from = 0;
  for (std::size_t entry = 1; entry <= count; ++entry) {
    const std::uint32_t mapped = at(0x1600, entry);
    if (mapped >> 16U == 0x6200) set_output((mapped >> 8U & 0xFFU) - 1U, data[from]);
    from += (mapped & 0xFFU) / 8U;
  }
}

void ForeignModule::send_pdo() {
  is_pending_ = false;
  const std::uint32_t count = at(0x1A00, 0);
  if (state_ != State::operational || !is_valid(0x1800) || count == 0 || is_silenced()) return;
  Data data{};
  for (std::size_t entry = 1; entry <= count; ++entry) {
    data[entry - 1] = byte_of(objects_.at(at(0x1A00, entry) >> 8U).value, 0);
  }
  say(at(0x1800, 1) & can_id, data, static_cast<std::uint8_t>(count));
  inhibited_until_ = clock_ + at(0x1800, 3) * microseconds{100};
  event_timer_from_ = clock_;
}

void ForeignModule::synchronise() {
  if (state_ != State::operational) return;
  if (latched_) {
    apply_pdo(*latched_);
    latched_.reset();
  }
  const std::uint32_t type = at(0x1800, 2);
  if (type == 0) {
    if (is_pending_) send_pdo();
  } else if (type < event_driven && ++syncs_ >= type) {
    syncs_ = 0;
    send_pdo();
  }
}

/// Its communication parameter `sub` was written. An event that waits is not lost by another event timer.
void ForeignModule::restart_tpdo(std::uint8_t sub) {
  event_timer_from_ = clock_;
  if (sub > 2) return;
  syncs_ = 0;
  is_pending_ = sub == 1 && settings_.sends_tpdo_at_start;
}

// ---- Process

void ForeignModule::set_input(unsigned number, bool on) {
  const std::uint64_t bit = std::uint64_t{1} << (number - 1U);
  terminals_ = on ? terminals_ | bit : terminals_ & ~bit;
}

std::uint64_t ForeignModule::outputs() const {
  std::uint64_t levels = 0;
  for (std::size_t byte = 0; byte < settings_.output_bytes; ++byte) {
    levels |= static_cast<std::uint64_t>(pins_[byte]) << (8 * byte);
  }
  return levels;
}

bool ForeignModule::is_filtered(std::size_t input) const {
  return (value_or(0x6003, input / 8 + 1, 0) >> (input % 8) & 1U) != 0;
}

/// Terminals, filter, polarity, 6000h, and whether the TPDO is due.
void ForeignModule::scan() {
  for (std::size_t input = 0; input < 8 * settings_.input_bytes; ++input) {
    const std::uint64_t bit = std::uint64_t{1} << input;
    std::optional<Time>& since = differs_since_[input];
    if (((terminals_ ^ settled_) & bit) == 0) {
      since.reset();
      continue;
    }
    if (is_filtered(input)) {
      if (!since) since = clock_;
      if (clock_ - *since < settings_.filter_time) continue;
    }
    since.reset();
    settled_ ^= bit;
  }
  for (std::size_t byte = 0; byte < settings_.input_bytes; ++byte) {
    change_inputs(byte, byte_of(settled_ ^ std::uint64_t{value_or(0x6002, byte + 1, 0)} << (8 * byte), byte));
  }
}

void ForeignModule::change_inputs(std::size_t byte, std::uint8_t fresh) {
  std::uint32_t& held = at(0x6000, byte + 1);
  const std::uint32_t changed = held ^ fresh;
  held = fresh;
  if (changed == 0 || state_ != State::operational || !is_valid(0x1800) || !is_mapped(0x6000, byte + 1))
    return;
  if (settings_.has_interrupt_masks) {
    const std::uint32_t interrupts = (changed & at(0x6006, byte + 1)) |
                                     (changed & fresh & at(0x6007, byte + 1)) |
                                     (changed & ~std::uint32_t{fresh} & at(0x6008, byte + 1));
    if (at(0x6005, 0) == 0 || interrupts == 0) return;
  }
  is_pending_ = true;
}

void ForeignModule::set_output(std::size_t byte, std::uint32_t levels) {
  at(0x6200, byte + 1) = levels;
  in_error_[byte] = 0;
  drive(byte);
}

/// 6200h, polarity, filter mask; what shows its error value keeps it.
void ForeignModule::drive(std::size_t byte) {
  const std::uint32_t wanted = at(0x6200, byte + 1) ^ value_or(0x6202, byte + 1, 0);
  const std::uint32_t free = value_or(0x6208, byte + 1, 0xFF) & ~std::uint32_t{in_error_[byte]};
  pins_[byte] = byte_of((pins_[byte] & ~free) | (wanted & free), 0);
}

/// CiA 401: behind polarity, so that an error value is the level itself. What has none stays as it is.
void ForeignModule::take_error_values() {
  for (std::size_t byte = 0; byte < settings_.output_bytes; ++byte) {
    const std::uint32_t mode = value_or(0x6206, byte + 1, 0xFF);
    const std::uint32_t levels = value_or(0x6207, byte + 1, 0);
    in_error_[byte] = byte_of(in_error_[byte] | mode, 0);
    pins_[byte] = byte_of((pins_[byte] & ~mode) | (levels & mode), 0);
  }
}

// ---- ForeignModuleNode

void ForeignModuleNode::on_frame(const CanFrame& frame, CanPort& port) noexcept {
  module_.hear(frame, frame.time);
  collect(frame.time, port);
}

/// It looks at its terminals every millisecond.
Time ForeignModuleNode::next_event() const noexcept {
  return std::min(module_.next_event(), now_ + milliseconds{1});
}

void ForeignModuleNode::on_time(Time now, CanPort& port) noexcept {
  if (!was_attached_) module_.power_on(now);
  was_attached_ = true;
  collect(now, port);
}

/// What finds no place in the controller's queue is lost, as from a module whose bus is broken.
void ForeignModuleNode::collect(Time now, CanPort& port) {
  now_ = now;
  for (const CanFrame& frame : module_.step(now)) port.send(frame);
}

}  // namespace flexrf
