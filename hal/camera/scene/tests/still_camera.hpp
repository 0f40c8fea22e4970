// StillCamera: the scene's camera without a scene, for tests.
#pragma once

#include <array>

#include "hal/camera/scene/scene_camera.hpp"

namespace flexrf {

/// Looks at a block from above, without a scene and an arm: what it is shown depends on the time alone.
class StillCamera final : public SceneCamera {
 public:
  static constexpr double half_turn = 3.14159265358979323846;

 private:
  const char* blindness() noexcept override { return nullptr; }
  bool look(Time at, SceneGlance& glance) noexcept override {
    glance.state = {};
    glance.state.light = {0, 0, 1};
    glance.state.light_intensity = 1;
    glance.state.opening = 0.05;
    glance.state.parts[0] = part_at(SceneKind::block, {0.45 + 0.1 * seconds(at - start), 0}, 0);
    glance.tool.linear() = turn_about(Eigen::Vector3d::UnitX(), half_turn);
    glance.tool.translation() = Eigen::Vector3d(0.40, 0, 0.5);
    return true;
  }

  static constexpr Time start{std::chrono::seconds(1)};
};

/// Middle of what is blue, in columns and rows; no number: nothing is.
inline std::array<double, 2> blue_middle(const CameraImage& image) {
  double column_sum = 0;
  double row_sum = 0;
  int count = 0;
  for (std::uint32_t row = 0; row < image.height; ++row) {
    for (std::uint32_t column = 0; column < image.width; ++column) {
      const std::uint8_t* const pixel = &image.data[row * image.stride + column * 3];
      if (pixel[2] < 90 || pixel[2] < 2 * pixel[0]) continue;
      column_sum += column;
      row_sum += row;
      ++count;
    }
  }
  return {column_sum / count, row_sum / count};
}

}  // namespace flexrf
