// The packet of MELFA's real-time external control (MXT), the same both ways: 196 bytes, little-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace flexrf::melfa {

inline constexpr std::size_t packet_bytes = 196;
using PacketBytes = std::array<std::uint8_t, packet_bytes>;
inline constexpr std::uint16_t usual_port = 10000;

/// Of a packet to the controller.
namespace commands {
inline constexpr std::uint16_t monitor = 0;  ///< only tells
inline constexpr std::uint16_t move = 1;
inline constexpr std::uint16_t end = 255;  ///< of the session
}  // namespace commands

/// What a group of data holds.
namespace contents {
inline constexpr std::uint16_t nothing = 0;
inline constexpr std::uint16_t joints = 2;           ///< as commanded; rad, of a linear joint mm
inline constexpr std::uint16_t measured_joints = 8;  ///< by the encoders; likewise
}  // namespace contents

inline constexpr std::size_t most_joints = 8;
inline constexpr std::size_t groups = 4;

/// One group of data: 40 bytes, whose meaning its content says.
using DataWords = std::array<std::uint32_t, 10>;
using Joints = std::array<float, most_joints>;
Joints joints_in(const DataWords& words) noexcept;
DataWords words_of(const Joints& joints) noexcept;

/// Every field but the reserved ones, which are sent as 0.
struct Packet {
  std::uint16_t command = commands::monitor;
  std::uint16_t send_content = contents::nothing;      ///< what data[0] holds on the way to the controller
  std::array<std::uint16_t, groups> reply_contents{};  ///< what data[n] shall hold, or holds, on the way back
  std::array<DataWords, groups> data{};
  std::uint16_t send_signals = 0;   ///< 0 none, 1 outputs, 2 inputs
  std::uint16_t reply_signals = 0;  ///< likewise
  std::uint16_t first_signal = 0;
  std::uint16_t signal_mask = 0;
  std::uint16_t signals = 0;
  std::uint16_t timeouts = 0;  ///< counted by the controller
  std::uint32_t counter = 0;   ///< of packets to the controller

  bool operator==(const Packet&) const = default;
};

PacketBytes pack(const Packet& packet) noexcept;
/// Nothing: of another length.
std::optional<Packet> unpack(std::span<const std::uint8_t> bytes) noexcept;

/// The joints that a reply tells under this content, in any of its groups; nothing: it does not, or they are
/// no numbers.
std::optional<Joints> joints_told(const Packet& reply, std::uint16_t content) noexcept;

}  // namespace flexrf::melfa
