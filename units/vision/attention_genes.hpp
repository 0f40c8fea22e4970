// What evolution may change of a member of attention, and what a member costs by declaration.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "units/vision/integral_images.hpp"

namespace flexrf::user {

inline constexpr std::size_t most_members = 16;
inline constexpr std::size_t most_regions = 8;      ///< of a member for one picture
inline constexpr std::uint16_t no_member = 0xFFFF;  ///< in regions: the predicted place of a track

enum Gene : std::size_t {
  gene_colour,
  gene_contrast,
  gene_motion,
  gene_size,
  gene_edges,
  gene_expectation,
  gene_spacing,
  gene_smallest,
  gene_selectivity,
  gene_regions,
  gene_count
};
/// As the runtime parameters of the unit `attention` are called.
inline constexpr std::array<std::string_view, gene_count> gene_names{
    "colour",      "contrast", "motion",   "size",        "edges",
    "expectation", "spacing",  "smallest", "selectivity", "regions"};
using Genes = std::array<double, gene_count>;

/// The windows of one size: squares on a grid, in pixels of the half-size picture.
struct WindowGrid {
  std::uint32_t side = 0;
  std::uint32_t step = 0;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
};
inline constexpr std::size_t window_sizes = 3;
inline constexpr std::uint32_t most_windows = 4608;
/// `smallest`: side of the smallest, the others are 1.6 and 2.5 times as large; `spacing`: from one to the
/// next, as part of the side.
std::array<WindowGrid, window_sizes> window_grids(double smallest, double spacing) noexcept;
std::uint32_t window_count(const std::array<WindowGrid, window_sizes>& grids) noexcept;

// Declared cost, in values that are read: never a clock, so that the same run judges the same.
inline constexpr double values_per_window = 32;    ///< 6 sums of the window, 2 of what surrounds it
inline constexpr double values_per_region = 2000;  ///< beside its pixels: contour and fits
/// Each member's part of making the features, which are made once for all.
inline constexpr double values_of_features =
    static_cast<double>(picture_row_bytes) * picture_height / static_cast<double>(most_members);

/// Of one picture, with as many regions as it may have, of middle size.
double declared_cost(const Genes& genes) noexcept;

/// The number in brackets of a member's name, as 3 of "attention[3]"; 0: there is none.
std::uint16_t member_number(std::string_view name) noexcept;

/// Numbers that are the same in every run and on every machine (xoshiro256**, Blackman and Vigna 2018; begun
/// by SplitMix64).
class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) noexcept;
  std::uint64_t next() noexcept;
  /// In [0, 1).
  double uniform() noexcept { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /// From 0 to count - 1; count above 0.
  std::size_t below(std::size_t count) noexcept {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }
  /// Of mean 0 and deviation 1: twelve uniform ones, so never beyond 6.
  double normal() noexcept;

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace flexrf::user
