#include "units/vision/part_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "units/vision/obstacle_foot.hpp"

namespace flexrf::user {
namespace {

constexpr double coarse_width = 0.008;  // m, of the weights when starts are compared
constexpr double fine_width = 0.005;    // m, when the best are improved
constexpr int iterations = 8;
constexpr double expected_width = 0.003;  // m, when one is where it is expected
constexpr int expected_iterations = 4;
constexpr std::size_t finalists = 4;          // starts that are improved
constexpr std::size_t coarse_points = 48;     // by which starts are compared
constexpr double least_share = 0.3;           // of a part's area that has to be seen
constexpr double least_of_an_obstacle = 1.5;  // parts' areas: more than of one that is partly hidden
constexpr double most_alone = 1.15;           // parts' areas in a blob of one part
constexpr double support_alone = 0.9;
constexpr double support_among_others = 0.65;
constexpr double beyond_doubt = 0.97;  // so good a fit ends the search
constexpr double least_filled = 0.9;   // of a part's inside that has its colour
constexpr double explained = 0.002;    // m: such a point of the contour belongs to the part that was found
constexpr int parts_of_a_blob = 3;
constexpr int table_around = 12;  // pixels, around what was found at a rectangle's border
constexpr int glance_cells = 56;  // along a side, at most
constexpr int table_beside = 4;   // pixels, around what a glance saw, and a cell
constexpr int largest_side = 2 * RegionBitmap::side;

/// Pixels along a cell's side.
int glance_scale(const PixelRectangle& rectangle) {
  return std::max(2, (std::max(rectangle.width, rectangle.height) + glance_cells - 1) / glance_cells);
}

/// A square that should hold all of what is in this box and goes on beyond.
PixelRectangle around_cut(const PixelRectangle& box) {
  const int side = std::min(2 * std::max(box.width, box.height) + 2 * table_around, largest_side);
  return {box.left + (box.width - side) / 2, box.top + (box.height - side) / 2, side, side};
}

}  // namespace

void PartFinder::prepare(std::span<const PartModel> parts, SurfaceColour table,
                         double darkest_shadow) noexcept {
  parts_ = parts.first(std::min(parts.size(), most_kinds));
  classes_.prepare(parts_, table, darkest_shadow);
}

Glance PartFinder::glance(const PictureView& picture, const PixelRectangle& rectangle,
                          const PixelRectangle& blind) noexcept {
  Glance seen;
  seen.pixels = look(picture, rectangle, blind, glance_scale(rectangle));
  seen.least = bitmap_.smallest_blob();
  const Blob* const blob = blob_in_the_middle_of(rectangle);
  if (blob == nullptr) return seen;
  seen.pixel_class = blob->pixel_class;
  seen.is_cut = bitmap_.is_cut(*blob, picture);
  seen.middle = bitmap_.box_of(*blob);
  const PixelRectangle near = widened(seen.middle, table_around);
  for (const Blob& other : bitmap_.blobs()) {
    const PixelRectangle box = bitmap_.box_of(other);
    if (!common_part(box, near).is_empty()) seen.rectangle = around_both(seen.rectangle, box);
  }
  const int border = table_beside + bitmap_.scale();
  seen.rectangle = common_part(widened(seen.rectangle, border), bitmap_.rectangle());
  return seen;
}

Glance PartFinder::glance_around(const PictureView& picture, const Glance& cut,
                                 const PixelRectangle& blind) noexcept {
  Glance seen = glance(picture, around_cut(cut.middle), blind);
  seen.pixels += cut.pixels;
  return seen;
}

std::span<const Finding> PartFinder::measure(const PictureView& picture, const Glance& at,
                                             const PixelRectangle& blind, const CameraView& view,
                                             const Finding& expected, const FindingLimits& limits) noexcept {
  count_ = 0;
  pixels_ = at.pixels + look(picture, at.rectangle, blind);
  PixelRectangle middle = at.middle;
  if (const Blob* const blob = blob_in_the_middle_of(middle);
      blob != nullptr && bitmap_.is_cut(*blob, picture)) {
    middle = around_cut(bitmap_.box_of(*blob));
    pixels_ += look(picture, middle, blind);
  }
  const Blob* const central = blob_in_the_middle_of(middle);
  is_complete_ = is_light_known_ && !bitmap_.is_full();
  for (const Blob& blob : bitmap_.blobs()) {
    // Of an obstacle at the border nobody knows where its middle is.
    const bool may_be_obstacle = &blob == central || !bitmap_.is_cut(blob, picture);
    const bool is_told = tell(blob, may_be_obstacle, view, expected, limits);
    is_complete_ = is_complete_ && (is_told || !may_be_obstacle || is_small(blob, view, limits));
  }
  return {findings_.data(), count_};
}

std::span<const Finding> PartFinder::measure_all(const PictureView& picture, const PixelRectangle& rectangle,
                                                 const PixelRectangle& blind, const CameraView& view,
                                                 const FindingLimits& limits,
                                                 std::span<const Eigen::Vector2d, 4> place) noexcept {
  count_ = 0;
  pixels_ = look(picture, rectangle, blind);
  is_complete_ = is_light_known_ && !bitmap_.is_full();
  for (const Blob& blob : bitmap_.blobs()) {
    const bool is_in_place = meets(blob, place);
    // Of a piece beside the place nobody knows where its middle is, and nobody has to.
    const bool is_told = tell(blob, is_in_place || !bitmap_.is_cut(blob, picture), view, Finding{}, limits);
    is_complete_ = is_complete_ && (is_told || !is_in_place || is_small(blob, view, limits));
  }
  return {findings_.data(), count_};
}

/// False: it is neither a part, or a piece of one, nor is there a finding of it.
bool PartFinder::tell(const Blob& blob, bool may_be_obstacle, const CameraView& view, const Finding& expected,
                      const FindingLimits& limits) noexcept {
  const std::size_t before = count_;
  const bool is_part = blob.pixel_class != class_foreign && find_parts(blob, view, expected, limits);
  if (!is_part && may_be_obstacle) find_obstacle(blob, view, limits);
  return is_part || count_ > before;
}

/// Some of it lies in the place.
bool PartFinder::meets(const Blob& blob, std::span<const Eigen::Vector2d, 4> place) const noexcept {
  const auto is_inside = [&](const Eigen::Vector2d& pixel) {
    int lefts = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
      const Eigen::Vector2d along = place[(i + 1) % place.size()] - place[i];
      const Eigen::Vector2d to = pixel - place[i];
      if (along.x() * to.y() - along.y() * to.x() > 0) ++lefts;
    }
    return lefts == 0 || lefts == static_cast<int>(place.size());
  };
  for (int row = blob.top; row <= blob.bottom; ++row)
    for (int column = blob.left; column <= blob.right; ++column)
      if (bitmap_.label(column, row) == blob.label && is_inside(pixel_of(column + 0.5, row + 0.5)))
        return true;
  return false;
}

