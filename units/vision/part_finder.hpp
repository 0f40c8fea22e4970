// PartFinder: what there is in a rectangle of a picture, and where on the table it lies.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "types/visual_class.hpp"
#include "units/vision/pose_starts.hpp"
#include "units/vision/region_bitmap.hpp"

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

/// What lies in a rectangle of a picture, by one of four pixels or fewer: enough to tell that there is
/// nothing, or that it is known, for a small part of what it takes to measure it.
struct Glance {
  PixelRectangle rectangle;                ///< of what has to be measured, with some of the table around
  PixelRectangle middle;                   ///< of what lies in the middle of it; empty: nothing is seen
  std::uint8_t pixel_class = class_table;  ///< of that
  bool is_cut = false;                     ///< it goes on beyond what was looked at
  std::uint32_t pixels = 0;                ///< that were looked at
  std::uint32_t least = 0;                 ///< pixels of the smallest thing that it can see

  /// To measure in a whole rectangle without a glance.
  static Glance none(const PixelRectangle& rectangle) noexcept {
    Glance all;
    all.rectangle = all.middle = rectangle;
    return all;
  }
  bool is_empty() const noexcept { return middle.is_empty(); }
};

/// Of one thread; allocates nothing. Bounded: one rectangle, looked at a second time where a blob went on
/// behind it; 8 findings, of one blob 3, each of at most 96 starts.
class PartFinder {
 public:
  static constexpr std::size_t most_findings = 8;

  /// `table`: its colour in white light. `darkest_shadow`: see ColourClasses::prepare(). Takes some
  /// milliseconds. `parts` are looked at as long as this is used.
  void prepare(std::span<const PartModel> parts, SurfaceColour table, double darkest_shadow) noexcept;

  /// The light of the pictures that follow. `is_known`: false where it is that of a picture before.
  void set_light(const WhiteBalance& balance, bool is_known) noexcept {
    balance_ = balance;
    is_light_known_ = is_known;
  }

  /// Of one pixel.
  std::uint8_t class_at(const PictureView& picture, int column, int row,
                        const PixelRectangle& blind) noexcept {
    pixels_ = look(picture, {column - 1, row - 1, 3, 3}, blind);
    return bitmap_.pixel_class(1, 1);
  }

  /// A rectangle is about what lies in its middle: in the answer is that, and what lies beside it.
  Glance glance(const PictureView& picture, const PixelRectangle& rectangle,
                const PixelRectangle& blind) noexcept;

  /// Of something that is cut: once more, in a square that should hold the rest of it.
  Glance glance_around(const PictureView& picture, const Glance& cut, const PixelRectangle& blind) noexcept;

  /// `expected`: what is expected here, of kind no_kind: nothing is.
  std::span<const Finding> measure(const PictureView& picture, const Glance& at, const PixelRectangle& blind,
                                   const CameraView& view, const Finding& expected,
                                   const FindingLimits& limits) noexcept;

  /// All that lies in a rectangle, and what goes on behind its border as far as it is seen: to know what
  /// stands in a place. `place`: that one in the picture, in pixels, convex, one corner after the other.
  std::span<const Finding> measure_all(const PictureView& picture, const PixelRectangle& rectangle,
                                       const PixelRectangle& blind, const CameraView& view,
                                       const FindingLimits& limits,
                                       std::span<const Eigen::Vector2d, 4> place) noexcept;

  /// The last measure() or measure_all() said of each thing that it saw what it is. A blob of a part's colour
  /// of at most one and a half times the part's area counts as a piece of a part. Pieces at the border do not
  /// count in measure(), nor blobs beside the place in measure_all(). False also if the picture's light is
  /// not known.
  bool is_complete() const noexcept { return is_complete_; }

  /// Pixels that the last class_at(), measure() or measure_all() looked at, with those of the glance.
  std::uint32_t pixels() const noexcept { return pixels_; }

 private:
  const Blob* blob_in_the_middle_of(const PixelRectangle& rectangle) const noexcept;
  std::uint32_t look(const PictureView& picture, const PixelRectangle& rectangle, const PixelRectangle& blind,
                     int least_scale = 1) noexcept;
  bool tell(const Blob& blob, bool may_be_obstacle, const CameraView& view, const Finding& expected,
            const FindingLimits& limits) noexcept;
  bool meets(const Blob& blob, std::span<const Eigen::Vector2d, 4> place) const noexcept;
  bool is_small(const Blob& blob, const CameraView& view, const FindingLimits& limits) const noexcept;
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
  WhiteBalance balance_;
  RegionBitmap bitmap_;
  Contour contour_;
  PoseStarts starts_;
  std::array<Finding, most_findings> findings_{};
  std::size_t count_ = 0;
  std::uint32_t pixels_ = 0;
  bool is_light_known_ = false;
  bool is_complete_ = false;
};

}  // namespace flexrf::user
