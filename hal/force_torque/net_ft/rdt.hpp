// RDT, by which ATI's sensors with a network port send what they measure: records in UDP datagrams, all
// numbers with the most significant byte first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace flexrf::rdt {

inline constexpr std::uint16_t usual_port = 49152;
inline constexpr std::size_t record_bytes = 36;
inline constexpr std::size_t request_bytes = 8;

using RecordBytes = std::array<std::uint8_t, record_bytes>;
using RequestBytes = std::array<std::uint8_t, request_bytes>;

struct Record {
  std::uint32_t sequence = 0;            ///< from 1 in each stream; wraps around
  std::uint32_t sample = 0;              ///< the sensor's own count of measurements
  std::uint32_t status = 0;              ///< bits, see ati_status.hpp
  std::array<std::int32_t, 3> force{};   ///< counts
  std::array<std::int32_t, 3> torque{};  ///< counts
};

enum class Command : std::uint16_t {
  stop = 0,
  stream = 2,  ///< a record to a datagram, at the rate that is set in the sensor
};

struct Request {
  Command command = Command::stop;
  std::uint32_t count = 0;  ///< of records; 0: without end
};

Record decode(std::span<const std::uint8_t, record_bytes> bytes) noexcept;
RecordBytes encode(const Record& record) noexcept;

/// Nothing: it is no request.
std::optional<Request> decode_request(std::span<const std::uint8_t> bytes) noexcept;
RequestBytes encode(const Request& request) noexcept;

}  // namespace flexrf::rdt
