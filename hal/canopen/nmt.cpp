#include "hal/canopen/nmt.hpp"

namespace flexrf::canopen {
namespace {

constexpr std::uint8_t toggle_bit = 0x80;  // of answers to guarding; without meaning in a heartbeat

}  // namespace

const char* name_of(NmtState state) noexcept {
  switch (state) {
    case NmtState::boot_up:
      return "boot-up";
    case NmtState::stopped:
      return "stopped";
    case NmtState::operational:
      return "operational";
    case NmtState::pre_operational:
      return "pre-operational";
  }
  return "a state of its own";
}

Message nmt_message(NmtCommand command, std::uint8_t node) noexcept {
  return {nmt_identifier, 2, {static_cast<std::uint8_t>(command), node}};
}

Message heartbeat_message(NmtState state, std::uint8_t node) noexcept {
  return {identifier_of(heartbeat_base, node), 1, {static_cast<std::uint8_t>(state)}};
}

Message guard_message(std::uint8_t node) noexcept {
  return {.identifier = identifier_of(heartbeat_base, node), .size = 1, .remote = true};
}

Message guard_answer(NmtState state, bool toggle, std::uint8_t node) noexcept {
  Message answer = heartbeat_message(state, node);
  if (toggle) answer.data[0] |= toggle_bit;
  return answer;
}

bool toggle_of(const Message& answer) noexcept {
  return (answer.data[0] & toggle_bit) != 0;
}

std::optional<NmtState> heartbeat_of(const Message& message, std::uint8_t node) noexcept {
  if (message.identifier != identifier_of(heartbeat_base, node)) return std::nullopt;
  if (message.size != 1 || message.remote) return std::nullopt;
  return static_cast<NmtState>(message.data[0] & ~toggle_bit);
}

std::optional<NmtCommand> nmt_command_for(const Message& message, std::uint8_t node) noexcept {
  if (message.identifier != nmt_identifier || message.size != 2 || message.remote) return std::nullopt;
  if (message.data[1] != 0 && message.data[1] != node) return std::nullopt;
  return static_cast<NmtCommand>(message.data[0]);
}

}  // namespace flexrf::canopen
