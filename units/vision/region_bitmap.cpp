#include "units/vision/region_bitmap.hpp"

#include <algorithm>

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
                        const WhiteBalance& balance) noexcept {
  rectangle_ = common_part(rectangle, {0, 0, picture.width, picture.height});
  blob_count_ = 0;
  columns_ = rows_ = 0;
  scale_ = 1;
  if (rectangle_.is_empty()) return;
  scale_ = cells(std::max(rectangle_.width, rectangle_.height), side);
  columns_ = cells(rectangle_.width, scale_);
  rows_ = cells(rectangle_.height, scale_);
  balance_ = balance;
  classify(picture, blind, classes);
  drop_edges();
  find_blobs();
}

void RegionBitmap::classify(const PictureView& picture, const PixelRectangle& blind,
                            const ColourClasses& classes) noexcept {
  first_foreign_ = rows_;
  last_foreign_ = -1;
  for (int row = 0; row < rows_; ++row) {
    bool any = false;
    std::uint8_t* const to = classes_.data() + place(0, row);
    for (int column = 0; column < columns_; ++column) {
      const int x = rectangle_.left + column * scale_;
      const int y = rectangle_.top + row * scale_;
      const std::uint8_t found = classes.of(picture.at(x, y), balance_);
      to[column] = found != class_dark                 ? found
                   : is_shadow(picture, x, y, classes) ? class_table
                                                       : class_foreign;
      any = any || to[column] == class_foreign;
    }
    if (!any) continue;
    first_foreign_ = std::min(first_foreign_, row);
    last_foreign_ = row;
  }
  const PixelRectangle hidden = common_part(rectangle_, blind);
  if (hidden.is_empty()) return;
  const int last_column = (hidden.right() - 1 - rectangle_.left) / scale_;
  const int last_row = (hidden.bottom() - 1 - rectangle_.top) / scale_;
  for (int row = (hidden.top - rectangle_.top) / scale_; row <= last_row; ++row)
    for (int column = (hidden.left - rectangle_.left) / scale_; column <= last_column; ++column)
      classes_[place(column, row)] = class_unseen;
}

/// By the mean of four pixels, which has half of the noise.
bool RegionBitmap::is_shadow(const PictureView& picture, int column, int row,
                             const ColourClasses& classes) const noexcept {
  const int right = std::min(column + 1, picture.width - 1);
  const int below = std::min(row + 1, picture.height - 1);
  std::array<std::uint32_t, 3> sums{};
  for (const std::uint8_t* const pixel :
       {picture.at(column, row), picture.at(right, row), picture.at(column, below), picture.at(right, below)})
    for (std::size_t i = 0; i < 3; ++i) sums[i] += pixel[i];
  return classes.is_shadow(sums, 4, balance_);
}

/// Opening (Serra 1982) with squares of three cells: what is foreign shrinks by one cell, and what is left
/// grows by one. Of what is not seen nobody knows, so it lets things be.
void RegionBitmap::drop_edges() noexcept {
  const int first = std::max(first_foreign_ - 1, 0);
  const int last = std::min(last_foreign_ + 1, rows_ - 1);
  for (int row = first; row <= last; ++row) {
    BitRow& bits = foreign_[static_cast<std::size_t>(row)];
    bits = {};
    for (int column = 0; column < columns_; ++column) {
      const std::uint8_t of = classes_[place(column, row)];
      const std::uint64_t bit = of == class_foreign || of == class_unseen ? 1 : 0;
      bits[static_cast<std::size_t>(column) / 64] |= bit << (static_cast<std::size_t>(column) % 64);
    }
    fill_behind(bits, columns_);
  }
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
    for (int column = 0; column < columns_; ++column) {
      std::uint8_t& of = classes_[place(column, row)];
      const auto at = static_cast<std::size_t>(column);
      if (of == class_foreign && (any_of[at / 64] >> (at % 64) & 1) == 0) of = class_table;
    }
  }
}

void RegionBitmap::find_blobs() noexcept {
  for (int row = 0; row < rows_; ++row)
    std::fill_n(labels_.begin() + static_cast<std::ptrdiff_t>(place(0, row)), columns_, std::uint8_t{0});
  std::uint8_t label = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::uint8_t of = classes_[place(column, row)];
      if (of == class_table || of == class_unseen || labels_[place(column, row)] != 0) continue;
      // Labels are used up only by what is large enough to be looked at.
      const std::uint8_t own =
          label + 1 < dropped_label ? static_cast<std::uint8_t>(label + 1) : dropped_label;
      const Blob blob = flood(column, row, own);
      if (own == dropped_label || blob.area < least_area) continue;
      label = own;
      keep(blob);
    }
  }
}

/// The cells of the blob that this one belongs to, which is the first of it from above. One that turns out to
/// be too small gets the label of what nobody looks at.
Blob RegionBitmap::flood(int column, int row, std::uint8_t label) noexcept {
  Blob blob;
  blob.pixel_class = classes_[place(column, row)];
  blob.label = label;
  blob.left = blob.right = blob.first_column = column;
  blob.top = blob.bottom = row;
  // Each cell is put in here once, and stays.
  std::size_t found = 0;
  const auto reach = [&](int to_column, int to_row) {
    const std::size_t to = place(to_column, to_row);
    if (classes_[to] != blob.pixel_class || labels_[to] != 0) return;
    labels_[to] = label;
    waiting_[found++] = static_cast<std::uint16_t>(to);
  };
  double columns = 0;
  double rows = 0;
  reach(column, row);
  for (std::size_t next = 0; next < found; ++next) {
    const int x = waiting_[next] % side;
    const int y = waiting_[next] / side;
    columns += x;
    rows += y;
    blob.left = std::min(blob.left, x);
    blob.right = std::max(blob.right, x);
    blob.bottom = std::max(blob.bottom, y);
    if (x > 0) reach(x - 1, y);
    if (x + 1 < columns_) reach(x + 1, y);
    if (y > 0) reach(x, y - 1);
    if (y + 1 < rows_) reach(x, y + 1);
  }
  blob.area = static_cast<int>(found);
  blob.middle_column = columns / blob.area + 0.5;
  blob.middle_row = rows / blob.area + 0.5;
  if (blob.area < least_area)
    for (std::size_t i = 0; i < found; ++i) labels_[waiting_[i]] = dropped_label;
  return blob;
}

/// In order of size; the smallest goes where there are too many.
void RegionBitmap::keep(const Blob& blob) noexcept {
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
