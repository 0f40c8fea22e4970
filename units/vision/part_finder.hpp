// PartFinder: what there is in a rectangle of a picture, and where on the table it lies.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "types/visual_class.hpp"
#include "units/vision/pose_starts.hpp"
#include "units/vision/table_light.hpp"

namespace flexrf::user {

/// One thing that was found.
struct Finding {
  VisualClass found = VisualClass::nothing;
  std::uint16_t kind = no_kind;
  OutlinePose pose;                                 ///< of an obstacle its middle, angle 0
  double height = 0;                                ///< m; of an obstacle the assumed one
  double radius = 0;                                ///< m about the pose's position
  double residual = 0;                              ///< m
  Eigen::Vector3d lean = Eigen::Vector3d::Zero();   ///< of an obstacle, see ObstacleFoot
  double support = 0;                               ///< part of the outline that was seen
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< its middle in the picture
  PixelRectangle box;                               ///< of an obstacle: all of it in the picture
};

/// What a part has to be like to be taken as one.
struct FindingLimits {
  double least_support = 0.58;    ///< part of its outline that is seen
  double most_residual = 0.0015;  ///< m
  double least_obstacle = 2e-4;   ///< m^2 on the table: what is smaller is nothing
  double obstacle_height = 0.09;  ///< m: so high an obstacle is thought to be
};

/// Of one thread; allocates nothing. Bounded: one rectangle, looked at a second time where a blob went on
/// behind it; 4 findings, of one blob 3, each of at most 96 starts.
class PartFinder {
 public:
  static constexpr std::size_t most_findings = 4;

  /// `darkest_shadow`: see ColourClasses::prepare(). Takes some milliseconds.
  void prepare(std::span<const PartModel> parts, double darkest_shadow) noexcept;

  /// Takes the light from a picture; once for each, before regions of it are looked at. `blind`: where
  /// nothing is seen. False: its table was not found, and the light is taken as it was.
  bool look_at_light(const PictureView& picture, const PixelRectangle& blind) noexcept {
    return light_.look(picture, blind, classes_);
  }

  /// `expected`: what is expected here, of kind no_kind: nothing is.
  std::span<const Finding> find(const PictureView& picture, const PixelRectangle& rectangle,
                                const PixelRectangle& blind, const CameraView& view, const Finding& expected,
                                const FindingLimits& limits) noexcept;

  /// That the last find() looked at.
  std::uint32_t pixels() const noexcept { return pixels_; }
  void forget() noexcept { light_.forget(); }

 private:
  const Blob* central_blob() const noexcept;
  void look(const PictureView& picture, const PixelRectangle& rectangle,
            const PixelRectangle& blind) noexcept;
  bool find_parts(const Blob& blob, const CameraView& view, const Finding& expected,
                  const FindingLimits& limits) noexcept;
  void note(const PartModel& part, std::size_t kind, const OutlineFit& fit, const CameraView& view) noexcept;
  void find_obstacle(const Blob& blob, const CameraView& view, const FindingLimits& limits) noexcept;
  OutlineFit best_fit(const PartModel& part, const Blob& blob, const CameraView& view) noexcept;
  double filled(const PartModel& part, const OutlinePose& pose, const Blob& blob,
                const CameraView& view) const noexcept;
  Eigen::Vector2d pixel_of(double column, double row) const noexcept;

  std::span<const PartModel> parts_;
  ColourClasses classes_;
  TableLight light_;
  RegionBitmap bitmap_;
  Contour contour_;
  PoseStarts starts_;
  std::array<Finding, most_findings> findings_{};
  std::size_t count_ = 0;
  std::uint32_t pixels_ = 0;
};

}  // namespace flexrf::user
