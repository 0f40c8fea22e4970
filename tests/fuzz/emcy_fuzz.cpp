// Emergency messages of any node, and the words for their codes.
#include "hal/canopen/emergency.hpp"
#include "tests/fuzz/can_message.hpp"

namespace flexrf::fuzz {

using namespace canopen;

std::vector<Bytes> seeds() {
  Bytes bytes{4};
  append(bytes, emergency_message({0x8130, 0x11, {1, 2, 3, 4, 5}}, 5));
  Bytes reset{4};
  append(reset, emergency_message({}, 5));
  return {bytes, reset};
}

void take(std::span<const std::uint8_t> bytes) {
  Source source(bytes);
  while (!source.is_empty()) {
    const std::uint8_t node = static_cast<std::uint8_t>(1 + source.byte() % highest_node);
    const Message message = message_from(source);
    const auto emergency = emergency_of(message, node);
    if (!emergency) continue;
    expect(message.identifier == emergency_base + node && !message.remote);
    expect(describe_error_code(emergency->code)[0] != '\0');
    const Message again = emergency_message(*emergency, node);
    const auto same = emergency_of(again, node);
    expect(same && same->code == emergency->code && same->error_register == emergency->error_register &&
           same->own == emergency->own);
  }
}

}  // namespace flexrf::fuzz
