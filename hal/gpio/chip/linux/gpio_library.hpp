// LibraryLine: a requested line, as the installed libgpiod gives it. The seam between its versions, whose
// interfaces differ: gpio_library_v1.cpp is compiled where pkg-config says 1.x, else gpio_library_v2.cpp.
#pragma once

#include <memory>

#include "hal/gpio/chip/interface/gpio_chip.hpp"

namespace flexrf {

/// Requesting and destroying may block and allocate; everything else does neither, any one thread.
class LibraryLine {
 public:
  /// `chip`: a path, a name, or a label. Edges of inputs are told, both directions.
  static Result<std::unique_ptr<LibraryLine>> request(const char* chip, const GpioLineSettings& settings);
  /// Whether the chip can be opened at all.
  static Status probe(const char* chip);

  virtual ~LibraryLine() = default;
  /// 1: on, 0: off; else −errno.
  virtual int value() noexcept = 0;
  /// 0, else −errno.
  virtual int set(bool on) noexcept = 0;
  /// 1: an edge, 0: none is there; else −errno.
  virtual int next_edge(GpioEdge& edge) noexcept = 0;
  /// Readable when an edge is there; −1: an output.
  virtual int descriptor() const noexcept = 0;
};

}  // namespace flexrf
