// What the camera sees while a scripted hand goes over a table, and what there truly is to be seen.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>

#include "base/time.hpp"
#include "hal/scene/renderer/scene_renderer.hpp"
#include "hal/scene/world/tabletop_world.hpp"
#include "types/pose.hpp"
#include "types/vision_region.hpp"

namespace flexrf::bench {

inline constexpr Duration picture_period = std::chrono::milliseconds(100);
inline constexpr std::uint64_t pictures_of_a_run = 3000;
inline constexpr std::uint64_t change_at = 1000;  ///< the first picture in the other light
inline constexpr std::uint64_t judged_from = 1600;

/// Where a body is in the picture, in pixels as VisionRegion counts them.
struct SeenBody {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;

  /// Intersection over union with a region.
  double overlap(const user::VisionRegion& region) const noexcept;
};

/// A table that the seed lays, and a hand that goes over it on a smooth path, whose phases the seed chooses.
/// From picture `change_at` on the light is dimmer, warmer, lower, and comes from elsewhere. One thread.
class ScriptedView {
 public:
  static constexpr std::size_t most_seen = most_parts + most_obstacles;

  /// Allocates.
  void begin(std::uint64_t seed);

  /// rgb24, 640 x 480.
  void draw(std::uint64_t picture, std::span<std::uint8_t> pixels) noexcept;
  Pose tool_at(std::uint64_t picture) const noexcept;
  /// Parts and obstacles of which at least half of the top is in the picture, not hidden by another one. The
  /// strip that shows the hand does not count as picture.
  std::span<const SeenBody> look(std::uint64_t picture) noexcept;

 private:
  bool is_seen(const SceneBody& body, const Eigen::Isometry3d& camera) const noexcept;
  bool is_hidden(const SceneBody& by, const Eigen::Vector3d& point,
                 const Eigen::Vector3d& eye) const noexcept;
  std::span<const SceneBody> bodies() const noexcept { return {bodies_.data(), body_count_}; }

  TabletopWorld world_;
  SceneRenderer renderer_;
  SceneState state_{};
  std::array<SceneBody, most_seen> bodies_{};
  std::size_t body_count_ = 0;
  std::array<SeenBody, most_seen> seen_{};
  std::array<double, 4> phase_{};
};

}  // namespace flexrf::bench
