#include "units/vision/region_bitmap.hpp"

#include <algorithm>

namespace flexrf::user {
namespace {

// Label of what is too small, or more than there is room for.
constexpr std::uint8_t dropped_label = 0xFF;

int cells(int pixels, int scale) {
  return (pixels + scale - 1) / scale;
}

}  // namespace

PixelRectangle common_part(const PixelRectangle& one, const PixelRectangle& other) noexcept {
  PixelRectangle both;
  both.left = std::max(one.left, other.left);
  both.top = std::max(one.top, other.top);
  both.width = std::min(one.right(), other.right()) - both.left;
  both.height = std::min(one.bottom(), other.bottom()) - both.top;
  return both;
}

void RegionBitmap::take(const PictureView& picture, const PixelRectangle& rectangle,
                        const PixelRectangle& blind, const ColourClasses& classes) noexcept {
  rectangle_ = common_part(rectangle, {0, 0, picture.width, picture.height});
  blob_count_ = 0;
  columns_ = rows_ = 0;
  scale_ = 1;
  if (rectangle_.is_empty()) return;
  scale_ = cells(std::max(rectangle_.width, rectangle_.height), side);
  columns_ = cells(rectangle_.width, scale_);
  rows_ = cells(rectangle_.height, scale_);
  classes.balance_of(border_colour(picture), balance_);  // else the light is as it was
  classify(picture, blind, classes);
  find_blobs();
}

/// The median of each channel along the border: right while less than half of it shows something else.
std::array<std::uint32_t, 3> RegionBitmap::border_colour(const PictureView& picture) noexcept {
  for (auto& channel : histogram_) channel.fill(0);
  std::uint32_t count = 0;
  const auto add = [&](int column, int row) {
    const std::uint8_t* const pixel = picture.at(column, row);
    for (std::size_t i = 0; i < 3; ++i) ++histogram_[i][pixel[i]];
    ++count;
  };
  for (int column = rectangle_.left; column < rectangle_.right(); ++column) {
    add(column, rectangle_.top);
    add(column, rectangle_.bottom() - 1);
  }
  for (int row = rectangle_.top; row < rectangle_.bottom(); ++row) {
    add(rectangle_.left, row);
    add(rectangle_.right() - 1, row);
  }
  std::array<std::uint32_t, 3> median{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint32_t below = 0;
    while ((below += histogram_[i][median[i]]) * 2 < count) ++median[i];
  }
  return median;
}

void RegionBitmap::classify(const PictureView& picture, const PixelRectangle& blind,
                            const ColourClasses& classes) noexcept {
  for (int row = 0; row < rows_; ++row) {
    std::uint8_t* const to = classes_.data() + place(0, row);
    for (int column = 0; column < columns_; ++column) {
      const int x = rectangle_.left + column * scale_;
      const int y = rectangle_.top + row * scale_;
      const std::uint8_t found = classes.of(picture.at(x, y), balance_);
      to[column] = found != class_dark                 ? found
                   : is_shadow(picture, x, y, classes) ? class_table
                                                       : class_foreign;
    }
  }
  const PixelRectangle hidden = common_part(rectangle_, blind);
  if (hidden.is_empty()) return;
  const int last_column = (hidden.right() - 1 - rectangle_.left) / scale_;
  const int last_row = (hidden.bottom() - 1 - rectangle_.top) / scale_;
  for (int row = (hidden.top - rectangle_.top) / scale_; row <= last_row; ++row)
    for (int column = (hidden.left - rectangle_.left) / scale_; column <= last_column; ++column)
      classes_[place(column, row)] = class_table;
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

void RegionBitmap::find_blobs() noexcept {
  for (int row = 0; row < rows_; ++row)
    std::fill_n(labels_.begin() + static_cast<std::ptrdiff_t>(place(0, row)), columns_, std::uint8_t{0});
  std::uint8_t label = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (classes_[place(column, row)] == class_table || labels_[place(column, row)] != 0) continue;
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
