// SceneRenderer: the picture that a camera takes of a scene.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/scene/interface/scene_shapes.hpp"
#include "hal/scene/renderer/picture_finish.hpp"
#include "hal/scene/renderer/pinhole.hpp"
#include "hal/scene/renderer/scene_faces.hpp"
#include "types/scene_state.hpp"

namespace flexrf {

struct RendererPlan {
  Pinhole pinhole;
  HandModel hand;
  double noise = 2;        ///< standard deviation of the sensor's noise in grey levels, 0 to 20
  std::uint64_t seed = 1;  ///< of the noise
};

/// Flat faces with a depth buffer, lit by one light from far away and from all around (Lambert), hard shadows
/// on the table, then a lens' blur and a sensor's noise. Upright prisms, the hand's fingers and palm, the
/// table with its bins: nothing else is seen, arms cast no shadow.
///
/// The same input gives the same bytes on every x86-64: it counts on IEEE 754 alone. There is no function of
/// the C library whose code depends on the processor (scene_math.hpp), no product is joined with a sum
/// (-ffp-contract=off, no -ffast-math), and after the faces all is whole numbers.
///
/// One thread. draw() allocates nothing.
class SceneRenderer {
 public:
  /// Allocates some megabytes.
  void begin(const RendererPlan& plan);

  /// `camera`, `tool`: their frames in the scene's; the hand is drawn at the tool. `frame` chooses the noise.
  /// `picture`: rgb24, 3 * width * height bytes, rows without gaps.
  void draw(const SceneState& state, const Eigen::Isometry3d& camera, const Eigen::Isometry3d& tool,
            std::uint64_t frame, std::span<std::uint8_t> picture) noexcept;

  const Pinhole& pinhole() const noexcept { return plan_.pinhole; }

 private:
  /// What is seen at a pixel: one of these, or from `first_face` on a face's colour.
  enum Material : std::uint16_t {
    nothing = 0,  // beyond the table
    table = 2,
    bin = 4,
    in_shadow = 1,  // added to one of the two before
    first_face = 6,
  };
  /// More than there are faces: of twenty bodies at most 26 each, and those of the hand.
  static constexpr std::size_t most_colours = 1024;
  static constexpr std::size_t texture_size = 512;  // in each direction, of 1 mm

  struct View {
    Eigen::Isometry3d to_camera;  // from the scene's frame
    Eigen::Matrix3d from_camera;  // directions
    Eigen::Vector3d eye;          // in the scene's frame
    Eigen::Vector3d light;        // towards it
    Eigen::Vector3d light_colour;
  };
  using Shades = std::array<std::array<std::uint8_t, 4>, 256>;  // rgb, by the texture's value

  void make_texture();
  void draw_table(const View& view) noexcept;
  void draw_bins(const View& view) noexcept;
  void draw_shadow(const View& view, const SceneFace& face) noexcept;
  void draw_face(const View& view, const SceneFace& face) noexcept;
  /// The table's pixels within a polygon on it become a bin's line, or are in the shadow.
  void mark(const View& view, std::span<const Eigen::Vector3d> corners, Material material) noexcept;
  std::size_t seen_corners(const View& view, std::span<const Eigen::Vector3d> corners,
                           std::array<PlaneVector, most_corners + 2>& seen) const noexcept;
  void make_shades(const View& view) noexcept;
  void write_row(const View& view, std::uint32_t row, std::uint8_t* out) const noexcept;
  void finish(std::uint64_t frame, const View* view, std::span<std::uint8_t> picture) noexcept;
  /// Where the ray of a column meets the table, in texels.
  PlaneVector texel(const View& view, double column, double row) const noexcept;

  RendererPlan plan_;
  PictureNoise noise_;
  PictureFinish finish_;
  std::vector<std::uint16_t> materials_;
  std::vector<float> nearness_;  // 1/z; 0: infinitely far
  std::vector<std::uint8_t> texture_;
  std::vector<std::array<std::int32_t, 2>> table_spans_;  // of each row, from where to before where
  std::array<std::array<std::uint8_t, 4>, most_colours> colours_{};
  std::size_t colour_count_ = 0;
  std::array<Shades, 4> shades_{};  // of table and bins, each in the light and in the shadow
};

}  // namespace flexrf
