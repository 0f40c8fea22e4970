// Why an SDO transfer was aborted (CiA 301), in words.
#pragma once

#include <cstdint>

namespace flexrf::canopen {

namespace sdo_abort {
inline constexpr std::uint32_t none = 0;
inline constexpr std::uint32_t toggle = 0x05030000;
inline constexpr std::uint32_t timeout = 0x05040000;
inline constexpr std::uint32_t bad_command = 0x05040001;
inline constexpr std::uint32_t out_of_memory = 0x05040005;
inline constexpr std::uint32_t access = 0x06010000;
inline constexpr std::uint32_t write_only = 0x06010001;
inline constexpr std::uint32_t read_only = 0x06010002;
inline constexpr std::uint32_t no_object = 0x06020000;
inline constexpr std::uint32_t not_mappable = 0x06040041;
inline constexpr std::uint32_t mapping_too_long = 0x06040042;
inline constexpr std::uint32_t wrong_length = 0x06070010;
inline constexpr std::uint32_t too_long = 0x06070012;
inline constexpr std::uint32_t too_short = 0x06070013;
inline constexpr std::uint32_t no_subindex = 0x06090011;
inline constexpr std::uint32_t out_of_range = 0x06090030;
inline constexpr std::uint32_t general = 0x08000000;
inline constexpr std::uint32_t device_state = 0x08000022;
}  // namespace sdo_abort

/// "the object does not exist", ...; "a reason of the device's own" for what CiA 301 does not know.
const char* describe_sdo_abort(std::uint32_t code) noexcept;

}  // namespace flexrf::canopen