/// Less than an obstacle has, wherever it stands.
bool PartFinder::is_small(const Blob& blob, const CameraView& view,
                          const FindingLimits& limits) const noexcept {
  Eigen::Vector2d place;
  const Eigen::Vector2d pixel = pixel_of(blob.middle_column, blob.middle_row);
  if (!view.to_plane(pixel.x(), pixel.y(), 0, place)) return false;
  const double scale = view.pixels_per_metre({place.x(), place.y(), 0}) / bitmap_.scale();
  return blob.area < limits.least_obstacle * scale * scale;
}

/// That covers the middle of the rectangle, or else lies nearest to it; null: there is none.
const Blob* PartFinder::blob_in_the_middle_of(const PixelRectangle& rectangle) const noexcept {
  const PixelRectangle within = common_part(rectangle, bitmap_.rectangle());
  const double column = (within.left + 0.5 * within.width - bitmap_.rectangle().left) / bitmap_.scale();
  const double row = (within.top + 0.5 * within.height - bitmap_.rectangle().top) / bitmap_.scale();
  const std::uint8_t label = bitmap_.label(static_cast<int>(column), static_cast<int>(row));
  for (const Blob& blob : bitmap_.blobs())
    if (blob.label == label) return &blob;
  const Blob* nearest = nullptr;
  double least = 0;
  for (const Blob& blob : bitmap_.blobs()) {
    const double distance =
        std::hypot(0.5 * (blob.left + blob.right + 1) - column, 0.5 * (blob.top + blob.bottom + 1) - row);
    if (nearest != nullptr && distance >= least) continue;
    nearest = &blob;
    least = distance;
  }
  return nearest;
}

