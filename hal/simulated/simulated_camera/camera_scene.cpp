#include "hal/simulated/simulated_camera/camera_scene.hpp"

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

/// What one pixel, or in YUYV a pair of them, takes.
struct Ink {
  std::uint8_t bytes[4] = {};
  std::size_t size = 0;
  long pixels = 1;
};

Ink ink_of(SceneColour colour, int brightness, PixelFormat format) noexcept {
  const double red = std::clamp(colour.red + brightness, 0, 255);
  const double green = std::clamp(colour.green + brightness, 0, 255);
  const double blue = std::clamp(colour.blue + brightness, 0, 255);
  // ITU-R BT.601, full range.
  const double luma = 0.299 * red + 0.587 * green + 0.114 * blue;
  if (format == PixelFormat::grey8) return {{clipped(luma)}, 1, 1};
  if (format == PixelFormat::rgb24) return {{clipped(red), clipped(green), clipped(blue)}, 3, 1};
  const std::uint8_t y = clipped(luma);
  return {{y, clipped(128 + 0.564 * (blue - luma)), y, clipped(128 + 0.713 * (red - luma))}, 4, 2};
}

class Pen {
 public:
  Pen(const PictureCanvas& canvas, int brightness) noexcept : canvas_(canvas), brightness_(brightness) {}

  void fill(const Area& area, SceneColour colour) const noexcept {
    const Ink ink = ink_of(colour, brightness_, canvas_.format);
    const auto width = static_cast<long>(canvas_.width);
    const long left = std::clamp(area.left, 0L, width) / ink.pixels;
    const long right = std::clamp(area.right, 0L, width) / ink.pixels;
    const long bottom = std::clamp(area.bottom, 0L, static_cast<long>(canvas_.height));
    const long step = static_cast<long>(ink.size);
    for (long row = std::max(area.top, 0L); row < bottom; ++row) {
      std::uint8_t* at = canvas_.data.data() + (row * (width / ink.pixels) + left) * step;
      for (long column = left; column < right; ++column, at += step) std::copy_n(ink.bytes, ink.size, at);
    }
  }

 private:
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
