// TableLight: the colour that the table has in the present light, from a whole picture.
#pragma once

#include <array>
#include <cstdint>

#include "units/vision/colour_classes.hpp"
#include "units/vision/picture_view.hpp"

namespace flexrf::user {

/// A region's surroundings need not be the table: they may be an obstacle's top, a shadow, a bin, other
/// parts. Of a whole picture the table is what is bright, and grey as light makes it, and not rare: shadows
/// and grey obstacles are darker, what is brighter is small. Where a picture shows too little of that, as
/// near above an obstacle, the light is as it was. Of one thread; allocates nothing.
class TableLight {
 public:
  /// `blind`: where nothing is seen. False: no such colour was found, and the light is taken as it was.
  /// 8480 pixels are looked at, whatever the picture's size is.
  bool look(const PictureView& picture, const PixelRectangle& blind, const ColourClasses& classes) noexcept;

  /// Less than a quarter of the last picture had a colour that light makes of the table: the light is
  /// coloured.
  bool sees_no_grey() const noexcept { return sees_no_grey_; }

  const WhiteBalance& balance() const noexcept { return balance_; }
  void forget() noexcept { *this = {}; }

 private:
  static constexpr std::uint32_t levels = 256;  // of brightness
  struct Level {
    std::uint32_t count = 0;
    std::array<std::uint32_t, 3> sums{};
  };
  std::uint32_t around(std::uint32_t level) const noexcept;
  std::uint32_t brightest(std::uint32_t least) const noexcept;

  std::array<Level, levels> histogram_{};
  WhiteBalance balance_;
  double brightness_ = 0;  // of the table, sum of the channels; 0: not yet known
  bool sees_no_grey_ = false;
};

}  // namespace flexrf::user
