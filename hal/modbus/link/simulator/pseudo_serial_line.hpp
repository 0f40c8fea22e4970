#pragma once

#include <string>

#include "base/status.hpp"

namespace flexrf {

/// A pseudo-terminal in the place of a serial line and its adapter: a station on one end, whoever opens
/// path() on the other. Knows no baud rate and no parity.
class PseudoSerialLine {
 public:
  PseudoSerialLine() = default;
  PseudoSerialLine(const PseudoSerialLine&) = delete;
  PseudoSerialLine& operator=(const PseudoSerialLine&) = delete;
  ~PseudoSerialLine() { close(); }

  Status open();
  /// As an adapter that is unplugged: whoever has path() open gets errors from then on.
  void close() noexcept;
  int descriptor() const noexcept { return near_; }
  const std::string& path() const noexcept { return path_; }

 private:
  int near_ = -1;
  int far_ = -1;  // held open, so that the line survives while nobody has opened it
  std::string path_;
};

}  // namespace flexrf
