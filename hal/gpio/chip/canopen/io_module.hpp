// A CiA 401 module as its master sees it: brought up, supervised, its inputs heard and its outputs told.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/canopen/cia401.hpp"
#include "hal/canopen/node.hpp"
#include "hal/canopen/pdo.hpp"

namespace flexrf::canopen {

struct IoModulePlan {
  std::uint8_t node = 1;
  std::uint8_t master = 127;
  std::uint32_t vendor = 0;       ///< 0: any
  std::uint32_t product = 0;      ///< 0: any
  std::uint8_t input_bytes = 1;   ///< of eight inputs each, at most cia401::most_bytes
  std::uint8_t output_bytes = 1;  ///< likewise; one of both is above 0
  /// It tells its inputs at each change, and so often; whole ms. 0: it has no event timer, and tells them
  /// with each SYNC, which is said in each cycle.
  Duration refresh = std::chrono::milliseconds(100);
  // What not every module has, or takes.
  bool tells_error_values = true;   ///< objects 6206 and 6207: what outputs are when it no longer hears us
  bool is_supervised_by_it = true;  ///< object 1016: it looks for our heartbeat
  bool forbids_remote = true;       ///< bit 30 of the identifier of what it sends
  bool is_guarded = false;          ///< it has no heartbeat, see NodePlan
  Duration boot_timeout = std::chrono::seconds(1);
  Duration sdo_timeout = std::chrono::milliseconds(500);
  Duration heartbeat_period = std::chrono::milliseconds(100);
  Duration heartbeat_limit = std::chrono::milliseconds(250);
};

/// Lines are bits: bit 0 is the first of byte 1, as it is at the terminal. Without I/O; never blocks, never
/// allocates. One thread. A cycle: receive() of what came, then look(), then send().
class IoModule {
 public:
  /// `safe`: what outputs are told before the module is started, and what it is told to make them when it no
  /// longer hears us. Error: the plan makes no sense.
  Status begin(const IoModulePlan& plan, std::uint64_t safe, Time now, Outbox& outbox) noexcept;
  /// The inputs that this message has changed. None where it tells them for the first time.
  std::uint64_t receive(const Message& message, Time now, Outbox& outbox) noexcept;
  /// Once all was received. `usable`: of the bus.
  void look(bool usable, Time now) noexcept;
  void send(Time now, Outbox& outbox) noexcept;

  /// It is operational, and can be told its outputs.
  bool is_there() const noexcept { return is_there_; }
  /// Nothing while it is not there, or has not told them; 0 if it has none.
  const std::optional<std::uint64_t>& inputs() const noexcept { return inputs_; }
  /// Tells it all of its outputs. Nothing: it has none.
  std::optional<Message> outputs(std::uint64_t bits) const noexcept;
  /// Once for each cycle in which it is there: reads the module's outputs back (object 6200, a byte in each
  /// request). True once each byte that was read is as in `bits`. A byte whose reading the module refuses
  /// counts as right.
  bool has_outputs(std::uint64_t bits, Time now, Outbox& outbox) noexcept;
  /// Outputs were changed: has_outputs() asks for all of them again.
  void forget_outputs() noexcept {
    confirmed_ = 0;
    asks_ = false;
  }

  /// Why it is not there, does not tell its inputs, or what it says is wrong in it; ok while nothing is.
  const Status& trouble() const noexcept { return trouble_; }
  /// Nothing has gone wrong yet: it has not had the time.
  bool is_coming() const noexcept { return is_coming_; }
  const Node& node() const noexcept { return node_; }

 private:
  // Longest silence of its inputs: in times of `refresh`, or in cycles with SYNC.
  static constexpr int most_silent = 3;
  static constexpr int most_silent_cycles = 10;

  Status check(const IoModulePlan& plan) const noexcept;
  NodePlan node_plan(std::uint64_t safe) noexcept;
  void plan_inputs(Configuration& list) const noexcept;
  void plan_outputs(Configuration& list, std::uint64_t safe) const noexcept;
  bool is_confirmed(std::uint8_t lines) noexcept;
  bool is_silent(Time now) const noexcept;
  Status find_trouble(bool usable, bool silent) noexcept;

  IoModulePlan plan_;
  Node node_;
  PdoPlan told_;   // TPDO 1
  PdoPlan asked_;  // RPDO 1
  HeartbeatProducer beat_;
  bool is_there_ = false;
  bool is_coming_ = true;
  std::optional<std::uint64_t> inputs_;
  Time heard_{};                // its inputs, or since it is there
  int silent_cycles_ = 0;       // at most most_silent_cycles + 1
  std::uint8_t confirmed_ = 0;  // bytes of outputs, from the first
  bool asks_ = false;           // for the next one
  Status trouble_;
};

}  // namespace flexrf::canopen
