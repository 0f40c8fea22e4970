#include "hal/canopen/cia402.hpp"

namespace flexrf::canopen::cia402 {

const char* name_of(DriveState state) noexcept {
  switch (state) {
    case DriveState::unknown:
      return "in no state of CiA 402";
    case DriveState::not_ready:
      return "not ready to switch on";
    case DriveState::switch_on_disabled:
      return "switch on disabled";
    case DriveState::ready_to_switch_on:
      return "ready to switch on";
    case DriveState::switched_on:
      return "switched on";
    case DriveState::operation_enabled:
      return "operation enabled";
    case DriveState::quick_stop_active:
      return "quick stop active";
    case DriveState::fault_reaction:
      return "fault reaction active";
    case DriveState::fault:
      return "fault";
  }
  return "in no state of CiA 402";
}

// Voltage enabled (bit 4) and remote (bit 9) say nothing of the state; not all drives set them.
DriveState state_of(std::uint16_t statusword) noexcept {
  switch (statusword & 0x004F) {
    case 0x0000:
      return DriveState::not_ready;
    case 0x0040:
      return DriveState::switch_on_disabled;
    case 0x000F:
      return DriveState::fault_reaction;
    case 0x0008:
      return DriveState::fault;
    default:
      break;
  }
  switch (statusword & 0x006F) {
    case 0x0021:
      return DriveState::ready_to_switch_on;
    case 0x0023:
      return DriveState::switched_on;
    case 0x0027:
      return DriveState::operation_enabled;
    case 0x0007:
      return DriveState::quick_stop_active;
    default:
      return DriveState::unknown;
  }
}

bool has_torque(DriveState state) noexcept {
  switch (state) {
    case DriveState::operation_enabled:
    case DriveState::quick_stop_active:
    case DriveState::fault_reaction:
    case DriveState::unknown:
      return true;
    default:
      return false;
  }
}

}  // namespace flexrf::canopen::cia402
