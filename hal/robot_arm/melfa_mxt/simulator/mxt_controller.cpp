#include "hal/robot_arm/melfa_mxt/simulator/mxt_controller.hpp"

#include <cmath>

namespace flexrf::melfa {
namespace {

// Packets carry joints in single precision.
constexpr double rounding = 2e-6;  // rad

Joints to_joints(const JointAngles& angles) {
  Joints joints{};
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = static_cast<float>(angles[i]);
  return joints;
}

}  // namespace

MxtController::MxtController(const ControllerPlan& plan)
    : plan_(plan), commanded_(plan.start), measured_(plan.start) {}

void MxtController::reset() {
  alarm_ = "";
  at_mxt_ = true;
  commanded_ = measured_;
}

void MxtController::be_led(double way) {
  for (std::size_t i = 0; i < plan_.joints; ++i) commanded_[i] += way;
}

std::optional<PacketBytes> MxtController::answer(std::span<const std::uint8_t> datagram,
                                                 std::uint64_t cycles) {
  const auto packet = unpack(datagram);
  if (!packet || !at_mxt_ || alarm_[0] != '\0') return std::nullopt;
  if (!obey(*packet, cycles)) return std::nullopt;
  const double share = 1 - std::exp(-static_cast<double>(cycles) * plan_.cycle / plan_.lag);
  for (std::size_t i = 0; i < plan_.joints; ++i) measured_[i] += share * (commanded_[i] - measured_[i]);
  Packet reply;
  reply.command = packet->command;
  reply.send_content = packet->send_content;
  reply.counter = packet->counter;
  for (std::size_t group = 0; group < groups; ++group) {
    const std::uint16_t content = packet->reply_contents[group];
    reply.reply_contents[group] = content;
    if (content == contents::joints) reply.data[group] = words_of(to_joints(commanded_));
    if (content == contents::measured_joints) reply.data[group] = words_of(to_joints(measured_));
  }
  return pack(reply);
}

bool MxtController::obey(const Packet& packet, std::uint64_t cycles) {
  in_session_ = packet.command != commands::end;
  switch (packet.command) {
    case commands::monitor:
      return true;
    case commands::end:
      ++ends_;
      at_mxt_ = plan_.loops;
      return true;
    case commands::move:
      break;
    default:
      return false;
  }
  if (packet.send_content != contents::joints) {
    alarm_ = "a position that is none of joints, while MXT is in joints";
    return false;
  }
  return take(joints_in(packet.data[0]), cycles);
}

bool MxtController::take(const Joints& joints, std::uint64_t cycles) {
  ++moves_;
  JointAngles wanted = commanded_;
  for (std::size_t i = 0; i < plan_.joints; ++i) {
    wanted[i] = static_cast<double>(joints[i]);
    const double most = plan_.fastest[i] * plan_.cycle * static_cast<double>(cycles) + rounding;
    // Also what is no number.
    if (std::abs(wanted[i] - commanded_[i]) <= most) continue;
    alarm_ = "a commanded position is too far away for a cycle";
    return false;
  }
  commanded_ = wanted;
  return true;
}

}  // namespace flexrf::melfa
