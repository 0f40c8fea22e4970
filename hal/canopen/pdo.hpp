// Process data objects (CiA 301): what is in one, how its bytes are packed, and how a node is told.
#pragma once

#include <span>

#include "hal/canopen/message.hpp"
#include "hal/canopen/object.hpp"

namespace flexrf::canopen {

/// Seen from the node, as CiA 301 does.
enum class PdoDirection : std::uint8_t { received_by_node, sent_by_node };

struct PdoEntry {
  ObjectAddress object{};
  std::uint8_t bits = 0;   ///< 1 to 64
  const char* helps = "";  ///< see ConfigurationStep

  bool operator==(const PdoEntry& other) const { return object == other.object && bits == other.bits; }
};

struct PdoPlan {
  static constexpr std::size_t most_entries = 8;

  PdoDirection direction = PdoDirection::received_by_node;
  std::uint16_t number = 1;       ///< from 1, as in TPDO1
  std::uint16_t identifier = 0;   ///< of its messages
  std::uint8_t transmission = 1;  ///< 1 to 240: with each n-th SYNC; 255: on its own
  std::uint16_t inhibit = 0;  ///< least time between two, in 100 us; only if sent by the node; 0: not written
  std::uint16_t event_timer = 0;       ///< ms; 0: not written
  const char* event_timer_helps = "";  ///< see ConfigurationStep
  bool forbids_remote = true;          ///< nobody may ask for it (bit 30); only if sent by the node
  const char* helps = "";              ///< see ConfigurationStep
  std::uint8_t count = 0;
  std::array<PdoEntry, most_entries> entries{};

  /// False: there are 8 entries, or their bits are more than a message holds.
  bool add(ObjectAddress object, std::uint8_t bits, const char* helps = "") noexcept;
  unsigned bits() const noexcept;
  std::uint8_t bytes() const noexcept { return static_cast<std::uint8_t>((bits() + 7) / 8); }

  ObjectAddress communication(std::uint8_t subindex) const noexcept;  ///< 1400 or 1800 + number - 1
  ObjectAddress mapping(std::uint8_t subindex) const noexcept;        ///< 1600 or 1A00 + number - 1
};

/// How object 1600.. or 1A00.. writes an entry down.
constexpr std::uint32_t mapping_word(const PdoEntry& entry) noexcept {
  return (std::uint32_t{entry.object.index} << 16) | (std::uint32_t{entry.object.subindex} << 8) | entry.bits;
}

/// `values`: one for each entry, of which its lowest bits are sent.
Message pack(const PdoPlan& plan, std::span<const std::uint64_t> values) noexcept;
/// `values`: one for each entry, with zeros above its bits. False, and nothing is written, if it is not this
/// PDO's message, or too short for it; what is behind the mapped bits is left out.
bool unpack(const PdoPlan& plan, const Message& message, std::span<std::uint64_t> values) noexcept;

/// Of a value of so many bits: as a number with a sign.
constexpr std::int64_t with_sign(std::uint64_t value, unsigned bits) noexcept {
  const unsigned unused = 64 - bits;
  return static_cast<std::int64_t>(value << unused) >> unused;
}

}  // namespace flexrf::canopen
