// Packets of MELFA's real-time external control.
#include <cmath>

#include "hal/robot_arm/melfa_mxt/mxt_packet.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace flexrf::fuzz {

using namespace melfa;

std::vector<Bytes> seeds() {
  Packet packet;
  packet.command = commands::move;
  packet.reply_contents[0] = contents::measured_joints;
  packet.data[0] = words_of({0.1F, -0.2F, 0.3F, 0, 1, 2, 3, 4});
  packet.counter = 77;
  const PacketBytes bytes = pack(packet);
  return {Bytes(bytes.begin(), bytes.end())};
}

void take(std::span<const std::uint8_t> bytes) {
  const auto packet = unpack(bytes);
  expect(packet.has_value() == (bytes.size() == packet_bytes));
  if (!packet) return;
  const PacketBytes packed = pack(*packet);
  const auto again = unpack(packed);
  expect(again && *again == *packet);
  for (const std::uint16_t content : {contents::joints, contents::measured_joints}) {
    const auto joints = joints_told(*packet, content);
    if (!joints) continue;
    for (const float joint : *joints) expect(std::isfinite(joint));
  }
}

}  // namespace flexrf::fuzz
