#include "hal/modbus/link/interface/modbus_master.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "hal/modbus/link/interface/modbus_exchange.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

// What a station refuses is asked again no sooner, however short its period.
constexpr Duration refused_pause = std::chrono::milliseconds(100);

// Of what a step may take: the rest is for all else that it does, and for a machine with other things to do.
constexpr double part_of_step = 0.9;

void publish(ModbusExchange& exchange, Time now) noexcept {
  exchange.image_output.publish(exchange.link.image, now);
  exchange.link.touched = false;
}

/// It may have been switched off: nothing is known of what it holds. Who listens first knows that itself, and
/// is not written to again.
void forget_written(ModbusExchange& exchange) noexcept {
  ModbusExchange::LinkSide& side = exchange.link;
  side.written.assign(side.written.size(), false);
  side.safe = false;
  if (!exchange.setup.listens_first) side.image.written = 0;
}

}  // namespace

ModbusMaster::ModbusMaster() noexcept = default;
ModbusMaster::~ModbusMaster() = default;

Result<ModbusExchange*> ModbusMaster::attach(const ModbusStationSetup& setup) {
  for (const auto& other : owned_) {
    if (other == nullptr || other->state.load(std::memory_order_acquire) != ModbusExchange::State::active ||
        other->setup.unit_id != setup.unit_id)
      continue;
    return Status::error(
        StatusCode::invalid_argument,
        "unit %d on this link is that of `%s` already: give each station its own unit_id, as it is set "
        "on the device",
        int{setup.unit_id}, other->setup.name);
  }
  for (std::size_t i = 0; i < max_stations; ++i) {
    if (owned_[i] != nullptr &&
        owned_[i]->state.load(std::memory_order_acquire) != ModbusExchange::State::free)
      continue;
    if (owned_[i] == nullptr) owned_[i] = std::make_unique<ModbusExchange>();
    ModbusExchange& exchange = *owned_[i];
    exchange.setup = setup;
    if (const Status status = plan_requests(*setup.map, setup.most_registers, exchange.plan); !status)
      return status;
    if (const Status status = check_waits(exchange); !status) return status;
    exchange.link = {};
    exchange.link.writes_multiple = setup.writes_multiple;
    exchange.link.written.assign(exchange.plan.writes.size(), false);
    exchange.link.write_due.assign(exchange.plan.writes.size(), Time{});
    exchange.link.read_due.assign(exchange.plan.reads.size(), Time{});
    // Neither side shall find what the station before it left.
    exchange.image_output.publish(ModbusImage{}, Time{});
    exchange.commands.publish(ModbusCommand{}, Time{});
    exchange.state.store(ModbusExchange::State::active, std::memory_order_release);
    exchanges_[i].store(&exchange, std::memory_order_release);
    return &exchange;
  }
  return Status::error(StatusCode::busy,
                       "the link carries %zu stations already, or its thread does not run: put this one on "
                       "another link",
                       max_stations);
}

Status ModbusMaster::check_waits(const ModbusExchange& exchange) const noexcept {
  if (transport_ == nullptr || longest_turn_ <= Duration{}) return {};
  for (const bool writes : {false, true}) {
    for (const ModbusBlock& block : writes ? exchange.plan.writes : exchange.plan.reads) {
      const Duration wait = transport_->longest_wait(block, writes);
      if (wait <= longest_turn_) continue;
      return Status::error(
          StatusCode::invalid_argument,
          "%s %s %d to %d of unit %d may take %.3g s, its response_timeout and its time on the line, and a "
          "step of "
          "the thread of `%s` %.3g s: give it io_thread = { hang_timeout = \"%lld ms\" } or more",
          writes ? "writing" : "reading", name_of(block.area), int{block.address},
          block.address + block.count - 1, int{exchange.setup.unit_id}, seconds(wait), name_,
          seconds(longest_turn_), static_cast<long long>(std::ceil(seconds(wait) / part_of_step * 1e3)));
    }
  }
  return {};
}

void ModbusMaster::detach(ModbusExchange& exchange) noexcept {
  exchange.state.store(ModbusExchange::State::leaving, std::memory_order_release);
}

