// CameraScene: what the simulated camera sees, drawn in any of a camera's formats.
#pragma once

#include "hal/camera/interface/virtual_camera.hpp"

namespace flexrf {

struct SceneColour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// A grey belt between two darker edges, with marks that move with it and a red part.
class CameraScene {
 public:
  static constexpr SceneColour part_colour{200, 40, 40};

  /// Where the part's middle is, in widths of the picture from the left, `progress` of a passage (0 to 1).
  static double part_middle(double progress) noexcept { return progress; }

  /// `brightness`: added to every channel.
  static void draw(const PictureCanvas& canvas, double progress, int brightness) noexcept;
};

}  // namespace flexrf
