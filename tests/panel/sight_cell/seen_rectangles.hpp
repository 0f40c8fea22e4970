// What the cell's pictures show: who draws them and who tells of them know it from here.
#pragma once

#include <cstdint>

namespace flexrf::user {

struct SeenRectangle {
  std::uint16_t left;
  std::uint16_t top;
  std::uint16_t width;
  std::uint16_t height;

  bool holds(std::uint32_t column, std::uint32_t row) const {
    return column >= left && row >= top && column < std::uint32_t{left} + width &&
           row < std::uint32_t{top} + height;
  }
};
/// In the picture of this number.
inline SeenRectangle box_in(std::uint64_t number) {
  return {static_cast<std::uint16_t>(10 + number * 8 % 200), 60, 80, 60};
}
inline constexpr SeenRectangle resting_ball{200, 160, 50, 50};

}  // namespace flexrf::user
