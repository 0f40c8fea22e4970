#include "hal/gripper/robotiq/robotiq_registers.hpp"

namespace flexrf::robotiq {
namespace {

constexpr ModbusRegister row(const char* name, std::uint16_t address, ModbusAccess access) {
  return {name,
          address,
          ModbusArea::holding_register,
          ModbusType::u16,
          ModbusWordOrder::abcd,
          access,
          ModbusPollGroup::fast,
          1,
          "",
          0};
}

constexpr ModbusRegister rows[] = {
    row("action", first_written, ModbusAccess::write),
    row("position", first_written + 1, ModbusAccess::write),
    row("speed_and_force", first_written + 2, ModbusAccess::write),
    row("status", first_told, ModbusAccess::read),
    row("fault_and_request", first_told + 1, ModbusAccess::read),
    row("position_and_current", first_told + 2, ModbusAccess::read),
};
constexpr ModbusRegisterMap map{rows};

constexpr unsigned high(std::uint16_t word) {
  return word >> 8U;
}
constexpr unsigned low(std::uint16_t word) {
  return word & 0xFFU;
}
constexpr std::uint16_t join(unsigned high_byte, unsigned low_byte) {
  return static_cast<std::uint16_t>((high_byte << 8U) | low_byte);
}

}  // namespace

const ModbusRegisterMap& register_map() noexcept {
  return map;
}

Words encode(const Action& action) noexcept {
  const unsigned bits = (action.activate ? 1U : 0U) | (action.go ? 8U : 0U);
  return {join(bits, 0), join(0, action.position), join(action.speed, action.force)};
}

Action action_in(const Words& words) noexcept {
  const unsigned bits = high(words[0]);
  return {.activate = (bits & 1U) != 0,
          .go = (bits & 8U) != 0,
          .position = static_cast<std::uint8_t>(low(words[1])),
          .speed = static_cast<std::uint8_t>(high(words[2])),
          .force = static_cast<std::uint8_t>(low(words[2]))};
}

Told decode(const Words& words) noexcept {
  const unsigned status = high(words[0]);
  return {.activate = (status & 1U) != 0,
          .go = (status & 8U) != 0,
          .activation = static_cast<Activation>((status >> 4U) & 3U),
          .found = static_cast<Found>((status >> 6U) & 3U),
          .fault = static_cast<std::uint8_t>(high(words[1]) & 0x0FU),
          .requested = static_cast<std::uint8_t>(low(words[1])),
          .position = static_cast<std::uint8_t>(high(words[2])),
          .current = static_cast<std::uint8_t>(low(words[2]))};
}

Words encode(const Told& told) noexcept {
  const unsigned status = (told.activate ? 1U : 0U) | (told.go ? 8U : 0U) |
                          (static_cast<unsigned>(told.activation) << 4U) |
                          (static_cast<unsigned>(told.found) << 6U);
  return {join(status, 0), join(told.fault, told.requested), join(told.position, told.current)};
}

std::uint8_t status_byte(const Words& words) noexcept {
  return static_cast<std::uint8_t>(high(words[0]));
}

const char* describe_fault(std::uint8_t fault) noexcept {
  switch (fault) {
    case 0x00:
    case 0x05:  // an action waits for the activation
    case 0x07:  // an action without activation
      return "";
    case 0x08:
      return "it is too hot and waits until it has cooled down; grip with less force, or less often";
    case 0x09:
      return "it was told nothing for a second; look after the line, and whether its thread is held up";
    case 0x0A:
      return "its supply is too low; check the 24 V at its plug, then activate it";
    case 0x0B:
      return "its automatic release is under way; wait until it has ended, then activate it";
    case 0x0C:
      return "an internal fault; switch it off and on, and ask its maker if that does not help";
    case 0x0D:
      return "its activation failed; is something in the fingers' way? Clear it, then activate it";
    case 0x0E:
      return "its motor takes too much current; are the fingers blocked or forced? Free them, then activate "
             "it";
    case 0x0F:
      return "its automatic release was carried out; find out who asked for it, then activate it";
    default:
      break;
  }
  return "a fault that this driver has no words for; see the gripper's manual, then activate it";
}

}  // namespace flexrf::robotiq