Status ModbusMaster::start(const char* name, ModbusTransport& transport, Pauses pauses,
                           Duration longest_step) noexcept {
  name_ = name;
  transport_ = &transport;
  shortest_ = pauses.shortest;
  longest_ = std::max(pauses.shortest, pauses.longest);
  after_connecting_ = pauses.after_connecting;
  longest_turn_ = std::chrono::duration_cast<Duration>(part_of_step * longest_step);
  open_at_ = Time{};
  ready_at_ = Time{};
  open_failures_ = 0;
  last_error_ = {};
  note_lost();
  for (const auto& entry : exchanges_) {
    const ModbusExchange* exchange = entry.load(std::memory_order_acquire);
    if (exchange == nullptr ||
        exchange->state.load(std::memory_order_acquire) != ModbusExchange::State::active)
      continue;
    if (Status status = check_waits(*exchange); !status) return status;
  }
  return {};
}

void ModbusMaster::stop() noexcept {
  if (transport_ != nullptr) transport_->close();
}

Duration ModbusMaster::pause_after(std::uint32_t failures) const noexcept {
  const std::uint32_t doublings = std::min<std::uint32_t>(failures > 0 ? failures - 1 : 0, 10);
  return std::min(longest_, shortest_ * (std::int64_t{1} << doublings));
}

bool ModbusMaster::open() noexcept {
  if (transport_->is_open()) return true;
  if (transport_->now() < open_at_) return false;
  turn_is_new_ = false;
  const Status status = transport_->open();
  if (!status) {
    // Said once, not at every attempt.
    if (open_failures_ == 0) log_warning(name_, "{}", status.cause());
    last_error_ = status;
    open_at_ = transport_->now() + pause_after(++open_failures_);
    return false;
  }
  if (connections_ > 0 && open_failures_ > 0) log_info(name_, "open again");
  open_failures_ = 0;
  ++connections_;
  ready_at_ = transport_->now() + after_connecting_;
  return true;
}

/// Who comes back may have been switched off meanwhile: it is written everything again.
void ModbusMaster::note_lost() noexcept {
  for (auto& entry : exchanges_) {
    ModbusExchange* exchange = entry.load(std::memory_order_acquire);
    if (exchange == nullptr ||
        exchange->state.load(std::memory_order_acquire) != ModbusExchange::State::active)
      continue;
    forget_written(*exchange);
    exchange->link.image.online = false;
    publish(*exchange, transport_->now());
  }
}

/// The first request of a turn always: each of them alone fits, as was checked.
bool ModbusMaster::has_time_for(const ModbusBlock& block, bool writes) noexcept {
  const bool first = std::exchange(turn_is_new_, false);
  const Duration gone = transport_->now() - turn_began_;
  out_of_time_ =
      longest_turn_ > Duration{} && !first && gone + transport_->longest_wait(block, writes) > longest_turn_;
  return !out_of_time_;
}

void ModbusMaster::serve() noexcept {
  turn_began_ = transport_->now();
  turn_is_new_ = true;
  // After that one goes on in a ring, so that nobody is kept from a turn by those who answer.
  const bool goes_round = std::exchange(out_of_time_, false);
  const bool is_open = open() && transport_->now() >= ready_at_;
  // Who answered last comes first: those who did not may take a whole response timeout, and end the turn.
  for (const bool failing : {false, true}) {
    for (std::size_t n = 0; n < max_stations; ++n) {
      const std::size_t i = (first_ + n) % max_stations;
      ModbusExchange* exchange = exchanges_[i].load(std::memory_order_acquire);
      if (exchange == nullptr) continue;
      const ModbusExchange::State state = exchange->state.load(std::memory_order_acquire);
      if (state == ModbusExchange::State::leaving)
        exchange->state.store(ModbusExchange::State::free, std::memory_order_release);
      if (state != ModbusExchange::State::active || !is_open) continue;
      const bool has_failed = exchange->link.failures > 0 || exchange->link.write_failures > 0;
      if (failing != (has_failed && !goes_round)) continue;
      const bool goes_on = serve_station(*exchange);
      if (exchange->link.touched) publish(*exchange, transport_->now());
      if (goes_on) continue;
      first_ = (i + (out_of_time_ ? 0 : 1)) % max_stations;
      return;
    }
  }
}

