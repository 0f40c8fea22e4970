// Objects of a CANopen device's dictionary.
#pragma once

#include <cstdint>

namespace flexrf::canopen {

struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;

  bool operator==(const ObjectAddress&) const = default;
};

namespace objects {
inline constexpr ObjectAddress device_type{0x1000, 0};
inline constexpr ObjectAddress error_register{0x1001, 0};
inline constexpr ObjectAddress sync{0x1005, 0};                ///< u32: identifier of SYNC
inline constexpr ObjectAddress guard_time{0x100C, 0};          ///< u16: ms, 0 is off
inline constexpr ObjectAddress life_time_factor{0x100D, 0};    ///< u8: guard times without a question
inline constexpr ObjectAddress consumer_heartbeat{0x1016, 1};  ///< u32: node << 16 | ms
inline constexpr ObjectAddress producer_heartbeat{0x1017, 0};  ///< u16: ms, 0 is off
inline constexpr ObjectAddress vendor{0x1018, 1};
inline constexpr ObjectAddress product{0x1018, 2};
inline constexpr ObjectAddress error_behaviour{0x1029, 1};  ///< u8: 0 pre-operational, 1 as it is, 2 stopped
}  // namespace objects

}  // namespace flexrf::canopen
