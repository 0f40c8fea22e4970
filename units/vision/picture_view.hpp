// A picture in memory, and rectangles of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace flexrf::user {

/// In pixels of the camera's picture.
struct PixelRectangle {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;

  int right() const noexcept { return left + width; }
  int bottom() const noexcept { return top + height; }
  int area() const noexcept { return is_empty() ? 0 : width * height; }
  bool is_empty() const noexcept { return width <= 0 || height <= 0; }
  bool holds(int column, int row) const noexcept {
    return column >= left && row >= top && column < right() && row < bottom();
  }
};

/// What both cover; empty where they do not meet.
inline PixelRectangle common_part(const PixelRectangle& one, const PixelRectangle& other) noexcept {
  PixelRectangle both;
  both.left = std::max(one.left, other.left);
  both.top = std::max(one.top, other.top);
  both.width = std::min(one.right(), other.right()) - both.left;
  both.height = std::min(one.bottom(), other.bottom()) - both.top;
  return both;
}

/// The smallest that holds both.
inline PixelRectangle around_both(const PixelRectangle& one, const PixelRectangle& other) noexcept {
  if (one.is_empty() || other.is_empty()) return one.is_empty() ? other : one;
  PixelRectangle all;
  all.left = std::min(one.left, other.left);
  all.top = std::min(one.top, other.top);
  all.width = std::max(one.right(), other.right()) - all.left;
  all.height = std::max(one.bottom(), other.bottom()) - all.top;
  return all;
}

/// With a border of `pixels` on each side.
inline PixelRectangle widened(const PixelRectangle& rectangle, int pixels) noexcept {
  return {rectangle.left - pixels, rectangle.top - pixels, rectangle.width + 2 * pixels,
          rectangle.height + 2 * pixels};
}

/// rgb24, rows `stride` bytes apart.
struct PictureView {
  const std::uint8_t* pixels = nullptr;
  std::size_t stride = 0;
  int width = 0;
  int height = 0;

  const std::uint8_t* at(int column, int row) const noexcept {
    return pixels + static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column) * 3;
  }
};

}  // namespace flexrf::user
