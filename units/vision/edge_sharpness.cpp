#include "units/vision/edge_sharpness.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

namespace flexrf::user {
namespace {

constexpr std::size_t reach = 8;  // pixels on either side: a blurred edge lies within
constexpr std::size_t every = 6;  // lines that are looked at
// Of a strong edge, as part of the mean luminance, within bounds of luminance (0 to 255): less is noise or
// shade.
constexpr double strong = 0.3;
constexpr double least_strong = 16;
constexpr double most_strong = 48;
constexpr std::size_t least_edges = 20;  // that lines cross: fewer may be of one dull thing
constexpr std::size_t levels = 50;       // of sharpness

class Histogram {
 public:
  explicit Histogram(int least_contrast) noexcept : least_contrast_(least_contrast) {}

  /// `line`: `count` pixels, each `step` behind the one before.
  void look_along(const std::uint8_t* line, std::size_t count, std::size_t step) noexcept {
    const auto rise = [&](std::size_t from, std::size_t to) {
      return std::abs(int{line[to * step]} - int{line[from * step]});
    };
    for (std::size_t i = reach; i + reach < count; ++i) {
      const int contrast = rise(i - reach, i + reach);
      if (contrast < least_contrast_) continue;
      // In the middle of the edge alone, so that all of the edge lies within reach.
      const int steepness = rise(i - 1, i + 1);
      bool is_steepest = true;
      for (std::size_t k = i - reach + 1; k < i + reach && is_steepest; ++k)
        is_steepest = rise(k - 1, k + 1) <= steepness;
      if (!is_steepest) continue;
      const auto level = static_cast<std::size_t>(steepness) * levels / static_cast<std::size_t>(contrast);
      ++counts_[std::min(level, levels - 1)];
      ++all_;
    }
  }
  std::optional<double> sharpest_tenth() const noexcept {
    if (all_ < least_edges) return std::nullopt;
    std::size_t level = levels;
    for (std::size_t above = 0; above * 10 < all_ && level > 0;) above += counts_[--level];
    return (static_cast<double>(level) + 0.5) / levels;
  }

 private:
  int least_contrast_ = 0;
  std::array<std::uint32_t, levels> counts_{};
  std::size_t all_ = 0;
};

}  // namespace

std::optional<double> edge_sharpness(std::span<const std::uint8_t> luminance, std::size_t width) noexcept {
  const std::size_t height = luminance.size() / width;
  const auto sum = std::accumulate(luminance.begin(), luminance.end(), std::uint64_t{0});
  const double mean = static_cast<double>(sum) / static_cast<double>(luminance.size());
  Histogram edges{static_cast<int>(std::clamp(strong * mean, least_strong, most_strong))};
  for (std::size_t row = every / 2; row < height; row += every)
    edges.look_along(luminance.data() + row * width, width, 1);
  for (std::size_t column = every / 2; column < width; column += every)
    edges.look_along(luminance.data() + column, height, width);
  return edges.sharpest_tenth();
}

}  // namespace flexrf::user
