#include "hal/camera/simulated/camera_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace flexrf {
namespace {

constexpr SceneColour edge_colour{50, 52, 56};
constexpr SceneColour belt_colour{120, 122, 125};
constexpr SceneColour mark_colour{150, 150, 145};
constexpr int marks = 8;

/// From column `left` to before `right`, likewise of rows; clipped.
struct Area {
  long left = 0;
  long right = 0;
  long top = 0;
  long bottom = 0;
};

std::uint8_t clipped(double value) noexcept {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
}

/// A colour, as channels of every format.
struct Ink {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t y = 0;
  std::uint8_t u = 0;
  std::uint8_t v = 0;
};

Ink ink_of(SceneColour colour, int brightness) noexcept {
  const double red = std::clamp(colour.red + brightness, 0, 255);
  const double green = std::clamp(colour.green + brightness, 0, 255);
  const double blue = std::clamp(colour.blue + brightness, 0, 255);
  // ITU-R BT.601, full range.
  const double luma = 0.299 * red + 0.587 * green + 0.114 * blue;
  return {clipped(red),
          clipped(green),
          clipped(blue),
          clipped(luma),
          clipped(128 + 0.564 * (blue - luma)),
          clipped(128 + 0.713 * (red - luma))};
}

class Pen {
 public:
  Pen(const PictureCanvas& canvas, int brightness) noexcept : canvas_(canvas), brightness_(brightness) {}

  void fill(const Area& area, SceneColour colour) const noexcept {
    const Ink ink = ink_of(colour, brightness_);
    const auto width = static_cast<long>(canvas_.width);
    const auto height = static_cast<long>(canvas_.height);
    const Area inside{std::clamp(area.left, 0L, width), std::clamp(area.right, 0L, width),
                      std::clamp(area.top, 0L, height), std::clamp(area.bottom, 0L, height)};
    std::uint8_t* const data = canvas_.data.data();
    switch (canvas_.format) {
      case PixelFormat::rgb24:
        return paint<3>(data, width, inside, {ink.red, ink.green, ink.blue});
      case PixelFormat::yuyv:
        return paint<4>(data, width / 2, {inside.left / 2, inside.right / 2, inside.top, inside.bottom},
                        {ink.y, ink.u, ink.y, ink.v});
      case PixelFormat::uyvy:
        return paint<4>(data, width / 2, {inside.left / 2, inside.right / 2, inside.top, inside.bottom},
                        {ink.u, ink.y, ink.v, ink.y});
      case PixelFormat::grey16:
        return paint<2>(data, width, inside, {0, ink.y});
      case PixelFormat::bayer_rggb8:
        return paint_mosaic(data, width, inside, {ink.red, ink.green, ink.green, ink.blue});
      case PixelFormat::bayer_grbg8:
        return paint_mosaic(data, width, inside, {ink.green, ink.red, ink.blue, ink.green});
      case PixelFormat::bayer_gbrg8:
        return paint_mosaic(data, width, inside, {ink.green, ink.blue, ink.red, ink.green});
      case PixelFormat::bayer_bggr8:
        return paint_mosaic(data, width, inside, {ink.blue, ink.green, ink.green, ink.red});
      case PixelFormat::nv12:
        paint<2>(data + width * height, width / 2,
                 {inside.left / 2, inside.right / 2, inside.top / 2, inside.bottom / 2}, {ink.u, ink.v});
        [[fallthrough]];
      default:
        return paint<1>(data, width, inside, {ink.y});
    }
  }

 private:
  /// `area` in cells, of which there are `columns` in a row.
  template <std::size_t size>
  static void paint(std::uint8_t* plane, long columns, const Area& area,
                    const std::array<std::uint8_t, size>& cell) noexcept {
    for (long row = area.top; row < area.bottom; ++row) {
      std::uint8_t* at = plane + (row * columns + area.left) * static_cast<long>(size);
      for (long column = area.left; column < area.right; ++column) at = std::copy_n(cell.data(), size, at);
    }
  }

  /// `cell`: of two by two pixels, row by row.
  static void paint_mosaic(std::uint8_t* data, long width, const Area& area,
                           const std::array<std::uint8_t, 4>& cell) noexcept {
    for (long row = area.top; row < area.bottom; ++row) {
      for (long column = area.left; column < area.right; ++column)
        data[row * width + column] = cell[static_cast<std::size_t>(row % 2 * 2 + column % 2)];
    }
  }

  const PictureCanvas& canvas_;
  int brightness_;
};

}  // namespace

void CameraScene::draw(const PictureCanvas& canvas, double progress, int brightness) noexcept {
  const Pen pen(canvas, brightness);
  const auto width = static_cast<long>(canvas.width);
  const auto height = static_cast<long>(canvas.height);
  const long edge = height / 8;
  pen.fill({0, width, 0, height}, edge_colour);
  pen.fill({0, width, edge, height - edge}, belt_colour);
  const long mark = std::max(width / (marks * 8), 1L);
  for (int i = 0; i < marks; ++i) {
    const double place = std::fmod(progress + static_cast<double>(i) / marks, 1.0);
    const long left = std::lround(place * static_cast<double>(width));
    pen.fill({left, left + mark, edge, height - edge}, mark_colour);
  }
  const long middle = std::lround(part_middle(progress) * static_cast<double>(width));
  const long half = std::max(height / 8, 1L);
  pen.fill({middle - half, middle + half, height / 2 - half, height / 2 + half}, part_colour);
}

}  // namespace flexrf