/// How many pixels that were.
std::uint32_t PartFinder::look(const PictureView& picture, const PixelRectangle& rectangle,
                               const PixelRectangle& blind, int least_scale) noexcept {
  bitmap_.take(picture, rectangle, blind, classes_, balance_, least_scale);
  return static_cast<std::uint32_t>(bitmap_.columns() * bitmap_.rows());
}

/// The parts of one kind in a blob, one after the other; each takes its points of the contour away. Where the
/// one that is expected is there, it is all that was asked for. False: it is too large to be a part, and none
/// is in it.
bool PartFinder::find_parts(const Blob& blob, const CameraView& view, const Finding& expected,
                            const FindingLimits& limits) noexcept {
  const std::size_t kind = blob.pixel_class - class_first_part;
  const PartModel& part = parts_[kind];
  if (!contour_.follow(bitmap_, blob, view, part.height)) return true;
  const double share = contour_.area() / part.area;
  // Less than this of a part is not enough to say.
  if (share < least_share) return true;
  if (expected.kind == kind) {
    const OutlineFit fit =
        fit_outline(part, expected.pose, contour_.points(), expected_width, expected_iterations);
    // Of one that stands alone all of the outline is seen.
    const double support = share < most_alone ? support_alone : support_among_others;
    if (fit.support >= support && fit.residual <= limits.most_residual &&
        filled(part, fit.pose, blob, view) >= least_filled) {
      note(part, kind, fit, view);
      return true;
    }
  }
  bool any = false;
  for (int i = 0; i < parts_of_a_blob && count_ < most_findings; ++i) {
    if (share - i < least_share) return true;
    starts_.clear();
    if (i == 0 && expected.kind == kind) starts_.add(expected.pose);
    if (i == 0 && share < 1.35) starts_.add_around(part, contour_.middle());
    if (i > 0 || share < 0.85 || share > most_alone) starts_.add_at_corners(part, contour_.points());
    const OutlineFit fit = best_fit(part, blob, view);
    if (fit.support < limits.least_support || fit.residual > limits.most_residual) break;
    any = true;
    note(part, kind, fit, view);
    for (ContourPoint& point : contour_.points())
      if (distance_from(part, fit.pose, point.position) < explained) point.is_edge = false;
  }
  // What goes on behind the hand may be what the hand holds: it is larger than on the table, as it is nearer.
  return any || share < least_of_an_obstacle || contour_.meets_blind();
}

void PartFinder::note(const PartModel& part, std::size_t kind, const OutlineFit& fit,
                      const CameraView& view) noexcept {
  if (count_ == most_findings) return;
  Finding& finding = findings_[count_++];
  finding = {};
  finding.found = VisualClass::target;
  finding.kind = static_cast<std::uint16_t>(kind);
  finding.pose = fit.pose;
  finding.height = part.height;
  finding.radius = part.radius;
  finding.residual = fit.residual;
  finding.support = fit.support;
  view.to_picture({fit.pose.position.x(), fit.pose.position.y(), part.height}, finding.pixel);
}

