// What CANopen sends over CAN (CiA 301): messages with an 11-bit identifier, and who uses which.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace flexrf::canopen {

/// One frame with a standard identifier. Remote ones are used by node guarding alone, for nodes that have no
/// heartbeat.
struct Message {
  std::uint16_t identifier = 0;  ///< 0 to 0x7FF
  std::uint8_t size = 0;         ///< bytes of `data` in use, at most 8
  std::array<std::uint8_t, 8> data{};
  bool remote = false;  ///< asks for so many bytes, and carries none

  bool operator==(const Message&) const = default;
};

inline constexpr std::uint8_t lowest_node = 1;
inline constexpr std::uint8_t highest_node = 127;

/// The predefined connection set: base identifiers, to which the node is added.
inline constexpr std::uint16_t nmt_identifier = 0x000;
inline constexpr std::uint16_t sync_identifier = 0x080;
inline constexpr std::uint16_t emergency_base = 0x080;
inline constexpr std::uint16_t sdo_answer_base = 0x580;
inline constexpr std::uint16_t sdo_request_base = 0x600;
inline constexpr std::uint16_t heartbeat_base = 0x700;

constexpr std::uint16_t identifier_of(std::uint16_t base, std::uint8_t node) noexcept {
  return static_cast<std::uint16_t>(base + node);
}
/// TPDO `number` (1 to 4), which the node sends: 0x180, 0x280, 0x380, 0x480 + node.
constexpr std::uint16_t transmit_pdo_identifier(unsigned number, std::uint8_t node) noexcept {
  return static_cast<std::uint16_t>(0x080 + 0x100 * number + node);
}
/// RPDO `number` (1 to 4), which the node receives: 0x200, 0x300, 0x400, 0x500 + node.
constexpr std::uint16_t receive_pdo_identifier(unsigned number, std::uint8_t node) noexcept {
  return static_cast<std::uint16_t>(0x100 + 0x100 * number + node);
}

/// Everything in CANopen has its least significant byte first. `size`: bytes, at most 8.
constexpr std::uint64_t read_number(const std::uint8_t* from, std::size_t size) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value |= static_cast<std::uint64_t>(from[i]) << (8 * i);
  return value;
}
constexpr void write_number(std::uint8_t* to, std::size_t size, std::uint64_t value) noexcept {
  for (std::size_t i = 0; i < size; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// Messages that wait to be sent, in order; for one thread. A full one refuses and counts: the protocol's
/// time-outs then say what did not happen.
class Outbox {
 public:
  static constexpr std::size_t capacity = 32;

  bool push(const Message& message) noexcept {
    if (count_ == capacity) {
      ++refused_;
      return false;
    }
    messages_[(first_ + count_++) % capacity] = message;
    return true;
  }
  bool is_empty() const noexcept { return count_ == 0; }
  std::size_t size() const noexcept { return count_; }
  /// Not when empty.
  const Message& front() const noexcept { return messages_[first_]; }
  void pop() noexcept {
    first_ = (first_ + 1) % capacity;
    --count_;
  }
  void clear() noexcept { count_ = 0; }
  std::uint64_t refused() const noexcept { return refused_; }

 private:
  std::array<Message, capacity> messages_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace flexrf::canopen