bool ModbusMaster::serve_station(ModbusExchange& exchange) noexcept {
  ModbusExchange::LinkSide& side = exchange.link;
  if (transport_->now() < side.retry_at) return true;
  // A turn that ran out of time before its readings, or whose writing failed, is followed by one that reads
  // only: what is written in every turn must not keep the readings for ever.
  if (!std::exchange(side.reads_first, false) && !write_what_is_due(exchange)) return false;
  return read_what_is_due(exchange);
}

bool ModbusMaster::write_what_is_due(ModbusExchange& exchange) noexcept {
  ModbusExchange::LinkSide& side = exchange.link;
  if (exchange.command_reader.newest() == nullptr) return true;
  const auto& command = *static_cast<const ModbusCommand*>(exchange.command_reader.payload());
  if (command.sequence == 0) return true;
  if (exchange.setup.listens_first && (!side.image.online || command.sequence <= side.stale)) return true;
  // Safe values are tried at once, whatever failed before them.
  if (transport_->now() < side.write_at && (!command.safe || side.safe_has_failed)) return true;
  bool all_written = true;
  const std::size_t count = exchange.plan.writes.size();
  const std::size_t first = std::exchange(side.next_write, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const ModbusBlock& block = exchange.plan.writes[i];
    const std::uint16_t* words = &command.words[block.offset];
    const std::size_t bytes = block.count * sizeof(std::uint16_t);
    const bool changed = std::memcmp(words, &side.sent[block.offset], bytes) != 0;
    if (i < first) {  // had its turn before time ran out
      all_written = all_written && side.written[i] && !changed;
      continue;
    }
    const Time now = transport_->now();
    const bool waited = now >= side.write_due[i];
    const bool again = block.refreshed && exchange.setup.refresh_period > Duration{} && waited;
    if (!changed && side.written[i] && !again) continue;
    if (!changed && !side.written[i] && !waited) {  // refused a moment ago
      all_written = false;
      continue;
    }
    if (!has_time_for(block, true)) {
      side.next_write = i;
      return false;
    }
    side.written[i] = false;
    std::memcpy(&side.sent[block.offset], words, bytes);
    const ModbusReply reply = transport_->write(exchange.setup.unit_id, block, words, side.writes_multiple);
    if (!judge(exchange, block, true, reply, now)) {
      side.safe_has_failed = command.safe;
      return false;
    }
    side.written[i] = reply.outcome == ModbusOutcome::answered;
    if (block.count == 1 && reply.is_of_unknown_function() && !exchange.setup.writes_multiple) {
      // The other one is tried next: a station may know but one of the two.
      side.writes_multiple = !side.writes_multiple;
      log_info(exchange.setup.name, "single values are written by the functions {} from now on",
               side.writes_multiple ? "15 and 16" : "5 and 6");
    }
    side.write_due[i] = transport_->now() + (side.written[i] ? exchange.setup.refresh_period : refused_pause);
    all_written = all_written && side.written[i];
  }
  side.safe = all_written && command.safe;
  const std::uint64_t written = all_written ? command.sequence : 0;
  side.touched = side.touched || side.image.written != written;
  side.image.written = written;
  return true;
}

bool ModbusMaster::read_what_is_due(ModbusExchange& exchange) noexcept {
  ModbusExchange::LinkSide& side = exchange.link;
  const std::size_t count = exchange.plan.reads.size();
  for (std::size_t i = std::exchange(side.next_read, 0); i < count; ++i) {
    const ModbusBlock& block = exchange.plan.reads[i];
    const Time now = transport_->now();
    if (now < side.read_due[i]) continue;
    if (!has_time_for(block, false)) {
      side.next_read = i;
      side.reads_first = true;
      return false;
    }
    std::array<std::uint16_t, 2000> words{};
    const ModbusReply reply = transport_->read(exchange.setup.unit_id, block, words.data());
    if (!judge(exchange, block, false, reply, now)) return false;
    const bool is_once = block.group == ModbusPollGroup::once;
    const Duration period =
        is_once ? Duration{} : exchange.setup.poll_periods[static_cast<std::size_t>(block.group)];
    const bool answered = reply.outcome == ModbusOutcome::answered;
    side.image.refused[i] = !answered;
    // In step with the clock, unless that is more than a period behind.
    const Time next = side.read_due[i] + period;
    side.read_due[i] = next > now ? next : now + period;
    if (!answered) {
      side.read_due[i] = now + std::max(period, refused_pause);
      continue;
    }
    std::copy_n(words.data(), block.count, &side.image.words[block.offset]);
    side.image.sampled_at[i] = nanoseconds(transport_->now());
    if (is_once) side.read_due[i] = Time::max();
  }
  return true;
}

