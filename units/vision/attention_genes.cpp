#include "units/vision/attention_genes.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

constexpr std::array<double, window_sizes> size_factors{1.0, 1.6, 2.5};

std::uint64_t rotated(std::uint64_t value, int by) {
  return (value << by) | (value >> (64 - by));
}

}  // namespace

std::array<WindowGrid, window_sizes> window_grids(double smallest, double spacing) noexcept {
  std::array<WindowGrid, window_sizes> grids;
  for (std::size_t i = 0; i < window_sizes; ++i) {
    const double side = std::clamp(std::round(smallest * size_factors[i]), 8.0, double{feature_height});
    grids[i].side = static_cast<std::uint32_t>(side);
    grids[i].step = std::max(static_cast<std::uint32_t>(std::lround(side * spacing)), 4U);
    grids[i].columns = (feature_width - grids[i].side) / grids[i].step + 1;
    grids[i].rows = (feature_height - grids[i].side) / grids[i].step + 1;
  }
  return grids;
}

std::uint32_t window_count(const std::array<WindowGrid, window_sizes>& grids) noexcept {
  std::uint32_t count = 0;
  for (const WindowGrid& grid : grids) count += grid.columns * grid.rows;
  return count;
}

double declared_cost(const Genes& genes) noexcept {
  const auto grids = window_grids(genes[gene_smallest], genes[gene_spacing]);
  // Regions are taken from the camera's picture, which has twice as many pixels along a side.
  const double side = 2.0 * grids[1].side;
  return values_of_features + values_per_window * window_count(grids) +
         genes[gene_regions] * (values_per_region + side * side);
}

std::uint16_t member_number(std::string_view name) noexcept {
  const std::size_t bracket = name.find('[');
  if (bracket == std::string_view::npos) return 0;
  std::uint32_t number = 0;
  for (std::size_t i = bracket + 1; i < name.size() && name[i] >= '0' && name[i] <= '9' && number < 6000; ++i)
    number = number * 10 + static_cast<std::uint32_t>(name[i] - '0');
  return static_cast<std::uint16_t>(number);
}

RandomSource::RandomSource(std::uint64_t seed) noexcept {
  for (std::uint64_t& word : state_) {
    seed += 0x9E3779B97F4A7C15U;
    std::uint64_t mixed = seed;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBU;
    word = mixed ^ (mixed >> 31);
  }
}

std::uint64_t RandomSource::next() noexcept {
  const std::uint64_t result = rotated(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = rotated(state_[3], 45);
  return result;
}

double RandomSource::normal() noexcept {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += uniform();
  return sum;
}

}  // namespace flexrf::user