/// The best of all starts that fills its outline; support 0: none does.
OutlineFit PartFinder::best_fit(const PartModel& part, const Blob& blob, const CameraView& view) noexcept {
  const auto points = contour_.points();
  const std::size_t stride = std::max<std::size_t>(points.size() / coarse_points, 1);
  struct Candidate {
    double agreement = 0;
    const OutlinePose* pose = nullptr;
  };
  // The best first.
  std::array<Candidate, finalists> best{};
  for (const OutlinePose& start : starts_.all()) {
    Candidate candidate{agreement(part, start, points, coarse_width, stride), &start};
    for (Candidate& one : best)
      if (candidate.agreement > one.agreement) std::swap(candidate, one);
  }
  OutlineFit fit;
  double score = 0;
  for (const Candidate& candidate : best) {
    if (candidate.pose == nullptr) break;
    const OutlineFit one = fit_outline(part, *candidate.pose, points, fine_width, iterations);
    if (one.support * one.support <= score) continue;
    const double inside = filled(part, one.pose, blob, view);
    if (inside < least_filled) continue;
    // Of two that are seen as well the one that lies nearer.
    const double one_score = one.support * one.support * inside / (1 + one.residual / 0.002);
    if (one_score <= score) continue;
    score = one_score;
    fit = one;
    if (one.support >= beyond_doubt && inside >= beyond_doubt) break;
  }
  return fit;
}

/// Part of the outline's inside where the blob is, and not the table. What something else hides does not
/// count, nor what lies beyond the border of what was looked at; but half of it has to be seen.
double PartFinder::filled(const PartModel& part, const OutlinePose& pose, const Blob& blob,
                          const CameraView& view) const noexcept {
  constexpr int half = 3;
  const double step = part.radius / (half + 0.5);
  const double cosine = std::cos(pose.angle);
  const double sine = std::sin(pose.angle);
  int all = 0;
  int looked = 0;
  int within = 0;
  for (int row = -half; row <= half; ++row) {
    for (int column = -half; column <= half; ++column) {
      const Eigen::Vector2d own(column * step, row * step);
      if (!is_within(part, {}, own) || distance_from(part, {}, own) < explained) continue;
      const Eigen::Vector2d at = pose.position + Eigen::Vector2d(cosine * own.x() - sine * own.y(),
                                                                 sine * own.x() + cosine * own.y());
      ++all;
      Eigen::Vector2d pixel;
      if (!view.to_picture({at.x(), at.y(), part.height}, pixel)) continue;
      const auto cell_of = [this](double position, int first) {
        return static_cast<int>(std::floor((position - first) / bitmap_.scale()));
      };
      const int cell_column = cell_of(pixel.x(), bitmap_.rectangle().left);
      const int cell_row = cell_of(pixel.y(), bitmap_.rectangle().top);
      if (!bitmap_.is_seen(cell_column, cell_row)) continue;
      const std::uint8_t label = bitmap_.label(cell_column, cell_row);
      if (label == blob.label) ++within;
      if (label == blob.label || label == 0) ++looked;
    }
  }
  return 2 * within < all || looked == 0 ? 0.0 : static_cast<double>(within) / looked;
}

void PartFinder::find_obstacle(const Blob& blob, const CameraView& view,
                               const FindingLimits& limits) noexcept {
  if (count_ == most_findings) return;
  if (!contour_.follow(bitmap_, blob, view, 0) || contour_.area() < limits.least_obstacle) return;
  ObstacleFoot foot;
  if (!find_foot(contour_.points(), view, limits.obstacle_height, foot)) return;
  Finding& finding = findings_[count_++];
  finding = {};
  finding.found = VisualClass::obstacle;
  finding.pose.position = foot.middle;
  finding.height = limits.obstacle_height;
  finding.radius = foot.radius;
  finding.lean = foot.lean;
  finding.support = contour_.seen();
  finding.pixel = pixel_of(blob.middle_column, blob.middle_row);
  finding.box = bitmap_.box_of(blob);
}

/// Of a place in the bitmap, in cells.
Eigen::Vector2d PartFinder::pixel_of(double column, double row) const noexcept {
  return {bitmap_.rectangle().left + column * bitmap_.scale(),
          bitmap_.rectangle().top + row * bitmap_.scale()};
}

}  // namespace flexrf::user
