// What a node is told beside its configuration, and which plans make no sense.
#include "hal/canopen/node.hpp"

namespace flexrf::canopen {
namespace {

long long in_ms(Duration duration) {
  return static_cast<long long>(duration.count() / 1'000'000);
}

bool fits_u16(Duration duration) {
  return duration >= Duration{} && duration <= std::chrono::milliseconds(0xFFFF);
}

// Of a plan whose node is guarded: in how many guard times it is to be asked once.
long long life_time_factor_of(const NodePlan& plan) {
  return (plan.heartbeat_limit + plan.heartbeat_period - Duration{1}) / plan.heartbeat_period;
}

}  // namespace

Status Node::check(const NodePlan& plan) const noexcept {
  if (plan.node < lowest_node || plan.node > highest_node || plan.master < lowest_node ||
      plan.master > highest_node || plan.master == plan.node) {
    return Status::error(StatusCode::invalid_argument,
                         "node %u with master %u: both are numbers from 1 to 127, and not the same",
                         unsigned{plan.node}, unsigned{plan.master});
  }
  if (!fits_u16(plan.heartbeat_period) || !fits_u16(plan.master_heartbeat_limit)) {
    return Status::error(StatusCode::invalid_argument,
                         "node %u: a heartbeat's time is at most 65.535 s, as the node counts it",
                         unsigned{plan.node});
  }
  if (plan.heartbeat_period > Duration{} && plan.heartbeat_limit <= plan.heartbeat_period) {
    return Status::error(StatusCode::invalid_argument,
                         "node %u: its heartbeat comes each %lld ms and would be lost after %lld ms: give it "
                         "at least twice its period",
                         unsigned{plan.node}, in_ms(plan.heartbeat_period), in_ms(plan.heartbeat_limit));
  }
  if (plan.is_guarded && (plan.heartbeat_period == Duration{} || life_time_factor_of(plan) > 0xFF)) {
    return Status::error(
        StatusCode::invalid_argument,
        "node %u is to be guarded each %lld ms and lost after %lld ms: from 2 to 255 of those "
        "periods can be that long",
        unsigned{plan.node}, in_ms(plan.heartbeat_period), in_ms(plan.heartbeat_limit));
  }
  return {};
}

// Who looks for whom.
void Node::plan_supervision() noexcept {
  const auto period = static_cast<std::uint32_t>(in_ms(plan_.heartbeat_period));
  if (plan_.is_guarded) {
    plan_.configuration.write(objects::guard_time, 2, period, "guarded = false");
    plan_.configuration.write(objects::life_time_factor, 1,
                              static_cast<std::uint32_t>(life_time_factor_of(plan_)), "guarded = false");
  } else {
    plan_.configuration.write(objects::producer_heartbeat, 2, period, "guarded = true");
  }
  if (plan_.master_heartbeat_limit == Duration{}) return;
  plan_.configuration.write(
      objects::consumer_heartbeat, 4,
      std::uint32_t{plan_.master} << 16 | static_cast<std::uint32_t>(in_ms(plan_.master_heartbeat_limit)),
      "supervises_us = false");
}

Status Node::begin(const NodePlan& plan, Time now, Outbox& outbox) noexcept {
  if (const Status status = check(plan); !status.is_ok()) return status;
  plan_ = plan;
  plan_supervision();
  if (!plan_.configuration.is_complete()) {
    return Status::error(StatusCode::invalid_argument, "node %u is to be told more than %zu objects",
                         unsigned{plan.node}, Configuration::capacity);
  }
  client_ = SdoClient{plan.node, plan.sdo_timeout};
  problem_ = {};
  emergency_.reset();
  was_operational_ = false;
  ask_to_boot(now, outbox);
  return {};
}

}  // namespace flexrf::canopen
