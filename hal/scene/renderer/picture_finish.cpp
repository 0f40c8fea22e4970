#include "hal/scene/renderer/picture_finish.hpp"

#include <algorithm>
#include <cmath>

#include "hal/scene/world/scene_random.hpp"

namespace flexrf {

void PictureNoise::begin(std::uint64_t seed, double deviation, std::size_t row_bytes) {
  SceneRandom random;
  random.seed(seed);
  seed_ = random.bits();
  table_.resize(size + row_bytes);
  // The sum of twelve even numbers, which has a deviation of 1, is as good as normal.
  for (std::size_t i = 0; i < size; ++i) {
    double sum = -6;
    for (int part = 0; part < 12; ++part) sum += random.between(0, 1);
    table_[i] = static_cast<std::int8_t>(std::floor(sum * deviation + 0.5));
  }
  std::copy_n(table_.begin(), row_bytes, table_.begin() + size);
}

const std::int8_t* PictureNoise::row(std::uint64_t frame, std::uint32_t row) const noexcept {
  SceneRandom random;
  random.seed(seed_ + (frame << 16U) + row);
  return &table_[random.bits() % size];
}

void PictureFinish::begin(std::uint32_t width, std::uint32_t height) {
  height_ = height;
  row_bytes_ = std::size_t{3} * width;
  rows_.assign(3 * row_bytes_, 0);
  sums_.assign(row_bytes_ + 6, 0);
}

namespace {

// Loops that a compiler makes of vectors: what is written overlaps nothing that is read.

void add_rows(std::size_t count, const std::uint8_t* __restrict above, const std::uint8_t* __restrict here,
              const std::uint8_t* __restrict below, std::uint16_t* __restrict sums) noexcept {
  for (std::size_t i = 0; i < count; ++i)
    sums[i] = static_cast<std::uint16_t>(above[i] + 2 * here[i] + below[i]);
}

void add_columns(std::size_t count, const std::uint16_t* __restrict sums, const std::int8_t* __restrict noise,
                 std::uint8_t* __restrict finished) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const auto blurred = static_cast<std::int16_t>((sums[i] + 2 * sums[i + 3] + sums[i + 6] + 8) >> 4);
    const auto level = static_cast<std::int16_t>(blurred + noise[i]);
    const std::int16_t kept = level < 0 ? std::int16_t{0} : level > 255 ? std::int16_t{255} : level;
    finished[i] = static_cast<std::uint8_t>(kept);
  }
}

}  // namespace

void PictureFinish::finish_row(std::uint32_t row, const std::int8_t* noise, std::uint8_t* finished) noexcept {
  const std::uint8_t* const here = sharp_row(row);
  const std::uint8_t* const above = row == 0 ? here : sharp_row(row - 1);
  const std::uint8_t* const below = row + 1 == height_ ? here : sharp_row(row + 1);
  add_rows(row_bytes_, above, here, below, &sums_[3]);
  for (std::size_t i = 0; i < 3; ++i) {
    sums_[i] = sums_[i + 3];
    sums_[row_bytes_ + 3 + i] = sums_[row_bytes_ + i];
  }
  add_columns(row_bytes_, sums_.data(), noise, finished);
}

}  // namespace flexrf
