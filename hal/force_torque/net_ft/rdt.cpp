#include "hal/force_torque/net_ft/rdt.hpp"

namespace flexrf::rdt {
namespace {

constexpr std::uint16_t request_mark = 0x1234;

std::uint32_t number_at(const std::uint8_t* bytes) noexcept {
  return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U | std::uint32_t{bytes[2]} << 8U |
         bytes[3];
}

void put(std::uint32_t number, std::uint8_t* bytes) noexcept {
  for (unsigned i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(number >> (24U - 8U * i));
}

}  // namespace

Record decode(std::span<const std::uint8_t, record_bytes> bytes) noexcept {
  Record record;
  record.sequence = number_at(&bytes[0]);
  record.sample = number_at(&bytes[4]);
  record.status = number_at(&bytes[8]);
  for (std::size_t i = 0; i < 3; ++i) {
    record.force[i] = static_cast<std::int32_t>(number_at(&bytes[12 + 4 * i]));
    record.torque[i] = static_cast<std::int32_t>(number_at(&bytes[24 + 4 * i]));
  }
  return record;
}

RecordBytes encode(const Record& record) noexcept {
  RecordBytes bytes{};
  put(record.sequence, &bytes[0]);
  put(record.sample, &bytes[4]);
  put(record.status, &bytes[8]);
  for (std::size_t i = 0; i < 3; ++i) {
    put(static_cast<std::uint32_t>(record.force[i]), &bytes[12 + 4 * i]);
    put(static_cast<std::uint32_t>(record.torque[i]), &bytes[24 + 4 * i]);
  }
  return bytes;
}

std::optional<Request> decode_request(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() != request_bytes || number_at(bytes.data()) >> 16U != request_mark) return std::nullopt;
  const auto command = static_cast<std::uint16_t>(number_at(bytes.data()));
  return Request{static_cast<Command>(command), number_at(&bytes[4])};
}

RequestBytes encode(const Request& request) noexcept {
  RequestBytes bytes{};
  put(std::uint32_t{request_mark} << 16U | static_cast<std::uint16_t>(request.command), &bytes[0]);
  put(request.count, &bytes[4]);
  return bytes;
}

}  // namespace flexrf::rdt
