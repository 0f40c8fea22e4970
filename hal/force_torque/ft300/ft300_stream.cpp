#include "hal/force_torque/ft300/ft300_stream.hpp"

#include <algorithm>

namespace flexrf::ft300 {
namespace {

constexpr std::uint8_t header[2] = {0x20, 0x4E};
constexpr std::size_t crc_at = frame_bytes - 2;
constexpr double counts_per_newton = 100;
constexpr double counts_per_newton_metre = 1000;

void put_crc(std::span<std::uint8_t> message) noexcept {
  const std::uint16_t crc = crc16(message.first(message.size() - 2));
  message[message.size() - 2] = static_cast<std::uint8_t>(crc & 0xFFU);
  message[message.size() - 1] = static_cast<std::uint8_t>(crc >> 8U);
}

std::int16_t number_at(const std::uint8_t* bytes) noexcept {
  return static_cast<std::int16_t>(bytes[0] | bytes[1] << 8U);
}

void put_number(std::int16_t number, std::uint8_t* bytes) noexcept {
  const auto bits = static_cast<std::uint16_t>(number);
  bytes[0] = static_cast<std::uint8_t>(bits & 0xFFU);
  bytes[1] = static_cast<std::uint8_t>(bits >> 8U);
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept {
  std::uint16_t crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc = static_cast<std::uint16_t>(crc ^ byte);
    for (int bit = 0; bit < 8; ++bit)
      crc = static_cast<std::uint16_t>((crc & 1U) != 0 ? (crc >> 1U) ^ 0xA001U : crc >> 1U);
  }
  return crc;
}

FrameBytes encode(const Frame& frame) noexcept {
  FrameBytes bytes{header[0], header[1]};
  for (std::size_t i = 0; i < 3; ++i) {
    put_number(frame.force[i], &bytes[2 + 2 * i]);
    put_number(frame.torque[i], &bytes[8 + 2 * i]);
  }
  put_crc(bytes);
  return bytes;
}

RawWrench measured(const Frame& frame) noexcept {
  RawWrench raw;
  for (std::size_t i = 0; i < 3; ++i) {
    raw.force[i] = frame.force[i] / counts_per_newton;
    raw.torque[i] = frame.torque[i] / counts_per_newton_metre;
  }
  return raw;
}

RequestBytes stream_request(std::uint8_t unit_id) noexcept {
  // Write Multiple Registers: from 410 = 0x019A on, one of two bytes.
  RequestBytes bytes{unit_id, 0x10, 0x01, 0x9A, 0x00, 0x01, 0x02, 0x02, 0x00};
  put_crc(bytes);
  return bytes;
}

void Decoder::put(std::uint8_t byte) noexcept {
  window_[size_++] = byte;
  while (size_ > 0) {
    const std::size_t known = std::min(size_, sizeof(header));
    const bool is_begun = std::equal(header, header + known, window_.begin());
    if (is_begun && size_ < frame_bytes) return;
    if (is_begun && crc16(std::span(window_).first<crc_at>()) ==
                        static_cast<std::uint16_t>(window_[crc_at] | window_[crc_at + 1] << 8U)) {
      Frame frame;
      for (std::size_t i = 0; i < 3; ++i) {
        frame.force[i] = number_at(&window_[2 + 2 * i]);
        frame.torque[i] = number_at(&window_[8 + 2 * i]);
      }
      frame_ = frame;
      in_step_ = true;
      size_ = 0;
      return;
    }
    drop_first();
  }
}

/// What is none may have a frame's beginning within.
void Decoder::drop_first() noexcept {
  if (in_step_) ++damaged_;
  in_step_ = false;
  std::copy(window_.begin() + 1, window_.begin() + static_cast<std::ptrdiff_t>(size_), window_.begin());
  --size_;
}

std::optional<Frame> Decoder::take() noexcept {
  const std::optional<Frame> frame = frame_;
  frame_.reset();
  return frame;
}

}  // namespace flexrf::ft300
