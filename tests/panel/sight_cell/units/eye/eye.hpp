#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "eye_unit.hpp"
#include "tests/panel/sight_cell/seen_rectangles.hpp"

namespace flexrf::user {

using Colour = std::array<std::uint8_t, 3>;
inline constexpr Colour ground_colour{150, 145, 135};
inline constexpr Colour box_colour{40, 80, 200};
inline constexpr Colour ball_colour{230, 120, 30};

class Eye final : public EyeUnit {
 public:
  void step(const Tick& tick) override {
    auto loan = view.loan();
    if (!loan) return;
    constexpr std::uint32_t columns = 320;
    constexpr std::uint32_t rows = 240;
    loan->width = columns;
    loan->height = rows;
    loan->format = PixelFormat::rgb24;
    loan->number = tick.number;
    const SeenRectangle box = box_in(tick.number);
    std::size_t place = 0;
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        const Colour& colour = resting_ball.holds(column, row) ? ball_colour
                               : box.holds(column, row)        ? box_colour
                                                               : ground_colour;
        for (const std::uint8_t part : colour) loan->data[place++] = part;
      }
    }
    loan.publish();
    ++feedback.pictures;
  }
};

}  // namespace flexrf::user
