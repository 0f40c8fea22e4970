#include "benchmarks/evolution/scripted_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "attention_unit.hpp"
#include "hal/scene/world/scene_random.hpp"
#include "motion/pose_conversion.hpp"
#include "units/vision/integral_images.hpp"

namespace flexrf::bench {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;
constexpr double blind_from = 450;  // row below which the picture shows the hand
constexpr double opening = 0.06;    // m, of the fingers

/// Between -1 and 1.
double swing(double seconds, double period, double phase) {
  return std::sin(whole_turn * seconds / period + phase);
}

/// Beside a two-finger hand, as units have it unless their tables say otherwise.
const user::CameraModel& camera_model() {
  static const user::CameraModel camera = user::AttentionConfiguration{}.camera;
  return camera;
}

/// Of a point in the camera's frame.
Eigen::Vector2d in_picture(const Eigen::Vector3d& seen) {
  const user::CameraModel& camera = camera_model();
  return {camera.principal_point[0] + camera.focal_length * seen.x() / seen.z(),
          camera.principal_point[1] + camera.focal_length * seen.y() / seen.z()};
}

}  // namespace

double SeenBody::overlap(const user::VisionRegion& region) const noexcept {
  const double across = std::min(right, static_cast<double>(region.left) + region.width) -
                        std::max(left, static_cast<double>(region.left));
  const double down = std::min(bottom, static_cast<double>(region.top) + region.height) -
                      std::max(top, static_cast<double>(region.top));
  if (across <= 0 || down <= 0) return 0;
  const double shared = across * down;
  return shared /
         ((right - left) * (bottom - top) + static_cast<double>(region.width) * region.height - shared);
}

void ScriptedView::begin(std::uint64_t seed) {
  world_.begin(HandModel{}, seed);
  RendererPlan plan;
  plan.seed = seed;
  renderer_.begin(plan);
  SceneRandom random;
  random.seed(seed ^ 0x5EED);
  for (double& phase : phase_) phase = random.between(0, whole_turn);
  state_ = world_.state();
  state_.opening = opening;
  body_count_ = 0;
  const auto add = [this](const SceneBody& body) {
    if (body.kind != SceneKind::none) bodies_[body_count_++] = body;
  };
  std::for_each(state_.parts.begin(), state_.parts.end(), add);
  std::for_each(state_.obstacles.begin(), state_.obstacles.end(), add);
}

