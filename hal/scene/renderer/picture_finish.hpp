// What a lens and a sensor make of a picture: blur and noise.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace flexrf {

/// Noise of a sensor, from a table that a seed makes: each row of each frame begins at another place in it.
class PictureNoise {
 public:
  /// `deviation`: standard deviation in grey levels, 0 to 20. `row_bytes`: of the longest row. Allocates.
  void begin(std::uint64_t seed, double deviation, std::size_t row_bytes);
  /// As many as a row has bytes.
  const std::int8_t* row(std::uint64_t frame, std::uint32_t row) const noexcept;

 private:
  static constexpr std::size_t size = 1U << 16U;

  std::vector<std::int8_t> table_;
  std::uint64_t seed_ = 0;
};

/// The 3 x 3 binomial kernel, (1 2 1)/4 along rows and columns, then noise, for a picture that comes row by
/// row from above. At the edges the last pixel counts twice. Whole numbers alone, rounded to the nearest.
class PictureFinish {
 public:
  /// Allocates.
  void begin(std::uint32_t width, std::uint32_t height);

  /// Where row `row` of the sharp picture is to be written, 3 bytes a pixel; from 0 on, one after the other.
  std::uint8_t* sharp_row(std::uint32_t row) noexcept { return &rows_[row % 3 * row_bytes_]; }
  /// Makes row `row`, once the sharp row after it (if there is one) was written. `noise`: of that row.
  void finish_row(std::uint32_t row, const std::int8_t* noise, std::uint8_t* finished) noexcept;

 private:
  std::uint32_t height_ = 0;
  std::size_t row_bytes_ = 0;
  std::vector<std::uint8_t> rows_;   // three, in turn
  std::vector<std::uint16_t> sums_;  // over three rows, four times as much; with a pixel more at either end
};

}  // namespace flexrf
