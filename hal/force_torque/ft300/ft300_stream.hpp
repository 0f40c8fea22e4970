// The line of a Robotiq FT300 or FT300-S: a Modbus request begins a stream of frames of its own, many bytes
// of ones end it. 19200 bit/s, 8 data bits, no parity, one stop bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/force_torque/interface/wrench_meter.hpp"

namespace flexrf::ft300 {

inline constexpr std::uint8_t usual_unit_id = 9;
inline constexpr std::size_t frame_bytes = 16;
inline constexpr std::size_t request_bytes = 11;
inline constexpr std::uint8_t stop_byte = 0xFF;
inline constexpr int stop_count = 50;

using FrameBytes = std::array<std::uint8_t, frame_bytes>;
using RequestBytes = std::array<std::uint8_t, request_bytes>;

struct Frame {
  std::array<std::int16_t, 3> force{};   ///< hundredths of N
  std::array<std::int16_t, 3> torque{};  ///< thousandths of N m
};

/// Of Modbus over serial line V1.02, 6.2.2.
std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept;
FrameBytes encode(const Frame& frame) noexcept;
RawWrench measured(const Frame& frame) noexcept;
/// "Write 0x0200 to register 410", which begins the stream.
RequestBytes stream_request(std::uint8_t unit_id) noexcept;

/// Finds frames in bytes as they come, and its way back to them after what is none.
class Decoder {
 public:
  /// Take the frame before the next byte.
  void put(std::uint8_t byte) noexcept;
  std::optional<Frame> take() noexcept;
  /// So often something came between two frames that is none.
  std::uint64_t damaged() const noexcept { return damaged_; }

 private:
  void drop_first() noexcept;

  FrameBytes window_{};
  std::size_t size_ = 0;
  std::optional<Frame> frame_;
  bool in_step_ = false;
  std::uint64_t damaged_ = 0;
};

}  // namespace flexrf::ft300
