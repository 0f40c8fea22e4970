// The drive profile CiA 402 (IEC 61800-7-201): objects, states, modes, and the bits that say and ask for
// them.
#pragma once

#include <cstdint>

#include "hal/canopen/object.hpp"

namespace flexrf::canopen::cia402 {

inline constexpr std::uint32_t profile_number = 402;  ///< the lower half of object 1000
/// A node with several axes has the objects of each so much above those of the one before.
inline constexpr std::uint16_t axis_distance = 0x800;

namespace objects {
inline constexpr ObjectAddress error_code{0x603F, 0};               ///< u16
inline constexpr ObjectAddress controlword{0x6040, 0};              ///< u16
inline constexpr ObjectAddress statusword{0x6041, 0};               ///< u16
inline constexpr ObjectAddress quick_stop_option{0x605A, 0};        ///< i16
inline constexpr ObjectAddress abort_connection{0x6007, 0};         ///< i16
inline constexpr ObjectAddress mode{0x6060, 0};                     ///< i8
inline constexpr ObjectAddress mode_display{0x6061, 0};             ///< i8
inline constexpr ObjectAddress actual_position{0x6064, 0};          ///< i32
inline constexpr ObjectAddress following_window{0x6065, 0};         ///< u32
inline constexpr ObjectAddress position_window{0x6067, 0};          ///< u32
inline constexpr ObjectAddress actual_velocity{0x606C, 0};          ///< i32
inline constexpr ObjectAddress most_torque{0x6072, 0};              ///< u16: of 1000 of its rated torque
inline constexpr ObjectAddress actual_torque{0x6077, 0};            ///< i16: likewise
inline constexpr ObjectAddress target_position{0x607A, 0};          ///< i32
inline constexpr ObjectAddress profile_velocity{0x6081, 0};         ///< u32
inline constexpr ObjectAddress profile_acceleration{0x6083, 0};     ///< u32
inline constexpr ObjectAddress profile_deceleration{0x6084, 0};     ///< u32
inline constexpr ObjectAddress quick_stop_deceleration{0x6085, 0};  ///< u32
inline constexpr ObjectAddress homing_method{0x6098, 0};            ///< i8
inline constexpr ObjectAddress homing_search_speed{0x6099, 1};      ///< u32: towards the switch
inline constexpr ObjectAddress homing_creep_speed{0x6099, 2};       ///< u32: towards the zero
inline constexpr ObjectAddress interpolation_kind{0x60C0, 0};       ///< i16: 0 is linear
inline constexpr ObjectAddress interpolation_point{0x60C1, 1};      ///< i32
inline constexpr ObjectAddress interpolation_buffer{0x60C4, 6};     ///< u8: 1 lets points in
inline constexpr ObjectAddress period_value{0x60C2, 1};             ///< u8
inline constexpr ObjectAddress period_exponent{0x60C2, 2};          ///< i8: of ten, in s
inline constexpr ObjectAddress following_error{0x60F4, 0};          ///< i32
inline constexpr ObjectAddress target_velocity{0x60FF, 0};          ///< i32
inline constexpr ObjectAddress supported_modes{0x6502, 0};          ///< u32
}  // namespace objects

enum class Mode : std::int8_t {
  none = 0,
  profile_position = 1,
  profile_velocity = 3,
  homing = 6,
  interpolated_position = 7,
  cyclic_position = 8,
  cyclic_velocity = 9,
};

enum class DriveState : std::uint8_t {
  unknown,  ///< a statusword that says none of the others
  not_ready,
  switch_on_disabled,
  ready_to_switch_on,
  switched_on,
  operation_enabled,
  quick_stop_active,
  fault_reaction,
  fault,
};
const char* name_of(DriveState state) noexcept;
DriveState state_of(std::uint16_t statusword) noexcept;
/// The motor may turn by itself or be held: neither off nor about to be switched on.
bool has_torque(DriveState state) noexcept;

/// Bits of the statusword beside the state; 12 and 13 depend on the mode.
namespace status_bit {
inline constexpr std::uint16_t warning = 1 << 7;
inline constexpr std::uint16_t remote = 1 << 9;  ///< controlwords are obeyed
inline constexpr std::uint16_t target_reached = 1 << 10;
inline constexpr std::uint16_t internal_limit = 1 << 11;
inline constexpr std::uint16_t set_point_acknowledged = 1 << 12;  ///< profile position
inline constexpr std::uint16_t speed_is_zero = 1 << 12;           ///< profile velocity
inline constexpr std::uint16_t homing_attained = 1 << 12;         ///< homing
inline constexpr std::uint16_t interpolates = 1 << 12;            ///< interpolated position: it is active
inline constexpr std::uint16_t follows = 1 << 12;                 ///< cyclic modes: the target is not ignored
inline constexpr std::uint16_t following_error = 1 << 13;         ///< position modes
inline constexpr std::uint16_t homing_error = 1 << 13;            ///< homing
}  // namespace status_bit

/// Whole controlwords that lead from state to state.
namespace command {
inline constexpr std::uint16_t disable_voltage = 0x0000;
inline constexpr std::uint16_t quick_stop = 0x0002;
inline constexpr std::uint16_t shutdown = 0x0006;
inline constexpr std::uint16_t switch_on = 0x0007;
inline constexpr std::uint16_t enable_operation = 0x000F;
inline constexpr std::uint16_t fault_reset = 0x0080;  ///< acts when bit 7 rises
}  // namespace command

/// Bits of the controlword that are added to enable_operation.
namespace control_bit {
inline constexpr std::uint16_t new_set_point = 1 << 4;       ///< profile position; when it rises
inline constexpr std::uint16_t change_immediately = 1 << 5;  ///< profile position
inline constexpr std::uint16_t relative = 1 << 6;            ///< profile position: to the last target
inline constexpr std::uint16_t start_homing = 1 << 4;        ///< homing
inline constexpr std::uint16_t interpolate = 1 << 4;         ///< interpolated position; while it is set
inline constexpr std::uint16_t halt = 1 << 8;                ///< profile modes and homing
}  // namespace control_bit

}  // namespace flexrf::canopen::cia402