bool ModbusMaster::judge(ModbusExchange& exchange, const ModbusBlock& block, bool writes,
                         const ModbusReply& reply, Time asked) noexcept {
  ModbusExchange::LinkSide& side = exchange.link;
  ++requests_;
  ++side.image.requests;
  side.touched = true;
  if (reply.outcome != ModbusOutcome::answered) {
    const int last = block.address + block.count - 1;
    std::array<char, 192> text{};
    std::snprintf(text.data(), text.size(), "%s %s %d to %d of unit %d: %s", writes ? "writing" : "reading",
                  name_of(block.area), int{block.address}, last, int{exchange.setup.unit_id}, reply.cause);
    side.image.set_last_error(text.data());
  }
  if (reply.outcome == ModbusOutcome::answered || reply.outcome == ModbusOutcome::exception) {
    if (reply.outcome == ModbusOutcome::exception && ++side.image.exceptions == 1)
      log_warning(exchange.setup.name, "{}", side.image.last_error_view());
    side.image.round_trip = (transport_->now() - asked).count();
    note_answer(exchange, writes);
    return true;
  }
  fail(exchange, reply, writes);
  return false;
}

void ModbusMaster::note_answer(ModbusExchange& exchange, bool writes) noexcept {
  ModbusExchange::LinkSide& side = exchange.link;
  if (writes && std::exchange(side.write_failures, 0) > 0)
    log_info(exchange.setup.name, "answers writing again");
  if (!side.image.online) {
    if (side.failures > 0) log_info(exchange.setup.name, "answers again");
    // An answer to a reading: nothing is being written to who listens first and is not heard.
    if (exchange.setup.listens_first && exchange.command_reader.newest() != nullptr)
      side.stale = static_cast<const ModbusCommand*>(exchange.command_reader.payload())->sequence;
  }
  side.image.online = true;
  side.failures = 0;
}

void ModbusMaster::fail(ModbusExchange& exchange, const ModbusReply& reply, bool writes) noexcept {
  ModbusExchange::LinkSide& side = exchange.link;
  forget_written(exchange);
  side.write_due.assign(side.write_due.size(), Time{});
  const bool is_read = !exchange.plan.reads.empty();
  if (writes) side.reads_first = is_read;
  // A station that answers readings stays online while writing fails, and is read on. One that listens first
  // may have been switched off, though: it must not be told again what it was told before.
  const bool goes_on = writes && is_read && side.failures == 0 && !exchange.setup.listens_first &&
                       reply.outcome != ModbusOutcome::lost;
  std::uint32_t& failures = goes_on ? side.write_failures : side.failures;
  if (failures++ == 0) log_warning(exchange.setup.name, "{}", side.image.last_error_view());
  if (goes_on) {
    side.write_at = transport_->now() + pause_after(failures);
  } else {
    side.image.online = false;
  }
  if (reply.outcome == ModbusOutcome::lost) {
    ++side.image.lost;
    last_error_ = Status::error(StatusCode::unavailable, "%s", reply.cause);
    transport_->close();
    open_at_ = transport_->now() + pause_after(++open_failures_);
    note_lost();
    return;
  }
  ++(reply.outcome == ModbusOutcome::bad_reply ? side.image.bad_replies : side.image.timeouts);
  if (!goes_on) side.retry_at = transport_->now() + pause_after(failures);
  if (reply.outcome == ModbusOutcome::unreachable) return;  // answered in its place: nothing is to come
  transport_->resynchronise();
  if (!transport_->is_open()) note_lost();
}

bool ModbusMaster::is_safe() const noexcept {
  return std::all_of(exchanges_.begin(), exchanges_.end(), [](const auto& entry) {
    const ModbusExchange* exchange = entry.load(std::memory_order_acquire);
    return exchange == nullptr ||
           exchange->state.load(std::memory_order_acquire) != ModbusExchange::State::active ||
           exchange->plan.writes.empty() || exchange->setup.listens_first || exchange->link.safe;
  });
}

}  // namespace flexrf
