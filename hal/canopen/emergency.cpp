#include "hal/canopen/emergency.hpp"

namespace flexrf::canopen {
namespace {

struct Meaning {
  std::uint16_t code;
  std::uint16_t mask;
  const char* words;
};

// The first that fits; classes after what is known more closely.
constexpr Meaning meanings[] = {
    {0x0000, 0xFF00, "no error any more"},
    {0x1000, 0xFF00, "a fault that the device does not name"},
    {0x2300, 0xFF00, "current at the device's output"},
    {0x2000, 0xF000, "current"},
    {0x3100, 0xFF00, "mains voltage"},
    {0x3200, 0xFF00, "voltage inside the device"},
    {0x3300, 0xFF00, "voltage at the device's output"},
    {0x3000, 0xF000, "voltage"},
    {0x4100, 0xFF00, "ambient temperature"},
    {0x4200, 0xFF00, "temperature of the device"},
    {0x4000, 0xF000, "temperature"},
    {0x5000, 0xF000, "the device's hardware"},
    {0x6000, 0xF000, "the device's software"},
    {0x7300, 0xFF00, "sensor or encoder"},
    {0x7000, 0xF000, "a module added to the device"},
    {0x8110, 0xFFFF, "CAN messages were lost in the device"},
    {0x8120, 0xFFFF, "the device's CAN is error passive: cable, termination or bit rate"},
    {0x8130, 0xFFFF, "the device no longer hears the heartbeat that it supervises"},
    {0x8140, 0xFFFF, "the device's CAN was bus-off and came back"},
    {0x8210, 0xFFFF, "a PDO was too short for its mapping"},
    {0x8220, 0xFFFF, "a PDO was longer than its mapping"},
    {0x8611, 0xFFFF, "following error"},
    {0x8612, 0xFFFF, "a position limit was reached"},
    {0x8000, 0xF000, "monitoring"},
    {0x9000, 0xF000, "something outside the device"},
    {0xF000, 0xFF00, "an additional function"},
    {0xFF00, 0xFF00, "an error of the device's own: see its manual"},
};

}  // namespace

std::optional<Emergency> emergency_of(const Message& message, std::uint8_t node) noexcept {
  if (message.identifier != identifier_of(emergency_base, node) || message.size != 8 || message.remote)
    return std::nullopt;
  Emergency emergency;
  emergency.code = static_cast<std::uint16_t>(read_number(message.data.data(), 2));
  emergency.error_register = message.data[2];
  std::copy_n(message.data.begin() + 3, emergency.own.size(), emergency.own.begin());
  return emergency;
}

Message emergency_message(const Emergency& emergency, std::uint8_t node) noexcept {
  Message message{identifier_of(emergency_base, node), 8, {}};
  write_number(message.data.data(), 2, emergency.code);
  message.data[2] = emergency.error_register;
  std::copy(emergency.own.begin(), emergency.own.end(), message.data.begin() + 3);
  return message;
}

const char* describe_error_code(std::uint16_t code) noexcept {
  for (const Meaning& meaning : meanings) {
    if ((code & meaning.mask) == meaning.code) return meaning.words;
  }
  return "an error that CiA 301 does not name";
}

}  // namespace flexrf::canopen
