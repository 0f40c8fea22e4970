#include "hal/canopen/pdo.hpp"

namespace flexrf::canopen {
namespace {

constexpr unsigned message_bits = 64;

constexpr std::uint64_t mask_of(unsigned bits) noexcept {
  return bits >= message_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

}  // namespace

bool PdoPlan::add(ObjectAddress object, std::uint8_t entry_bits, const char* entry_helps) noexcept {
  if (count == most_entries || entry_bits == 0 || bits() + entry_bits > message_bits) return false;
  entries[count++] = {object, entry_bits, entry_helps};
  return true;
}

unsigned PdoPlan::bits() const noexcept {
  unsigned sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += entries[i].bits;
  return sum;
}

ObjectAddress PdoPlan::communication(std::uint8_t subindex) const noexcept {
  const unsigned base = direction == PdoDirection::received_by_node ? 0x1400 : 0x1800;
  return {static_cast<std::uint16_t>(base + number - 1), subindex};
}

ObjectAddress PdoPlan::mapping(std::uint8_t subindex) const noexcept {
  const unsigned base = direction == PdoDirection::received_by_node ? 0x1600 : 0x1A00;
  return {static_cast<std::uint16_t>(base + number - 1), subindex};
}

Message pack(const PdoPlan& plan, std::span<const std::uint64_t> values) noexcept {
  Message message{plan.identifier, plan.bytes(), {}};
  std::uint64_t word = 0;
  unsigned at = 0;
  for (std::size_t i = 0; i < plan.count; ++i) {
    const unsigned bits = plan.entries[i].bits;
    word |= (values[i] & mask_of(bits)) << at;
    at += bits;
  }
  write_number(message.data.data(), message.size, word);
  return message;
}

bool unpack(const PdoPlan& plan, const Message& message, std::span<std::uint64_t> values) noexcept {
  if (message.identifier != plan.identifier || message.size < plan.bytes() || message.remote) return false;
  const std::uint64_t word = read_number(message.data.data(), std::min<std::size_t>(message.size, 8));
  unsigned at = 0;
  for (std::size_t i = 0; i < plan.count; ++i) {
    const unsigned bits = plan.entries[i].bits;
    values[i] = (word >> at) & mask_of(bits);
    at += bits;
  }
  return true;
}

}  // namespace flexrf::canopen
