// Pictures of a table that are drawn from known poses by a known camera, for tests of what looks at pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "units/vision/camera_view.hpp"
#include "units/vision/outline_fit.hpp"
#include "units/vision/region_bitmap.hpp"
#include "units/vision/tests/known_parts.hpp"

namespace flexrf::user {

inline constexpr double degree = std::numbers::pi / 180;

inline CameraModel camera_of_tests() {
  CameraModel camera{};
  camera.focal_length = 600;
  camera.principal_point = {320, 240};
  camera.width = 640;
  camera.height = 480;
  camera.mount.position = {0.01, -0.02, 0.03};
  camera.mount.orientation = {0, 0, 0, 1};
  return camera;
}

/// A tool that looks straight down, or tilted about the robot's x by so many rad.
inline Pose tool_above(double x, double y, double z, double tilt = 0) {
  Pose tool{};
  tool.position = {x, y, z};
  const double half = (std::numbers::pi + tilt) / 2;
  tool.orientation = {std::sin(half), 0, 0, std::cos(half)};
  return tool;
}

/// Of an upright box or a post.
inline PartModel rectangle_of_tests(double length, double width, double height, SurfaceColour colour) {
  PartModel box;
  box.corners[0] = {-length / 2, -width / 2};
  box.corners[1] = {length / 2, -width / 2};
  box.corners[2] = {length / 2, width / 2};
  box.corners[3] = {-length / 2, width / 2};
  box.corner_count = 4;
  box.height = height;
  box.colour = colour;
  box.radius = std::hypot(length, width) / 2;
  return box;
}

/// Four rays to a pixel, so that edges are as soft as those of a real picture.
class DrawnTable {
 public:
  explicit DrawnTable(const Pose& tool = tool_above(0.45, 0, 0.45)) : view_(camera_of_tests(), tool) {
    clear();
  }

  const CameraView& view() const { return view_; }
  /// Of each channel: brightness and colour of the light.
  std::array<double, 3> light{1, 1, 1};

  /// The bare table.
  void clear() { fill({150, 145, 135}); }
  void fill(SurfaceColour colour) {
    rays_.assign(static_cast<std::size_t>(wide * high * 3), 0);
    for (int row = 0; row < high; ++row)
      for (int column = 0; column < wide; ++column) paint(column, row, colour, 1);
  }

  /// A prism that stands on the table; its sides are darker than its top.
  void put(const PartModel& body, const OutlinePose& pose) {
    Eigen::Vector2d middle;
    const Eigen::Vector3d top(pose.position.x(), pose.position.y(), body.height);
    if (!view_.to_picture(top, middle)) return;
    const double reach = 2 * (body.radius * view_.pixels_per_metre(top) * 1.3 + 60);
    for (int row = first(2 * middle.y() - reach); row < last(2 * middle.y() + reach, high); ++row) {
      for (int column = first(2 * middle.x() - reach); column < last(2 * middle.x() + reach, wide);
           ++column) {
        Eigen::Vector2d above;
        Eigen::Vector2d below;
        if (!view_.to_plane((column + 0.5) / 2, (row + 0.5) / 2, body.height, above) ||
            !view_.to_plane((column + 0.5) / 2, (row + 0.5) / 2, 0, below))
          continue;
        if (is_within(body, pose, above))
          paint(column, row, body.colour, 1);
        else if (is_within(body, pose, below) || crosses(body, pose, above, below))
          paint(column, row, body.colour, 0.6);
      }
    }
  }

  /// The picture, with so much noise on each channel, the same for the same seed.
  PictureView picture(double noise = 0, std::uint32_t seed = 1) {
    bytes_.resize(std::size_t{640} * 480 * 3);
    for (int row = 0; row < 480; ++row) {
      for (int column = 0; column < 640; ++column) {
        for (int channel = 0; channel < 3; ++channel) {
          int sum = 0;
          for (int k = 0; k < 4; ++k) sum += rays_[ray(2 * column + k % 2, 2 * row + k / 2, channel)];
          double value = sum / 4.0;
          if (noise > 0) {
            seed = seed * 1664525 + 1013904223;
            value += noise * ((seed >> 8) / 8388608.0 - 1);
          }
          bytes_[static_cast<std::size_t>((row * 640 + column) * 3 + channel)] =
              static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
        }
      }
    }
    return {bytes_.data(), 1920, 640, 480};
  }
  std::span<const std::uint8_t> bytes() const { return bytes_; }

  /// The square of so many m about a place on the table, in pixels.
  PixelRectangle around(const Eigen::Vector2d& place, double size) const {
    Eigen::Vector2d pixel(0, 0);
    const Eigen::Vector3d point(place.x(), place.y(), 0.01);
    view_.to_picture(point, pixel);
    const int side = static_cast<int>(size * view_.pixels_per_metre(point));
    return {static_cast<int>(pixel.x()) - side / 2, static_cast<int>(pixel.y()) - side / 2, side, side};
  }

 private:
  static constexpr int wide = 1280;
  static constexpr int high = 960;

  static int first(double at) { return std::max(static_cast<int>(at), 0); }
  static int last(double at, int size) { return std::min(static_cast<int>(at), size); }
  static std::size_t ray(int column, int row, int channel) {
    return static_cast<std::size_t>((row * wide + column) * 3 + channel);
  }
  void paint(int column, int row, SurfaceColour colour, double shade) {
    const std::array<int, 3> channels{colour.red, colour.green, colour.blue};
    for (int i = 0; i < 3; ++i)
      rays_[ray(column, row, i)] = static_cast<std::uint8_t>(
          std::clamp(channels[static_cast<std::size_t>(i)] * light[static_cast<std::size_t>(i)] * shade + 0.5,
                     0.0, 255.0));
  }
  static bool crosses(const PartModel& body, const OutlinePose& pose, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to) {
    const Eigen::Rotation2Dd turn(pose.angle);
    const auto side_of = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
      return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x()) > 0;
    };
    for (std::size_t i = 0; i < body.corner_count; ++i) {
      const Eigen::Vector2d a = pose.position + turn * body.corners[i];
      const Eigen::Vector2d b = pose.position + turn * body.corners[(i + 1) % body.corner_count];
      if (side_of(a, b, from) != side_of(a, b, to) && side_of(from, to, a) != side_of(from, to, b))
        return true;
    }
    return false;
  }

  CameraView view_;
  std::vector<std::uint8_t> rays_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace flexrf::user
