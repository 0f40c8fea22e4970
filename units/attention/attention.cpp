#include "units/attention/attention.hpp"

#include <algorithm>
#include <cmath>

#include "units/vision/hidden_part.hpp"

namespace flexrf::user {
namespace {

// What each attribute is divided by, so that a weight of 1 means about as much for each.
constexpr double much_colour = 32;
constexpr double much_contrast = 48;
constexpr double much_change = 16;
constexpr double much_edge = 24;
constexpr double near_expected = 16;  // px of the half-size picture
// Two windows that share more than this of the smaller one are the same region.
constexpr double shared = 0.35;
// Below this no window of the picture stands out.
constexpr double least_difference = 0.02;

double mean_of(const std::array<std::uint32_t, feature_row*(feature_height + 1)>& sums,
               const FeatureWindow& window) {
  return window_sum(sums, window) / window.area();
}

/// What lies between the window and the one around it, per pixel.
double mean_around(const std::array<std::uint32_t, feature_row*(feature_height + 1)>& sums,
                   const FeatureWindow& outer, const FeatureWindow& inner) {
  const double area = outer.area() - inner.area();
  return area > 0 ? (window_sum(sums, outer) - window_sum(sums, inner)) / area : mean_of(sums, inner);
}

}  // namespace

Status Attention::initialise() {
  member_ = member_number(name());
  if (member_ >= most_members)
    return Status::error(
        StatusCode::invalid_argument,
        "%s: there are at most %zu members of attention; give the population a smaller capacity", name(),
        most_members);
  reset();
  return check_camera(configuration.camera);
}

void Attention::reset() noexcept {
  window_count_ = 0;
  expected_.count = 0;
  found_ = {};
  feedback = {};
  features.forget();
}

void Attention::step(const Tick& /*tick*/) {
  const auto of = features.latest();
  if (!of || !of.is_new()) return;
  const auto hand = in_hand.latest();
  blind_ = hidden_part(configuration.camera, hand ? &*hand : nullptr);
  find_expected(*of);
  rate_windows(*of);
  condense(*of);
  post(of.sampled_at());
  ++feedback.pictures;
  feedback.found = found_.count;
  feedback.cost = found_.pixels;
  feedback.windows = static_cast<std::uint32_t>(window_count_);
  feedback.expects = static_cast<std::uint32_t>(expected_.count);
}

/// Without tracks, or without the tool's pose at the time of the picture, nothing is expected anywhere.
void Attention::find_expected(const VisualFeatures& of) noexcept {
  expected_.count = 0;
  const auto list = tracks.latest();
  Pose tool{};
  if (!list || runtime.expectation == 0 ||
      tool_pose_at(tool_poses, Time{Duration{of.time}}, tool) != NullReason::none)
    return;
  const CameraView view(configuration.camera, tool);
  for (const ObjectTrack& track : list->tracks) {
    if (track.found == VisualClass::nothing || expected_.count == expected_.places.size()) continue;
    Eigen::Vector2d pixel;
    if (!view.to_picture({track.position[0], track.position[1], 0.0}, pixel)) continue;
    pixel /= 2;
    if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= feature_width || pixel.y() >= feature_height) continue;
    expected_.places[expected_.count++] = pixel;
  }
}

void Attention::rate_windows(const VisualFeatures& of) noexcept {
  window_count_ = 0;
  const auto grids = window_grids(runtime.smallest, runtime.spacing);
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const WindowGrid& grid = grids[i];
    const double size = static_cast<double>(i) - 1;
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
      for (std::uint32_t column = 0; column < grid.columns; ++column) {
        const std::uint32_t left = column * grid.step;
        const std::uint32_t top = row * grid.step;
        const FeatureWindow window{left, top, left + grid.side, top + grid.side};
        if (is_hidden(window) || window_count_ == windows_.size()) continue;
        Window& one = windows_[window_count_++];
        one.rating = static_cast<float>(rate(of, window, size));
        one.left = static_cast<std::uint16_t>(left);
        one.top = static_cast<std::uint16_t>(top);
        one.side = static_cast<std::uint16_t>(grid.side);
      }
    }
  }
}

bool Attention::is_hidden(const FeatureWindow& window) const noexcept {
  return !common_part({static_cast<int>(2 * window.left), static_cast<int>(2 * window.top),
                       static_cast<int>(2 * (window.right - window.left)),
                       static_cast<int>(2 * (window.bottom - window.top))},
                      blind_)
              .is_empty();
}

