// A node as its master sees it: brought up, supervised, and brought up anew whenever it was gone (CiA 301,
// 302-2).
#pragma once

#include <bitset>

#include "hal/canopen/configuration.hpp"
#include "hal/canopen/emergency.hpp"
#include "hal/canopen/nmt.hpp"
#include "hal/canopen/sdo_client.hpp"

namespace flexrf::canopen {

struct NodePlan {
  std::uint8_t node = 1;
  std::uint8_t master = 127;  ///< the node whose heartbeat we send
  Duration boot_timeout =
      std::chrono::seconds(1);  ///< from a reset to the boot-up message; longer than the node takes
  Duration sdo_timeout = std::chrono::milliseconds(500);
  Duration start_timeout =
      std::chrono::seconds(1);  ///< from the start command to the first operational heartbeat
  Duration heartbeat_period = std::chrono::milliseconds(100);  ///< of the node; whole ms
  Duration heartbeat_limit = std::chrono::milliseconds(250);   ///< the longest silence of the node
  Duration grace{};  ///< from the loss of its heartbeat to its reset; process data may stop a drive meanwhile
  /// It has no heartbeat: it is asked for its state each heartbeat_period (node guarding), and notices itself
  /// when it no longer is, for heartbeat_limit (life guarding; rounded up to whole periods).
  bool is_guarded = false;
  Duration master_heartbeat_limit =
      std::chrono::milliseconds(250);  ///< the longest of ours; 0: it does not look
  /// What else it is asked and told: identity first, then its own objects, then its PDOs.
  Configuration configuration{};
};

enum class NodeState : std::uint8_t {
  off,          ///< nothing was begun
  awaited,      ///< it fell silent, or was told to reset its communication, and has not said boot-up
  configuring,  ///< it is asked who it is, and told how to work
  starting,     ///< it was told to start, and no heartbeat says that it has
  operational,
  refused,  ///< it is not what was declared, or does not take its configuration; until it boots anew
};
const char* name_of(NodeState state) noexcept;

/// A state machine without I/O; never blocks, never allocates. One thread. What goes wrong for want of an
/// answer is tried again, from the reset on; what a node refuses is not, until it boots anew or begin() is
/// called again.
class Node {
 public:
  /// Error: the plan makes no sense.
  Status begin(const NodePlan& plan, Time now, Outbox& outbox) noexcept;
  /// Of whichever message on the bus.
  void receive(const Message& message, Time now, Outbox& outbox) noexcept;
  void advance(Time now, Outbox& outbox) noexcept;
  /// Tells the node to leave its operation; nothing is supervised any more.
  void end(Outbox& outbox) noexcept;

  /// While it is operational, or was_lost(), for what no PDO carries; else it is the node's own.
  SdoClient& client() noexcept { return client_; }

  NodeState state() const noexcept { return state_; }
  bool is_operational() const noexcept { return state_ == NodeState::operational; }
  /// Its heartbeat was lost in operation, and it has not booted since, so its PDO mapping is unchanged.
  bool was_lost() const noexcept { return state_ == NodeState::awaited && was_operational_; }
  /// Why it is not operational, or was not last time; ok from the moment at which it is.
  const Status& problem() const noexcept { return problem_; }
  /// What it said last of what is wrong in it; none while nothing is.
  const std::optional<Emergency>& emergency() const noexcept { return emergency_; }

  /// Of its configuration, since it booted: what is optional, and it has no object for.
  bool has_left_out(ObjectAddress object) const noexcept;
  /// The value that a step `ask` of its configuration has read since the node booted; nothing: there was no
  /// such step, or the node refused it.
  std::optional<std::uint32_t> answered(ObjectAddress object) const noexcept;

  std::uint64_t emergencies() const noexcept { return emergencies_; }
  std::uint64_t times_operational() const noexcept { return times_operational_; }
  /// Boot-ups that nobody had asked for.
  std::uint64_t resets() const noexcept { return resets_; }
  /// Silences of its heartbeat, or of its answers to guarding.
  std::uint64_t silences() const noexcept { return silences_; }

 private:
  Status check(const NodePlan& plan) const noexcept;
  void plan_supervision() noexcept;
  bool is_repeated(const Message& answer) noexcept;
  void ask_to_boot(Time now, Outbox& outbox) noexcept;
  void begin_again(const Status& problem, Time now, Outbox& outbox) noexcept;
  void refuse(const Status& problem) noexcept;
  void refuse_step(const ConfigurationStep& step, const Status& refusal) noexcept;
  void observe(NmtState heard, Time now, Outbox& outbox) noexcept;
  void configure(Time now, Outbox& outbox) noexcept;
  void begin_step(Time now, Outbox& outbox) noexcept;
  void end_step(Time now, Outbox& outbox) noexcept;
  bool reads(const ConfigurationStep& step) const noexcept;
  bool judge_refusal(const ConfigurationStep& step, Time now, Outbox& outbox) noexcept;
  bool judge_value(const ConfigurationStep& step) noexcept;
  bool tells_of_fixed_mapping(const ConfigurationStep& step) const noexcept;
  bool brings_back(Time now, Outbox& outbox) noexcept;
  void start(Time now, Outbox& outbox) noexcept;

  NodePlan plan_;
  NodeState state_ = NodeState::off;
  SdoClient client_{1, std::chrono::milliseconds(500)};
  HeartbeatConsumer heartbeat_;
  HeartbeatProducer guard_;
  bool toggle_ = false;  // of its last answer to guarding
  std::size_t step_ = 0;
  bool mapping_is_fixed_ = false;  // of the PDO that is being configured
  std::bitset<Configuration::capacity> left_out_;
  std::bitset<Configuration::capacity> answered_;
  std::array<std::uint32_t, Configuration::capacity> answers_{};  // of the steps that ask
  bool was_operational_ = false;                                  // since it booted
  bool reads_back_ = false;                                       // what the step could not write
  std::uint32_t refused_with_ = 0;                                // the code of that refusal
  Status refusal_;                                                // and what it says
  unsigned brought_back_ = 0;                                     // to pre-operational, since it booted
  Time deadline_{};
  Status problem_;
  std::optional<Emergency> emergency_;
  std::uint64_t emergencies_ = 0;
  std::uint64_t times_operational_ = 0;
  std::uint64_t resets_ = 0;
  std::uint64_t silences_ = 0;
};

}  // namespace flexrf::canopen
