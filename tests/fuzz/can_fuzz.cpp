// What comes from a CAN bus: error frames of the kernel, network management, and process data by any plan.
#include <cstring>

#include "hal/can/socket_can/can_error_frame.hpp"
#include "hal/canopen/nmt.hpp"
#include "hal/canopen/pdo.hpp"
#include "tests/fuzz/can_message.hpp"

namespace flexrf::fuzz {
namespace {

using namespace canopen;

void take_error_frame(Source& source) {
  can_frame frame{};
  const std::span<const std::uint8_t> bytes = source.some(sizeof(frame));
  if (!bytes.empty()) std::memcpy(&frame, bytes.data(), bytes.size());
  frame.can_id |= CAN_ERR_FLAG;
  const CanErrorReport report = read_error_frame(frame);
  expect(report.has_counters || (report.transmit_errors == 0 && report.receive_errors == 0));
}

void take_management(Source& source) {
  const std::uint8_t node = static_cast<std::uint8_t>(1 + source.byte() % highest_node);
  const Message message = message_from(source);
  if (const auto state = heartbeat_of(message, node)) {
    expect(message.identifier == heartbeat_base + node && name_of(*state) != nullptr);
  }
  const auto command = nmt_command_for(message, node);
  expect(!command || message.identifier == nmt_identifier);
}

/// What is taken out of a message, packed again, are the same bits.
void take_process_data(Source& source) {
  PdoPlan plan;
  plan.identifier = 0x181;
  for (std::uint8_t left = source.byte() % 10; left > 0; --left) {
    const std::uint8_t bits = static_cast<std::uint8_t>(1 + source.byte() % 64);
    plan.add({0x6000, left}, bits);
  }
  expect(plan.bits() <= 64 && plan.count <= PdoPlan::most_entries);
  Message message = message_from(source);
  message.identifier = plan.identifier;
  std::array<std::uint64_t, PdoPlan::most_entries> values{};
  if (!unpack(plan, message, std::span(values).first(plan.count))) return;
  expect(!message.remote && message.size >= plan.bytes());
  for (std::uint8_t i = 0; i < plan.count; ++i) {
    const std::uint8_t bits = plan.entries[i].bits;
    expect(bits == 64 || values[i] >> bits == 0);
    static_cast<void>(with_sign(values[i], bits));
  }
  const Message packed = pack(plan, std::span<const std::uint64_t>(values).first(plan.count));
  std::array<std::uint64_t, PdoPlan::most_entries> again{};
  expect(unpack(plan, packed, std::span(again).first(plan.count)) && again == values);
}

}  // namespace

std::vector<Bytes> seeds() {
  std::vector<Bytes> all{{0, 0x04, 0, 0, 0x20, 8, 0, 0, 0, 0, 0x30, 0, 0, 0, 0, 130, 7}};
  Bytes heartbeat{1, 4};
  append(heartbeat, heartbeat_message(NmtState::operational, 5));
  Bytes command{1, 4};
  append(command, nmt_message(NmtCommand::reset_node, 5));
  Bytes data{2, 3, 15, 31, 7};
  append(data, {0x181, 8, {1, 2, 3, 4, 5, 6, 7, 8}});
  all.insert(all.end(), {heartbeat, command, data});
  return all;
}

void take(std::span<const std::uint8_t> bytes) {
  Source source(bytes);
  switch (source.byte() % 3) {
    case 0:
      return take_error_frame(source);
    case 1:
      return take_management(source);
    default:
      return take_process_data(source);
  }
}

}  // namespace flexrf::fuzz
