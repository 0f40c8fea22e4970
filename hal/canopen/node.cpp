#include "hal/canopen/node.hpp"

#include "hal/canopen/sdo_abort.hpp"

namespace flexrf::canopen {
namespace {

using Act = ConfigurationStep::Act;

// A node that starts itself does so once after its boot-up, or each time that it is brought back.
constexpr unsigned most_brought_back = 8;

bool cannot_be_written(std::uint32_t code) {
  return code == sdo_abort::read_only || code == sdo_abort::access;
}

long long milliseconds_of(Duration duration) {
  return static_cast<long long>(duration.count() / 1'000'000);
}

}  // namespace

const char* name_of(NodeState state) noexcept {
  switch (state) {
    case NodeState::off:
      return "off";
    case NodeState::awaited:
      return "awaited";
    case NodeState::configuring:
      return "configuring";
    case NodeState::starting:
      return "starting";
    case NodeState::operational:
      return "operational";
    case NodeState::refused:
      return "refused";
  }
  return "unknown";
}

void Node::receive(const Message& message, Time now, Outbox& outbox) noexcept {
  if (state_ == NodeState::off) return;
  if (const auto heard = heartbeat_of(message, plan_.node)) {
    if (*heard == NmtState::boot_up || !is_repeated(message)) observe(*heard, now, outbox);
  } else if (const auto emergency = emergency_of(message, plan_.node)) {
    ++emergencies_;
    if (emergency->is_reset()) {
      emergency_.reset();
    } else {
      emergency_ = emergency;
    }
  } else {
    client_.receive(message, now, outbox);
    if (state_ == NodeState::configuring) configure(now, outbox);
  }
}

void Node::advance(Time now, Outbox& outbox) noexcept {
  client_.advance(now, outbox);
  const bool is_started = state_ == NodeState::starting || state_ == NodeState::operational;
  if (plan_.is_guarded && is_started && guard_.is_due(now)) outbox.push(guard_message(plan_.node));
  switch (state_) {
    case NodeState::off:
    case NodeState::refused:
      return;
    case NodeState::awaited:
      if (now <= deadline_) return;
      if (problem_.is_ok()) {
        problem_ = Status::error(StatusCode::timeout,
                                 "node %u does not say boot-up within %lld ms: is it powered, is this its "
                                 "number, does the bit rate fit?",
                                 unsigned{plan_.node}, milliseconds_of(plan_.boot_timeout));
      }
      ask_to_boot(now, outbox);
      return;
    case NodeState::configuring:
      configure(now, outbox);
      return;
    case NodeState::starting:
      if (now <= deadline_) return;
      begin_again(
          Status::error(StatusCode::timeout, "node %u was started and is not operational after %lld ms",
                        unsigned{plan_.node}, milliseconds_of(plan_.start_timeout)),
          now, outbox);
      return;
    case NodeState::operational:
      if (!heartbeat_.is_lost(now)) return;
      ++silences_;
      problem_ = Status::error(StatusCode::unavailable,
                               "no %s of node %u for %lld ms: is it powered, is the cable in?",
                               plan_.is_guarded ? "answer to guarding" : "heartbeat", unsigned{plan_.node},
                               milliseconds_of(plan_.heartbeat_limit));
      if (plan_.grace == Duration{}) {
        ask_to_boot(now, outbox);
      } else {
        state_ = NodeState::awaited;
        deadline_ = now + plan_.grace;
      }
      return;
  }
}

void Node::end(Outbox& outbox) noexcept {
  if (state_ == NodeState::off) return;
  client_.cancel(outbox);
  outbox.push(nmt_message(NmtCommand::enter_pre_operational, plan_.node));
  state_ = NodeState::off;
}

void Node::ask_to_boot(Time now, Outbox& outbox) noexcept {
  outbox.push(nmt_message(NmtCommand::reset_communication, plan_.node));
  state_ = NodeState::awaited;
  deadline_ = now + plan_.boot_timeout;
}

void Node::begin_again(const Status& problem, Time now, Outbox& outbox) noexcept {
  problem_ = problem;
  ask_to_boot(now, outbox);
}

void Node::refuse(const Status& problem) noexcept {
  problem_ = problem;
  state_ = NodeState::refused;
}

// An answer with the toggle bit of the one before counts as none (CiA 301).
bool Node::is_repeated(const Message& answer) noexcept {
  if (!plan_.is_guarded) return false;
  const bool before = toggle_;
  toggle_ = toggle_of(answer);
  return toggle_ == before;
}

void Node::observe(NmtState heard, Time now, Outbox& outbox) noexcept {
  if (heard == NmtState::boot_up) {
    if (state_ != NodeState::awaited) ++resets_;
    if (state_ == NodeState::operational || state_ == NodeState::starting) {
      problem_ = Status::error(StatusCode::unavailable,
                               "node %u reset itself: is its supply steady? It is configured anew",
                               unsigned{plan_.node});
    }
    // Whatever it was told before is gone.
    client_.cancel(outbox);
    emergency_.reset();
    state_ = NodeState::configuring;
    step_ = 0;
    left_out_.reset();
    answered_.reset();
    mapping_is_fixed_ = reads_back_ = was_operational_ = false;
    brought_back_ = 0;
    // It may be about to start itself (object 1F80), and takes no mapping then.
    outbox.push(nmt_message(NmtCommand::enter_pre_operational, plan_.node));
    begin_step(now, outbox);
    return;
  }
  if (state_ == NodeState::configuring && heard == NmtState::operational &&
      brought_back_ < most_brought_back) {
    ++brought_back_;
    outbox.push(nmt_message(NmtCommand::enter_pre_operational, plan_.node));
    return;
  }
  if (state_ == NodeState::starting && heard == NmtState::operational) {
    state_ = NodeState::operational;
    was_operational_ = true;
    ++times_operational_;
    problem_ = {};
  } else if (state_ == NodeState::operational && heard != NmtState::operational) {
    begin_again(Status::error(StatusCode::unavailable, "node %u left operation by itself: it is %s",
                              unsigned{plan_.node}, name_of(heard)),
                now, outbox);
    return;
  }
  if (is_operational()) heartbeat_.observe(now);
}

bool Node::has_left_out(ObjectAddress object) const noexcept {
  for (std::size_t i = 0; i < plan_.configuration.size(); ++i) {
    if (left_out_.test(i) && plan_.configuration[i].object == object) return true;
  }
  return false;
}

std::optional<std::uint32_t> Node::answered(ObjectAddress object) const noexcept {
  for (std::size_t i = 0; i < plan_.configuration.size(); ++i) {
    if (answered_.test(i) && plan_.configuration[i].object == object) return answers_[i];
  }
  return std::nullopt;
}

void Node::configure(Time now, Outbox& outbox) noexcept {
  if (client_.state() == SdoClient::State::done || client_.state() == SdoClient::State::failed) {
    end_step(now, outbox);
  }
}

void Node::begin_step(Time now, Outbox& outbox) noexcept {
  if (step_ == plan_.configuration.size()) {
    start(now, outbox);
    return;
  }
  const ConfigurationStep& step = plan_.configuration[step_];
  if (step.act != Act::map) mapping_is_fixed_ = false;
  if (reads(step)) {
    client_.read(step.object, now, outbox);
    return;
  }
  std::array<std::uint8_t, 4> value{};
  write_number(value.data(), value.size(), step.value);
  client_.write(step.object, {value.data(), step.size}, now, outbox);
}

void Node::end_step(Time now, Outbox& outbox) noexcept {
  const ConfigurationStep& step = plan_.configuration[step_];
  if (client_.state() == SdoClient::State::failed) {
    if (client_.status().code() == StatusCode::timeout) {
      begin_again(client_.status(), now, outbox);
      return;
    }
    if (!judge_refusal(step, now, outbox)) return;
  } else if (step.act == Act::ask) {
    answered_.set(step_);
    answers_[step_] = static_cast<std::uint32_t>(client_.number());
  } else if (reads(step) && !judge_value(step)) {
    return;
  }
  reads_back_ = false;
  ++step_;
  begin_step(now, outbox);
}

// False: the step is not over, or the node is refused.
bool Node::judge_refusal(const ConfigurationStep& step, Time now, Outbox& outbox) noexcept {
  const std::uint32_t code = client_.abort_code();
  const bool is_missing = code == sdo_abort::no_object || code == sdo_abort::no_subindex;
  if (step.optional && (is_missing || step.act == Act::ask)) {
    left_out_.set(step_);
    return true;
  }
  if (tells_of_fixed_mapping(step)) {
    mapping_is_fixed_ = true;
    return true;
  }
  if (code == sdo_abort::device_state && brings_back(now, outbox)) return false;
  // Whatever the reason: it may be so already.
  if (!reads(step) && !is_missing) {
    reads_back_ = true;
    refused_with_ = code;
    refusal_ = client_.status();
    begin_step(now, outbox);
    return false;
  }
  refuse_step(step, reads_back_ ? refusal_ : client_.status());
  return false;
}

void Node::refuse_step(const ConfigurationStep& step, const Status& refusal) noexcept {
  refuse(step.helps[0] == '\0' ? refusal
                               : Status::error(refusal.code(), "%s; if it is a matter of that: `%s`",
                                               refusal.cause(), step.helps));
}

// What it refuses in operation it may take in pre-operational. False: it was brought there often enough.
bool Node::brings_back(Time now, Outbox& outbox) noexcept {
  if (brought_back_ == most_brought_back) return false;
  ++brought_back_;
  outbox.push(nmt_message(NmtCommand::enter_pre_operational, plan_.node));
  begin_step(now, outbox);
  return true;
}

// False: it is not what is needed, and the node is refused.
bool Node::judge_value(const ConfigurationStep& step) noexcept {
  const std::uint32_t in_size = step.size == 4 ? 0xFFFFFFFF : (1U << (8U * step.size)) - 1;
  const bool is_constant = reads_back_ && cannot_be_written(refused_with_);
  const std::uint32_t compared = reads_back_ && !is_constant ? 0xFFFFFFFF : step.mask;
  const std::uint32_t mask = reads_back_ ? compared & in_size : compared;
  const std::uint32_t wanted = (is_constant ? step.held : step.value) & mask;
  const std::uint32_t found = static_cast<std::uint32_t>(client_.number()) & mask;
  if (found == wanted) return true;
  const auto shown = static_cast<unsigned long>(found);
  const auto needed = static_cast<unsigned long>(wanted);
  const unsigned index = step.object.index;
  const unsigned subindex = step.object.subindex;
  if (reads_back_ && !is_constant) {
    refuse_step(step, refusal_);
  } else if (is_constant) {
    const bool helps = step.helps[0] != '\0';
    refuse(Status::error(
        StatusCode::device_fault,
        "object %04X:%02X of node %u cannot be written and is %08lX, where %08lX is needed%s%s%s", index,
        subindex, unsigned{plan_.node}, shown, needed, helps ? "; if the drive is right: `" : "", step.helps,
        helps ? "`" : ""));
  } else if (step.act == Act::map) {
    refuse(Status::error(StatusCode::device_fault,
                         "node %u has a fixed PDO mapping, and object %04X:%02X is %08lX, where %08lX "
                         "is needed: choose another of its PDOs",
                         unsigned{plan_.node}, index, subindex, shown, needed));
  } else {
    refuse(Status::error(StatusCode::device_fault,
                         "node %u is not the one that was declared: its %s is %08lX and not %08lX; is "
                         "the number set right on the device?",
                         unsigned{plan_.node}, step.meaning, shown, needed));
  }
  return false;
}

bool Node::reads(const ConfigurationStep& step) const noexcept {
  return reads_back_ || step.act == Act::expect || step.act == Act::ask ||
         (step.act == Act::map && mapping_is_fixed_);
}

// Taking the mapping out of use is the first thing that such a node refuses.
bool Node::tells_of_fixed_mapping(const ConfigurationStep& step) const noexcept {
  if (step.act != Act::map || step.object.subindex != 0 || step.value != 0 || mapping_is_fixed_) return false;
  const std::uint32_t code = client_.abort_code();
  return code == sdo_abort::access || code == sdo_abort::read_only || code == sdo_abort::not_mappable;
}

void Node::start(Time now, Outbox& outbox) noexcept {
  heartbeat_.begin(plan_.heartbeat_limit);
  guard_.begin(plan_.heartbeat_period, now);
  toggle_ = true;
  outbox.push(nmt_message(NmtCommand::start, plan_.node));
  if (plan_.heartbeat_period > Duration{}) {
    state_ = NodeState::starting;
    deadline_ = now + plan_.start_timeout;
    return;
  }
  // Nothing will tell: it is believed.
  state_ = NodeState::operational;
  was_operational_ = true;
  ++times_operational_;
  problem_ = {};
}

}  // namespace flexrf::canopen
