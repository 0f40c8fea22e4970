// Registers of Robotiq's two-finger grippers (2F-85, 2F-140), as their manuals number the bits.
#pragma once

#include <array>
#include <cstdint>

#include "hal/modbus/link/interface/register_map.hpp"

namespace flexrf::robotiq {

inline constexpr std::uint16_t first_written = 0x03E8;
inline constexpr std::uint16_t first_told = 0x07D0;
inline constexpr std::uint8_t usual_unit_id = 9;
inline constexpr double current_step = 0.01;  ///< A

/// Three registers to write, then three to read, in the order of the words below.
const ModbusRegisterMap& register_map() noexcept;

using Words = std::array<std::uint16_t, 3>;

/// What it shall do. Counts 0 to 255.
struct Action {
  bool activate = false;      ///< rACT; stays set, else it is reset
  bool go = false;            ///< rGTO: to the position; else it stops
  std::uint8_t position = 0;  ///< rPR: 0 is open
  std::uint8_t speed = 0;     ///< rSP
  std::uint8_t force = 0;     ///< rFR
  bool operator==(const Action&) const = default;
};
Words encode(const Action& action) noexcept;
Action action_in(const Words& words) noexcept;

enum class Activation : std::uint8_t { reset = 0, activating = 1, active = 3 };
enum class Found : std::uint8_t { moving = 0, while_opening = 1, while_closing = 2, nothing = 3 };

/// What it says.
struct Told {
  bool activate = false;                      ///< gACT, echo of rACT
  bool go = false;                            ///< gGTO, echo of rGTO
  Activation activation = Activation::reset;  ///< gSTA
  Found found = Found::moving;                ///< gOBJ; means something while `go` is set alone
  std::uint8_t fault = 0;                     ///< gFLT
  std::uint8_t requested = 0;                 ///< gPR, echo of rPR
  std::uint8_t position = 0;                  ///< gPO
  std::uint8_t current = 0;                   ///< gCU, in steps of current_step

  bool is_active() const noexcept { return activate && activation == Activation::active; }
};
Told decode(const Words& words) noexcept;
Words encode(const Told& told) noexcept;
/// The gripper status as a whole, reserved bits among them.
std::uint8_t status_byte(const Words& words) noexcept;

/// From here on a fault ends only when rACT is taken away and given again.
inline constexpr std::uint8_t first_major_fault = 0x0A;
/// What the fault is and what a person can do; empty for 0 and for what only says that it is not activated.
const char* describe_fault(std::uint8_t fault) noexcept;

}  // namespace flexrf::robotiq
