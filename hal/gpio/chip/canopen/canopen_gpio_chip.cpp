#include "hal/gpio/chip/canopen/canopen_gpio_chip.hpp"

#include <bit>
#include <charconv>

#include "hal/canopen/can_message.hpp"

namespace flexrf {
namespace {

// What is said again and again, and only the newest counts.
bool is_cyclic(const canopen::Message& message) {
  return message.identifier == canopen::sync_identifier ||
         (message.identifier & 0x780) == canopen::heartbeat_base;
}

}  // namespace

CanopenGpioChip::CanopenGpioChip() {
  for (unsigned i = 0; i < lines_of_direction; ++i) {
    inputs_[i].place(image_, LineDirection::input, i);
    outputs_[i].place(image_, LineDirection::output, i);
  }
}

Status CanopenGpioChip::initialise() {
  stop();
  const auto& from = configuration;
  plan_ = {.node = from.node,
           .master = from.master,
           .vendor = from.vendor,
           .product = from.product,
           .input_bytes = from.input_bytes,
           .output_bytes = from.output_bytes,
           .refresh = canopen::whole_milliseconds(from.refresh),
           .tells_error_values = from.tells_error_values,
           .is_supervised_by_it = from.supervises_us,
           .forbids_remote = from.forbids_remote,
           .is_guarded = from.guarded,
           .boot_timeout = canopen::whole_milliseconds(from.boot_timeout),
           .sdo_timeout = canopen::whole_milliseconds(from.sdo_timeout),
           .heartbeat_period = canopen::whole_milliseconds(from.heartbeat_period),
           .heartbeat_limit = canopen::whole_milliseconds(from.heartbeat_limit)};
  // Tried here, for its errors; begun in the first cycle, whose time counts.
  if (const Status status = module_.begin(plan_, safe_, Time{}, outbox_); !status) return status;
  outbox_.clear();
  const std::uint8_t node = plan_.node;
  const CanIdentifier heard[] = {
      {canopen::identifier_of(canopen::emergency_base, node)},
      {canopen::transmit_pdo_identifier(1, node)},
      {canopen::identifier_of(canopen::sdo_answer_base, node)},
      {canopen::identifier_of(canopen::heartbeat_base, node)},
  };
  if (const Status status = bus->claim_node(node, name()); !status) return status;
  if (const Status status = bus->open(inbox_, heard, 64); !status) return status;
  last_word_ = bus->claim_last_word();
  const std::lock_guard lock(mutex_);
  open_ = true;
  return {};
}

// No message: the thread that could send it no longer steps. Without our heartbeat the module brings its
// outputs to their safe values.
void CanopenGpioChip::stop() {
  const std::lock_guard lock(mutex_);
  if (open_) {
    bus->close(inbox_);
    bus->release_last_word(last_word_);
  }
  bus->release_node(name());  // also after an initialise() that failed behind it
  open_ = began_ = false;
  last_word_ = CanBus::no_last_word;
  outbox_.clear();
  image_ = {};
  sent_.reset();
}

void CanopenGpioChip::receive(const Tick& tick) noexcept {
  const std::uint64_t safe = safe_.load(std::memory_order_acquire);
  if (!began_ || safe != safe_told_) {
    began_ = module_.begin(plan_, safe, tick.now, outbox_).is_ok();
    safe_told_ = safe;
  }
  while (const CanFrame* frame = inbox_.take()) {
    if (frame->extended || frame->remote) continue;
    pass_on(module_.receive(canopen::to_message(*frame), tick.now, outbox_), frame->time);
  }
  module_.look(bus->is_usable(), tick.now);
  renew_image();
  confirm_outputs(tick.now);
  tell();
}

void CanopenGpioChip::pass_on(std::uint64_t changed, Time at) noexcept {
  for (; changed != 0; changed &= changed - 1) {
    IoLine& line = inputs_[static_cast<std::size_t>(std::countr_zero(changed))];
    line.change((*module_.inputs() & line.bit()) != 0, at);
  }
}

void CanopenGpioChip::renew_image() noexcept {
  image_.inputs = module_.inputs();
  if (!module_.is_there()) {
    image_.outputs.reset();
    sent_.reset();
    return;
  }
  const std::uint64_t renewed = renewed_.exchange(0, std::memory_order_acq_rel);
  const std::uint64_t before = image_.outputs.value_or(safe_told_);
  image_.outputs = (before & ~renewed) | (safe_told_ & renewed);
}

// While a line asks for it.
void CanopenGpioChip::confirm_outputs(Time now) noexcept {
  image_.are_confirmed = image_.asks && image_.outputs && sent_ == image_.outputs &&
                         module_.has_outputs(*image_.outputs, now, outbox_);
  image_.asks = false;
}

void CanopenGpioChip::tell() noexcept {
  const bool present = module_.is_there() && module_.inputs();
  feedback.lines = requested_.load(std::memory_order_relaxed);
  if (feedback.present && !present) feedback.losses += feedback.lines;
  feedback.present = present;
  const Status& trouble = module_.trouble();
  if (feedback.trouble[0] != '\0' || !trouble.is_ok())
    feedback.set_trouble(trouble.is_ok() ? "" : trouble.cause());
  const canopen::Node& node = module_.node();
  if (const auto& emergency = node.emergency(); node.emergencies() != logged_emergencies_) {
    logged_emergencies_ = node.emergencies();
    if (emergency)
      log_warning(emergencies_, name(), "node {} says: {} ({:x})", unsigned{plan_.node},
                  canopen::describe_error_code(emergency->code), unsigned{emergency->code});
  }
  // What the module says of itself was told already.
  const StatusCode code =
      trouble.code() == StatusCode::device_fault && present ? StatusCode::ok : trouble.code();
  if (module_.is_coming() || code == logged_) return;
  logged_ = code;
  if (code == StatusCode::ok) {
    log_warning(ends_, name(), "the lines of node {} are there again", unsigned{plan_.node});
  } else {
    log_warning(begins_, name(), "{}", trouble.cause());
  }
}

void CanopenGpioChip::send(const Tick& tick) noexcept {
  module_.send(tick.now, outbox_);
  for (; !outbox_.is_empty(); outbox_.pop()) {
    const canopen::Message& message = outbox_.front();
    // What the bus refuses is not kept: the protocol's own time-outs ask again, with what is true then.
    if (is_cyclic(message)) {
      bus->post(canopen::to_frame(message));
    } else {
      bus->queue(canopen::to_frame(message));
    }
  }
  if (image_.outputs) tell_outputs(tick.now);
}

// Each value is said, in order, and the last one again with each heartbeat.
void CanopenGpioChip::tell_outputs(Time now) noexcept {
  const auto message = module_.outputs(*image_.outputs);
  if (!message) return;
  const bool is_due = sent_ != image_.outputs || now - sent_at_ >= plan_.heartbeat_period;
  if (is_due && bus->queue(canopen::to_frame(*message))) {
    if (sent_ != image_.outputs) module_.forget_outputs();
    sent_ = image_.outputs;
    sent_at_ = now;
  }
  if (last_word_ < 0) return;
  bus->prepare_last_word(last_word_, canopen::to_frame(*module_.outputs(safe_told_)),
                         canopen::to_frame({canopen::sync_identifier, 0, {}}));
}

// DI1, DI2, ... and DO1, DO2, ...: counted from 1, as CiA 401 does. Null: no such line.
IoLine* CanopenGpioChip::find(std::string_view line) noexcept {
  const bool is_input = line.starts_with("DI");
  if (!is_input && !line.starts_with("DO")) return nullptr;
  line.remove_prefix(2);
  unsigned number = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  const unsigned bytes = is_input ? plan_.input_bytes : plan_.output_bytes;
  if (error != std::errc() || end != line.data() + line.size() || line.starts_with('0') || number == 0 ||
      number > 8 * bytes)
    return nullptr;
  return &(is_input ? inputs_ : outputs_)[number - 1];
}

Status CanopenGpioChip::check(const GpioLineSettings& settings, const IoLine& line) const {
  if (line.is_output() != (settings.direction == LineDirection::output)) {
    return Status::error(StatusCode::invalid_argument, "line %s of %s is an %s: set configuration.direction",
                         settings.name, name(), line.is_output() ? "output" : "input");
  }
  if (settings.bias == LineBias::pull_up || settings.bias == LineBias::pull_down) {
    return Status::error(
        StatusCode::invalid_argument,
        "line %s of %s has no bias that could be set; leave configuration.bias as it is, and see "
        "to the wiring",
        settings.name, name());
  }
  const std::uint64_t taken = line.is_output() ? taken_outputs_ : taken_inputs_;
  if ((taken & line.bit()) != 0) {
    return Status::error(StatusCode::busy, "line %s of %s is in use by another device", settings.name,
                         name());
  }
  return {};
}

Result<GpioLine*> CanopenGpioChip::request(const GpioLineSettings& settings) {
  const std::lock_guard lock(mutex_);
  if (!open_) {
    return Status::error(StatusCode::unavailable, "%s, which has line %s, is stopped; initialise it first",
                         name(), settings.name);
  }
  IoLine* const line = find(settings.name);
  if (line == nullptr) {
    return Status::error(
        StatusCode::not_found,
        "%s has no line named %s: it has %u inputs, DI1, DI2, ..., and %u outputs, DO1, DO2, ..., as "
        "input_bytes and output_bytes say",
        name(), settings.name, 8U * plan_.input_bytes, 8U * plan_.output_bytes);
  }
  if (const Status status = check(settings, *line); !status) return status;
  line->configure(settings.active_low);
  if (line->is_output()) {
    taken_outputs_ |= line->bit();
    if (settings.initially_on != settings.active_low) {
      safe_.fetch_or(line->bit(), std::memory_order_acq_rel);
    } else {
      safe_.fetch_and(~line->bit(), std::memory_order_acq_rel);
    }
    renewed_.fetch_or(line->bit(), std::memory_order_acq_rel);
  } else {
    taken_inputs_ |= line->bit();
  }
  requested_.fetch_add(1, std::memory_order_relaxed);
  return static_cast<GpioLine*>(line);
}

void CanopenGpioChip::release(GpioLine* line) noexcept {
  const std::lock_guard lock(mutex_);
  for (IoLine& one : inputs_) {
    if (&one != line || (taken_inputs_ & one.bit()) == 0) continue;
    taken_inputs_ &= ~one.bit();
    requested_.fetch_sub(1, std::memory_order_relaxed);
  }
  for (IoLine& one : outputs_) {
    if (&one != line || (taken_outputs_ & one.bit()) == 0) continue;
    taken_outputs_ &= ~one.bit();
    renewed_.fetch_or(one.bit(), std::memory_order_acq_rel);
    requested_.fetch_sub(1, std::memory_order_relaxed);
  }
}

}  // namespace flexrf
