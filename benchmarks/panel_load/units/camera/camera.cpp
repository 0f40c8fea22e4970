#include "units/camera/camera.hpp"

#include <algorithm>
#include <cstddef>

namespace flexrf::user {
namespace {

constexpr std::uint32_t columns = 640;
constexpr std::uint32_t rows = 480;

/// Bars with soft shades and some grain, as what a camera sees is neither plain nor noise.
void paint(LargePicture& picture) {
  picture.width = columns;
  picture.height = rows;
  picture.format = PixelFormat::rgb24;
  std::uint32_t grain = 1;
  std::size_t place = 0;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t bar = column / (columns / 8);
      for (const std::uint32_t bit : {4U, 2U, 1U}) {
        grain = grain * 1664525U + 1013904223U;
        const std::uint32_t shade = ((bar & bit) != 0 ? 160U : 30U) + row / 8 + (grain >> 29);
        picture.data[place++] = static_cast<std::uint8_t>(shade);
      }
    }
  }
}

}  // namespace

Status Camera::initialise() {
  const Result<Recording*> recording = open_recording();
  if (!recording) return recording.status();
  recording_ = *recording;
  return {};
}

void Camera::step(const Tick& tick) {
  auto loan = picture.loan();
  if (!loan) return;
  // Buffers keep what they held: making pictures is not what is measured.
  if (loan->width != columns) paint(*loan);
  const std::size_t row = tick.number % 16;
  std::fill_n(&loan->data[row * columns * 3], columns * 3, static_cast<std::uint8_t>(tick.number));
  loan.publish();
  recording_->pictures.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace flexrf::user
