#pragma once

#include <cstddef>
#include <cstdint>

#include "camera_unit.hpp"

namespace flexrf::user {

class Camera final : public CameraUnit {
 public:
  void step(const Tick& tick) override {
    auto loan = picture.loan();
    if (!loan) return;
    constexpr std::uint32_t columns = 160;
    constexpr std::uint32_t rows = 120;
    loan->width = columns;
    loan->height = rows;
    loan->format = PixelFormat::rgb24;
    const auto wandering = static_cast<std::uint32_t>(tick.number % columns);
    std::size_t place = 0;
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        const std::uint32_t bar = column / (columns / 8);
        const bool white = column == wandering;
        for (const std::uint32_t bit : {4U, 2U, 1U})
          loan->data[place++] = static_cast<std::uint8_t>(white || (bar & bit) != 0 ? 220 : 30);
      }
    }
    loan.publish();
    ++feedback.pictures;
  }
};

}  // namespace flexrf::user
