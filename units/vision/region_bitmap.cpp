#include "units/vision/region_bitmap.hpp"

#include <algorithm>
#include <bit>

namespace flexrf::user {
namespace {

// Label of what is too small, or more than there is room for.
constexpr std::uint8_t dropped_label = 0xFF;

int cells(int pixels, int scale) {
  return (pixels + scale - 1) / scale;
}

using BitRow = std::array<std::uint64_t, 3>;

BitRow both(const BitRow& one, const BitRow& other) {
  return {one[0] & other[0], one[1] & other[1], one[2] & other[2]};
}
BitRow either(const BitRow& one, const BitRow& other) {
  return {one[0] | other[0], one[1] | other[1], one[2] | other[2]};
}
/// Each cell gets what its left neighbour has; the first one `first`.
BitRow moved_up(const BitRow& row, bool first) {
  return {row[0] << 1 | (first ? 1U : 0U), row[1] << 1 | row[0] >> 63, row[2] << 1 | row[1] >> 63};
}
/// Each cell gets what its right neighbour has; the last one what lies behind the row.
BitRow moved_down(const BitRow& row) {
  return {row[0] >> 1 | row[1] << 63, row[1] >> 1 | row[2] << 63, row[2] >> 1 | std::uint64_t{1} << 63};
}
void set(BitRow& row, int column) {
  const auto at = static_cast<std::size_t>(column);
  row[at / 64] |= std::uint64_t{1} << (at % 64);
}
/// Sets what lies behind the last cell.
void fill_behind(BitRow& row, int columns) {
  for (std::size_t word = 0; word < row.size(); ++word) {
    const int from = columns - static_cast<int>(64 * word);
    if (from <= 0)
      row[word] = ~std::uint64_t{0};
    else if (from < 64)
      row[word] |= ~std::uint64_t{0} << from;
  }
}

}  // namespace

void RegionBitmap::take(const PictureView& picture, const PixelRectangle& rectangle,
                        const PixelRectangle& blind, const ColourClasses& classes,
                        const WhiteBalance& balance, int least_scale) noexcept {
  rectangle_ = common_part(rectangle, {0, 0, picture.width, picture.height});
  blob_count_ = 0;
  columns_ = rows_ = 0;
  scale_ = 1;
  if (rectangle_.is_empty()) return;
  scale_ = std::max(cells(std::max(rectangle_.width, rectangle_.height), side), least_scale);
  least_cells_ = static_cast<std::uint32_t>(std::max(least_area / (scale_ * scale_), 6));
  columns_ = cells(rectangle_.width, scale_);
  rows_ = cells(rectangle_.height, scale_);
  if (balance_ != balance) {
    balance_ = balance;
    ColourClasses::find_places(balance_, places_);
  }
  classify(picture, blind, classes);
  drop_edges();
  find_blobs();
}

void RegionBitmap::classify(const PictureView& picture, const PixelRectangle& blind,
                            const ColourClasses& classes) noexcept {
  first_foreign_ = rows_;
  last_foreign_ = -1;
  for (int row = 0; row < rows_; ++row) {
    BitRow& foreign = foreign_[static_cast<std::size_t>(row)];
    foreign = {};
    std::uint8_t* const to = classes_.data() + place(0, row);
    const int y = rectangle_.top + row * scale_;
    for (int column = 0; column < columns_; ++column) {
      const int x = rectangle_.left + column * scale_;
      std::uint8_t found = classes.of(picture.at(x, y), places_);
      if (found == class_dark) found = is_shadow(picture, x, y, classes) ? class_table : class_foreign;
      to[column] = found;
      if (found == class_foreign) set(foreign, column);
    }
    if ((foreign[0] | foreign[1] | foreign[2]) == 0) continue;
    first_foreign_ = std::min(first_foreign_, row);
    last_foreign_ = row;
  }
  const PixelRectangle hidden = common_part(rectangle_, blind);
  if (hidden.is_empty()) return;
  const int last_column = (hidden.right() - 1 - rectangle_.left) / scale_;
  const int last_row = (hidden.bottom() - 1 - rectangle_.top) / scale_;
  for (int row = (hidden.top - rectangle_.top) / scale_; row <= last_row; ++row) {
    for (int column = (hidden.left - rectangle_.left) / scale_; column <= last_column; ++column) {
      classes_[place(column, row)] = class_unseen;
      set(foreign_[static_cast<std::size_t>(row)], column);
    }
  }
}

/// By the mean of four pixels, which has half of the noise; where they are dark by that of sixteen.
bool RegionBitmap::is_shadow(const PictureView& picture, int column, int row,
                             const ColourClasses& classes) const noexcept {
  const int right = std::min(column + 1, picture.width - 1);
  const int below = std::min(row + 1, picture.height - 1);
  const std::uint8_t* const above_left = picture.at(column, row);
  const std::uint8_t* const above_right = picture.at(right, row);
  const std::uint8_t* const below_left = picture.at(column, below);
  const std::uint8_t* const below_right = picture.at(right, below);
  // Written out: it is asked of each dark pixel.
  const auto sum = [&](std::size_t channel) {
    return std::uint32_t{above_left[channel]} + above_right[channel] + below_left[channel] +
           below_right[channel];
  };
  const std::array<std::uint32_t, 3> four{sum(0), sum(1), sum(2)};
  if (!ColourClasses::needs_more(four, 4)) return classes.is_shadow(four, 4, balance_);
  constexpr int width = 4;
  const int left = std::clamp(column - 1, 0, picture.width - width);
  const int top = std::clamp(row - 1, 0, picture.height - width);
  std::array<std::uint32_t, 3> sums{};
  for (int y = top; y < top + width; ++y)
    for (int x = left; x < left + width; ++x)
      for (std::size_t channel = 0; channel < 3; ++channel) sums[channel] += picture.at(x, y)[channel];
  return classes.is_shadow(sums, width * width, balance_);
}

/// Opening (Serra 1982) with squares of three cells: what is foreign shrinks by one cell, and what is left
/// grows by one. Of what is not seen nobody knows, so it lets things be.
void RegionBitmap::drop_edges() noexcept {
  const int first = std::max(first_foreign_ - 1, 0);
  const int last = std::min(last_foreign_ + 1, rows_ - 1);
  for (int row = first; row <= last; ++row) fill_behind(foreign_[static_cast<std::size_t>(row)], columns_);
  for (int row = first_foreign_; row <= last_foreign_; ++row) {
    BitRow all = foreign_[static_cast<std::size_t>(row)];
    for (const int other : {row - 1, row + 1})
      if (other >= 0 && other < rows_) all = both(all, foreign_[static_cast<std::size_t>(other)]);
    kept_[static_cast<std::size_t>(row)] = both(all, both(moved_up(all, true), moved_down(all)));
  }
  for (int row = first_foreign_; row <= last_foreign_; ++row) {
    BitRow any_of = kept_[static_cast<std::size_t>(row)];
    for (const int other : {row - 1, row + 1})
      if (other >= first_foreign_ && other <= last_foreign_)
        any_of = either(any_of, kept_[static_cast<std::size_t>(other)]);
    any_of = either(any_of, either(moved_up(any_of, false), moved_down(any_of)));
    const BitRow& foreign = foreign_[static_cast<std::size_t>(row)];
    for (std::size_t word = 0; word < foreign.size(); ++word) {
      for (std::uint64_t dropped = foreign[word] & ~any_of[word]; dropped != 0; dropped &= dropped - 1) {
        const int column = static_cast<int>(64 * word) + std::countr_zero(dropped);
        if (column >= columns_) break;
        std::uint8_t& of = classes_[place(column, row)];
        if (of == class_foreign) of = class_table;
      }
    }
  }
}

/// Cells of one class beside each other in a row are a run; runs of one class that touch from row to row are
/// a blob (Rosenfeld and Pfaltz 1966, by runs). Labels are used up only by what is large enough to be looked
/// at.
void RegionBitmap::find_blobs() noexcept {
  find_runs();
  std::uint8_t label = 0;
  for (std::size_t i = 0; i < run_count_; ++i) {
    Run& run = runs_[i];
    if (run.first != i) {
      run.label = runs_[run.first].label;
    } else if (label + 1 == dropped_label || run.area < least_cells_) {
      run.label = dropped_label;
    } else {
      run.label = ++label;
      keep(run);
    }
    std::fill(labels_.begin() + static_cast<std::ptrdiff_t>(place(run.from, run.row)),
              labels_.begin() + static_cast<std::ptrdiff_t>(place(run.to, run.row)), run.label);
  }
}

/// In the order of rows. Afterwards each knows the first run of its blob, which has the figures of all of it.
void RegionBitmap::find_runs() noexcept {
  run_count_ = 0;
  std::size_t above = 0;  // the first run of the row above
  for (int row = 0; row < rows_; ++row) {
    const std::size_t begin = run_count_;
    std::size_t upper = above;
    const std::uint8_t* const classes = classes_.data() + place(0, row);
    std::fill_n(labels_.data() + place(0, row), columns_, std::uint8_t{0});
    for (int column = 0; column < columns_;) {
      const int from = column;
      const std::uint8_t of = classes[from];
      while (++column < columns_ && classes[column] == of) {
      }
      if (of == class_table || of == class_unseen || run_count_ == runs_.size()) continue;
      Run& run = runs_[run_count_];
      run = {static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(column),
             static_cast<std::uint8_t>(row), of, static_cast<std::uint16_t>(run_count_)};
      ++run_count_;
      while (upper < begin && runs_[upper].to <= from) ++upper;
      for (std::size_t i = upper; i < begin && runs_[i].from < column; ++i)
        if (runs_[i].pixel_class == of) join(i, run_count_ - 1);
    }
    above = begin;
  }
  for (std::size_t i = 0; i < run_count_; ++i) {
    Run& run = runs_[i];
    run.first = runs_[run.first].first;  // that of a run before this one, which knows already
    runs_[run.first].add(run);
  }
}

/// Two runs of one blob. The first of all its runs stands for it.
void RegionBitmap::join(std::size_t one, std::size_t other) noexcept {
  const auto first_of = [this](std::size_t run) {
    while (runs_[run].first != run) run = runs_[run].first = runs_[runs_[run].first].first;
    return run;
  };
  one = first_of(one);
  other = first_of(other);
  runs_[std::max(one, other)].first = static_cast<std::uint16_t>(std::min(one, other));
}

void RegionBitmap::Run::add(const Run& other) noexcept {
  const std::uint32_t length = std::uint32_t{other.to} - other.from;
  area += length;
  columns += length * (std::uint32_t{other.from} + other.to - 1) / 2;
  rows += length * other.row;
  left = std::min(left, other.from);
  right = std::max(right, static_cast<std::uint8_t>(other.to - 1));
  bottom = other.row;
}

/// The blob that this run is the first of. In order of size; the smallest goes where there are too many.
void RegionBitmap::keep(const Run& first) noexcept {
  Blob blob;
  blob.pixel_class = first.pixel_class;
  blob.label = first.label;
  blob.area = static_cast<int>(first.area);
  blob.left = first.left;
  blob.top = first.row;
  blob.right = first.right;
  blob.bottom = first.bottom;
  blob.first_column = first.from;
  blob.middle_column = static_cast<double>(first.columns) / first.area + 0.5;
  blob.middle_row = static_cast<double>(first.rows) / first.area + 0.5;
  std::size_t at = blob_count_;
  while (at > 0 && blobs_[at - 1].area < blob.area) --at;
  if (at == most_blobs) return;
  if (blob_count_ < most_blobs) ++blob_count_;
  for (std::size_t i = blob_count_ - 1; i > at; --i) blobs_[i] = blobs_[i - 1];
  blobs_[at] = blob;
}

bool RegionBitmap::is_cut(const Blob& blob, const PictureView& picture) const noexcept {
  return (blob.left == 0 && rectangle_.left > 0) || (blob.top == 0 && rectangle_.top > 0) ||
         (blob.right == columns_ - 1 && rectangle_.right() < picture.width) ||
         (blob.bottom == rows_ - 1 && rectangle_.bottom() < picture.height);
}

PixelRectangle RegionBitmap::box_of(const Blob& blob) const noexcept {
  return {rectangle_.left + blob.left * scale_, rectangle_.top + blob.top * scale_,
          (blob.right - blob.left + 1) * scale_, (blob.bottom - blob.top + 1) * scale_};
}

}  // namespace flexrf::user
