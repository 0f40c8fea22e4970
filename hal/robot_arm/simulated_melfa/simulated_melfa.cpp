#include "hal/robot_arm/simulated_melfa/simulated_melfa.hpp"

#include <algorithm>

namespace flexrf {

std::optional<ArrivedDatagram> MxtWireLink::receive(std::span<std::uint8_t> into, Time now) noexcept {
  const melfa::MxtDatagram* first = wire_->first();
  for (; first != nullptr && first->due <= now && first->by_stranger; first = wire_->first()) {
    ++strangers_;
    wire_->pop();
  }
  if (first == nullptr || first->due > now) return std::nullopt;
  const ArrivedDatagram datagram{first->size, first->due};
  std::copy_n(first->bytes.begin(), std::min(datagram.size, into.size()), into.begin());
  wire_->pop();
  return datagram;
}

Status SimulatedMelfa::open_link() {
  melfa::ControllerPlan plan;
  plan.joints = chain->joint_count;
  plan.cycle = configuration.cycle;
  plan.lag = configuration.servo_lag;
  for (std::size_t i = 0; i < chain->joint_count; ++i) {
    plan.start[i] = chain->joints[i].home;
    plan.fastest[i] = chain->joints[i].velocity;
  }
  wire_ = melfa::MxtWire{plan, true};
  return {};
}

Time SimulatedMelfa::next_event() const noexcept {
  const melfa::MxtDatagram* const first = wire_.first();
  return first == nullptr ? Time::max() : first->due;
}

}  // namespace flexrf
