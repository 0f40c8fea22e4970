// Network management (CiA 301): commands to nodes, what heartbeats say of them, and who supervises whom.
#pragma once

#include <cmath>
#include <optional>

#include "base/time.hpp"
#include "hal/canopen/message.hpp"

namespace flexrf::canopen {

/// As nodes count time.
inline Duration whole_milliseconds(double seconds) noexcept {
  return std::chrono::milliseconds(std::llround(seconds * 1e3));
}

enum class NmtCommand : std::uint8_t {
  start = 0x01,
  stop = 0x02,
  enter_pre_operational = 0x80,
  reset_node = 0x81,
  reset_communication = 0x82,
};

/// As a heartbeat's byte says it.
enum class NmtState : std::uint8_t {
  boot_up = 0x00,
  stopped = 0x04,
  operational = 0x05,
  pre_operational = 0x7F,
};
/// "operational", ...; "a state of its own" for what CiA 301 does not know.
const char* name_of(NmtState state) noexcept;

/// `node` 0: all nodes.
Message nmt_message(NmtCommand command, std::uint8_t node) noexcept;
Message heartbeat_message(NmtState state, std::uint8_t node) noexcept;
/// Node guarding: asks `node` for its state.
Message guard_message(std::uint8_t node) noexcept;
/// What a node answers; `toggle` is another in each answer, and false in the first after its boot-up.
Message guard_answer(NmtState state, bool toggle, std::uint8_t node) noexcept;
/// Of an answer to guarding.
bool toggle_of(const Message& answer) noexcept;

/// What a heartbeat, a boot-up message or an answer to guarding of `node` says; nothing if it is none, or
/// damaged.
std::optional<NmtState> heartbeat_of(const Message& message, std::uint8_t node) noexcept;
/// What an NMT command asks of `node`; nothing if it is none, for another node, or damaged.
std::optional<NmtCommand> nmt_command_for(const Message& message, std::uint8_t node) noexcept;

/// Whether a peer still beats. Supervision begins with the first heartbeat after begin(): before it, silence
/// means nothing (CiA 301).
class HeartbeatConsumer {
 public:
  /// `limit`: the longest silence; 0: never lost.
  void begin(Duration limit) noexcept {
    limit_ = limit;
    last_.reset();
  }
  void observe(Time now) noexcept { last_ = now; }
  bool is_supervising() const noexcept { return limit_ > Duration{} && last_.has_value(); }
  bool is_lost(Time now) const noexcept { return is_supervising() && now - *last_ > limit_; }

 private:
  Duration limit_{};
  std::optional<Time> last_;
};

/// When our own heartbeat is due, or the next question of node guarding.
class HeartbeatProducer {
 public:
  /// `period` 0: never.
  void begin(Duration period, Time now) noexcept {
    period_ = period;
    due_ = now;
  }
  /// True when one is to be sent now; the next one is due a period after this one was.
  bool is_due(Time now) noexcept {
    if (period_ == Duration{} || now < due_) return false;
    due_ += period_;
    if (due_ <= now) due_ = now + period_;  // after a pause: no burst
    return true;
  }

 private:
  Duration period_{};
  Time due_{};
};

}  // namespace flexrf::canopen