Pose ScriptedView::tool_at(std::uint64_t picture) const noexcept {
  const double now = static_cast<double>(picture) * seconds(picture_period);
  const double turn = 0.4 * swing(now, 47, phase_[3]);
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
  tool.linear() = (Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  tool.translation() =
      Eigen::Vector3d(0.40 + 0.07 * swing(now, 23, phase_[0]), 0.14 * swing(now, 37, phase_[1]),
                      0.50 + 0.10 * swing(now, 31, phase_[2]));
  return to_pose(tool);
}

void ScriptedView::draw(std::uint64_t picture, std::span<std::uint8_t> pixels) noexcept {
  if (picture < change_at) {
    world_.set_light(1, 0.9, 1.1);
    world_.set_light_tint({0, 0, 0});
  } else {
    world_.set_light(0.5, -1.9, 0.65);
    world_.set_light_tint({0.15, 0, -0.2});
  }
  state_.light = world_.state().light;
  state_.light_intensity = world_.state().light_intensity;
  state_.light_tint = world_.state().light_tint;
  const Eigen::Isometry3d tool = to_isometry(tool_at(picture));
  renderer_.draw(state_, tool * to_isometry(camera_model().mount), tool, picture, pixels);
}

std::span<const SeenBody> ScriptedView::look(std::uint64_t picture) noexcept {
  const Eigen::Isometry3d camera = to_isometry(tool_at(picture)) * to_isometry(camera_model().mount);
  const Eigen::Isometry3d to_camera = camera.inverse();
  std::size_t count = 0;
  for (const SceneBody& body : bodies()) {
    if (!is_seen(body, camera)) continue;
    SeenBody seen{1e9, 1e9, -1e9, -1e9};
    const Outline outline = placed(outline_of(body), {body.position[0], body.position[1]}, body.angle);
    for (const PlaneVector corner : outline.all()) {
      for (const double height : {0.0, body.size[2]}) {
        const Eigen::Vector2d pixel = in_picture(to_camera * Eigen::Vector3d(corner.x, corner.y, height));
        seen.left = std::min(seen.left, pixel.x());
        seen.right = std::max(seen.right, pixel.x());
        seen.top = std::min(seen.top, pixel.y());
        seen.bottom = std::max(seen.bottom, pixel.y());
      }
    }
    seen.left = std::clamp(seen.left, 0.0, double{user::picture_width});
    seen.right = std::clamp(seen.right, 0.0, double{user::picture_width});
    seen.top = std::clamp(seen.top, 0.0, blind_from);
    seen.bottom = std::clamp(seen.bottom, 0.0, blind_from);
    seen_[count++] = seen;
  }
  return {seen_.data(), count};
}

/// By points of its top: the corners drawn in, and those between them and the middle.
bool ScriptedView::is_seen(const SceneBody& body, const Eigen::Isometry3d& camera) const noexcept {
  const Eigen::Isometry3d to_camera = camera.inverse();
  const Eigen::Vector3d eye = camera.translation();
  int all = 0;
  int seen = 0;
  const Outline outline = outline_of(body);
  for (const PlaneVector corner : outline.all()) {
    for (const double share : {0.9, 0.45}) {
      ++all;
      const Outline one = [&] {
        Outline point;
        point.add(corner * share);
        return placed(point, {body.position[0], body.position[1]}, body.angle);
      }();
      const Eigen::Vector3d point(one.corners[0].x, one.corners[0].y, body.size[2]);
      const Eigen::Vector3d ahead = to_camera * point;
      if (ahead.z() < 0.01) continue;
      const Eigen::Vector2d pixel = in_picture(ahead);
      if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= user::picture_width || pixel.y() >= blind_from)
        continue;
      const bool hidden = std::any_of(bodies().begin(), bodies().end(), [&](const SceneBody& other) {
        return &other != &body && is_hidden(other, point, eye);
      });
      if (!hidden) ++seen;
    }
  }
  return 2 * seen >= all;
}

/// The way from the point to the eye, as far as it is below the body's top, goes through the body's outline.
bool ScriptedView::is_hidden(const SceneBody& by, const Eigen::Vector3d& point,
                             const Eigen::Vector3d& eye) const noexcept {
  const double height = by.size[2];
  if (height <= point.z()) return false;
  const double share = std::min((height - point.z()) / (eye.z() - point.z()), 1.0);
  const PlaneVector from{point.x(), point.y()};
  const PlaneVector way = PlaneVector{eye.x() - point.x(), eye.y() - point.y()} * share;
  for (const Outline& piece : pieces_of(by).pieces) {
    if (piece.count == 0) continue;
    const Outline outline = placed(piece, {by.position[0], by.position[1]}, by.angle);
    double enters = 0;
    double leaves = 1;
    for (std::size_t i = 0; i < outline.count; ++i) {
      const PlaneVector corner = outline.corners[i];
      const PlaneVector side = outline.corners[(i + 1) % outline.count] - corner;
      // Above 0: to the left of the side, which is inside.
      const double begin = cross(side, from - corner);
      const double gain = cross(side, way);
      if (gain == 0) {
        if (begin < 0) leaves = -1;
        continue;
      }
      const double crossing = -begin / gain;
      if (gain > 0)
        enters = std::max(enters, crossing);
      else
        leaves = std::min(leaves, crossing);
    }
    if (enters < leaves) return true;
  }
  return false;
}

}  // namespace flexrf::bench
