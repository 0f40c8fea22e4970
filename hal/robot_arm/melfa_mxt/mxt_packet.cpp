#include "hal/robot_arm/melfa_mxt/mxt_packet.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace flexrf::melfa {
namespace {

constexpr std::array<std::size_t, groups> content_at{4, 64, 108, 152};
constexpr std::array<std::size_t, groups> data_at{8, 68, 112, 156};
static_assert(data_at.back() + sizeof(DataWords) == packet_bytes);
static_assert(sizeof(float) == sizeof(std::uint32_t));

void put16(PacketBytes& bytes, std::size_t at, std::uint16_t value) noexcept {
  bytes[at] = static_cast<std::uint8_t>(value & 0xFF);
  bytes[at + 1] = static_cast<std::uint8_t>(value >> 8);
}
void put32(PacketBytes& bytes, std::size_t at, std::uint32_t value) noexcept {
  put16(bytes, at, static_cast<std::uint16_t>(value & 0xFFFF));
  put16(bytes, at + 2, static_cast<std::uint16_t>(value >> 16));
}
std::uint16_t get16(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}
std::uint32_t get32(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return std::uint32_t{get16(bytes, at)} | std::uint32_t{get16(bytes, at + 2)} << 16;
}

}  // namespace

Joints joints_in(const DataWords& words) noexcept {
  Joints joints{};
  for (std::size_t i = 0; i < most_joints; ++i) joints[i] = std::bit_cast<float>(words[i]);
  return joints;
}

DataWords words_of(const Joints& joints) noexcept {
  DataWords words{};
  for (std::size_t i = 0; i < most_joints; ++i) words[i] = std::bit_cast<std::uint32_t>(joints[i]);
  return words;
}

PacketBytes pack(const Packet& packet) noexcept {
  PacketBytes bytes{};
  put16(bytes, 0, packet.command);
  put16(bytes, 2, packet.send_content);
  for (std::size_t group = 0; group < groups; ++group) {
    put16(bytes, content_at[group], packet.reply_contents[group]);
    for (std::size_t word = 0; word < packet.data[group].size(); ++word) {
      put32(bytes, data_at[group] + 4 * word, packet.data[group][word]);
    }
  }
  put16(bytes, 48, packet.send_signals);
  put16(bytes, 50, packet.reply_signals);
  put16(bytes, 52, packet.first_signal);
  put16(bytes, 54, packet.signal_mask);
  put16(bytes, 56, packet.signals);
  put16(bytes, 58, packet.timeouts);
  put32(bytes, 60, packet.counter);
  return bytes;
}

std::optional<Packet> unpack(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() != packet_bytes) return std::nullopt;
  Packet packet;
  packet.command = get16(bytes, 0);
  packet.send_content = get16(bytes, 2);
  for (std::size_t group = 0; group < groups; ++group) {
    packet.reply_contents[group] = get16(bytes, content_at[group]);
    for (std::size_t word = 0; word < packet.data[group].size(); ++word) {
      packet.data[group][word] = get32(bytes, data_at[group] + 4 * word);
    }
  }
  packet.send_signals = get16(bytes, 48);
  packet.reply_signals = get16(bytes, 50);
  packet.first_signal = get16(bytes, 52);
  packet.signal_mask = get16(bytes, 54);
  packet.signals = get16(bytes, 56);
  packet.timeouts = get16(bytes, 58);
  packet.counter = get32(bytes, 60);
  return packet;
}

std::optional<Joints> joints_told(const Packet& reply, std::uint16_t content) noexcept {
  for (std::size_t group = 0; group < groups; ++group) {
    if (reply.reply_contents[group] != content) continue;
    const Joints joints = joints_in(reply.data[group]);
    if (!std::all_of(joints.begin(), joints.end(), [](float joint) { return std::isfinite(joint); }))
      return std::nullopt;
    return joints;
  }
  return std::nullopt;
}

}  // namespace flexrf::melfa
