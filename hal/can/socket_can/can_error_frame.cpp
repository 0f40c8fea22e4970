#include "hal/can/socket_can/can_error_frame.hpp"

#include <linux/can/error.h>

namespace flexrf {
namespace {

// Where the counters lie, and the flag that says that they do; kernels before 6.0 fill the bytes in without
// it, and their headers do not know it.
constexpr std::size_t transmit_errors_at = 6;
constexpr std::size_t receive_errors_at = 7;
constexpr canid_t counters_told = 0x200U;

std::optional<CanBusState> state_in(const can_frame& frame) noexcept {
  if ((frame.can_id & CAN_ERR_BUSOFF) != 0) return CanBusState::bus_off;
  if ((frame.can_id & CAN_ERR_RESTARTED) != 0) return CanBusState::error_active;
  if ((frame.can_id & CAN_ERR_CRTL) == 0) return std::nullopt;
  const unsigned detail = frame.data[1];
  if ((detail & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) return CanBusState::error_passive;
  // A warning is not yet passive, and one that comes after it is no longer.
  constexpr unsigned better = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING | CAN_ERR_CRTL_ACTIVE;
  if ((detail & better) != 0) return CanBusState::error_active;
  return std::nullopt;
}

}  // namespace

CanErrorReport read_error_frame(const can_frame& frame) noexcept {
  CanErrorReport report;
  report.state = state_in(frame);
  report.bus_error =
      (frame.can_id & (CAN_ERR_BUSERROR | CAN_ERR_PROT | CAN_ERR_ACK | CAN_ERR_TX_TIMEOUT)) != 0;
  report.arbitration_lost = (frame.can_id & CAN_ERR_LOSTARB) != 0;
  report.receive_overflow =
      (frame.can_id & CAN_ERR_CRTL) != 0 && (frame.data[1] & CAN_ERR_CRTL_RX_OVERFLOW) != 0;
  report.transmit_errors = frame.data[transmit_errors_at];
  report.receive_errors = frame.data[receive_errors_at];
  report.has_counters =
      (frame.can_id & counters_told) != 0 || report.transmit_errors != 0 || report.receive_errors != 0;
  return report;
}

}  // namespace flexrf