double Attention::rate(const VisualFeatures& of, const FeatureWindow& window, double size) const noexcept {
  const std::uint32_t margin = (window.right - window.left) / 2;
  const FeatureWindow outer{
      window.left > margin ? window.left - margin : 0, window.top > margin ? window.top - margin : 0,
      std::min(window.right + margin, feature_width), std::min(window.bottom + margin, feature_height)};
  const double colour =
      std::abs(mean_of(of.red_green, window) - mean_around(of.red_green, outer, window)) +
      std::abs(mean_of(of.yellow_blue, window) - mean_around(of.yellow_blue, outer, window));
  const double brightness = mean_of(of.luminance, window);
  const double variance = mean_of(of.luminance_squared, window) - brightness * brightness;
  const double contrast =
      std::abs(brightness - mean_around(of.luminance, outer, window)) + std::sqrt(std::max(variance, 0.0));
  double rating = runtime.colour * colour / much_colour + runtime.contrast * contrast / much_contrast +
                  runtime.motion * mean_of(of.changes, window) / much_change + runtime.size * 0.2 * size +
                  runtime.edges * mean_of(of.edges, window) / much_edge;
  if (expected_.count == 0) return rating;
  const Eigen::Vector2d middle(0.5 * (window.left + window.right), 0.5 * (window.top + window.bottom));
  double nearest = 1e12;
  for (std::size_t i = 0; i < expected_.count; ++i)
    nearest = std::min(nearest, (expected_.places[i] - middle).squaredNorm());
  rating += runtime.expectation / (1 + nearest / (near_expected * near_expected));
  return rating;
}

/// From the best window on, each with what overlaps it (non-maximum suppression), as long as they stand out.
void Attention::condense(const VisualFeatures& of) noexcept {
  found_ = {};
  found_.frame = of.frame;
  found_.identity = runtime.identity;
  found_.probation = runtime.probation;
  found_.genes = genes();
  found_.pixels = static_cast<std::uint32_t>(values_per_window * static_cast<double>(window_count_));
  if (window_count_ == 0) return;
  double sum = 0;
  for (std::size_t i = 0; i < window_count_; ++i) sum += static_cast<double>(windows_[i].rating);
  const double mean = sum / static_cast<double>(window_count_);
  double least = 0;
  while (found_.count < runtime.regions && found_.count < most_regions) {
    const std::size_t best = best_window();
    if (best == window_count_) return;
    const Window window = windows_[best];
    const auto rating = static_cast<double>(window.rating);
    if (found_.count == 0) {
      if (rating - mean < least_difference) return;
      least = mean + runtime.selectivity * (rating - mean);
    }
    if (rating < least) return;
    VisionRegion& region = found_.regions[found_.count];
    // Ranks, not ratings: a member with loud weights would win the queue by them.
    region.score = 1.0 - static_cast<double>(found_.count) / most_regions;
    region.frame = of.frame;
    region.time = of.time;
    region.left = static_cast<std::uint16_t>(2 * window.left);
    region.top = static_cast<std::uint16_t>(2 * window.top);
    region.width = region.height = static_cast<std::uint16_t>(2 * window.side);
    region.member = member_;
    region.identity = runtime.identity;
    region.probation = runtime.probation;
    region.kind = 0xFFFF;
    ++found_.count;
    suppress_around(window);
  }
}

/// window_count_: none is left.
std::size_t Attention::best_window() const noexcept {
  std::size_t best = window_count_;
  for (std::size_t i = 0; i < window_count_; ++i)
    if (windows_[i].side != 0 && (best == window_count_ || windows_[i].rating > windows_[best].rating))
      best = i;
  return best;
}

void Attention::suppress_around(const Window& window) noexcept {
  for (std::size_t i = 0; i < window_count_; ++i) {
    Window& other = windows_[i];
    const int across =
        std::min(window.left + window.side, other.left + other.side) - std::max(window.left, other.left);
    const int down =
        std::min(window.top + window.side, other.top + other.side) - std::max(window.top, other.top);
    if (other.side == 0 || across <= 0 || down <= 0) continue;
    const int smaller = std::min(window.side, other.side);
    if (across * down > shared * smaller * smaller) other.side = 0;
  }
}

/// The report first: who judges by it knows of each region before there is a verdict on it.
void Attention::post(Time sampled_at) noexcept {
  report.publish(found_, sampled_at);
  for (std::uint32_t i = 0; i < found_.count; ++i)
    if (!regions.push(found_.regions[i], sampled_at)) ++feedback.lost;
}

Genes Attention::genes() const noexcept {
  return {runtime.colour,      runtime.contrast,
          runtime.motion,      runtime.size,
          runtime.edges,       runtime.expectation,
          runtime.spacing,     runtime.smallest,
          runtime.selectivity, static_cast<double>(runtime.regions)};
}

}  // namespace flexrf::user
