// SerialPort: a serial line, raw.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/status.hpp"

namespace flexrf {

class SerialPort {
 public:
  SerialPort() = default;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort() { close(); }

  /// With 19200 bit/s, 8 data bits, no parity, one stop bit, and for nobody else. May wait for its driver.
  Status open(const char* device);
  void close() noexcept;
  bool is_open() const noexcept { return descriptor_ >= 0; }
  int descriptor() const noexcept { return descriptor_; }

  /// Bytes that were there, at most the buffer's; 0: none. Below 0: the line is lost. Never waits.
  int read(std::span<std::uint8_t> buffer) noexcept;
  /// What the line has no room for is left out. Never waits.
  void write(std::span<const std::uint8_t> bytes) noexcept;

 private:
  int descriptor_ = -1;
};

}  // namespace flexrf
