// Tables of the scene as its camera shows them, with what is truly there: for whoever judges recognition from
// outside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "hal/scene/interface/scene_shapes.hpp"
#include "hal/scene/renderer/hand_eye.hpp"
#include "hal/scene/renderer/scene_renderer.hpp"
#include "hal/scene/world/plane_geometry.hpp"
#include "hal/scene/world/solid.hpp"
#include "hal/scene/world/table_layout.hpp"
#include "motion/pose_conversion.hpp"
#include "units/vision/camera_view.hpp"
#include "units/vision/region_bitmap.hpp"

namespace flexrf::user {

inline CameraModel camera_on(const Eigen::Isometry3d& mount, const std::array<std::uint32_t, 4>& blind) {
  CameraModel camera{};
  camera.focal_length = 600;
  camera.principal_point = {320, 240};
  camera.width = 640;
  camera.height = 480;
  camera.mount = to_pose(mount);
  camera.blind = blind;
  return camera;
}

/// Beside the hand, which is seen at the picture's lower edge: as units have it unless told otherwise.
inline CameraModel camera_before_the_hand() {
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translation() = Eigen::Vector3d(0.05, 0, 0.05);
  mount.linear() = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return camera_on(mount, {0, 450, 640, 30});
}
/// As `camera_optical` of six-axis-gripper.urdf: the hand is seen at the right edge.
inline CameraModel camera_behind_the_hand() {
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translation() = Eigen::Vector3d(-0.08, 0, 0);
  return camera_on(mount, {570, 0, 70, 480});
}

enum class Look : std::uint8_t { down, tilted, approach, carrying };
inline constexpr std::array<const char*, 4> look_names{"down", "tilted", "approach", "carrying"};

/// One picture, and what a unit is told with it.
struct SeenTable {
  SceneState state{};
  Look look = Look::down;
  Pose tool{};
  CameraView told;  ///< as a unit computes it
  CameraView real;
  std::vector<std::uint8_t> bytes;
  std::array<std::uint32_t, 4> blind{};

  PictureView picture() const { return {bytes.data(), 1920, 640, 480}; }
};

/// Makes tables and pictures of them. All is decided by the seed.
class TableSeer {
 public:
  explicit TableSeer(std::uint64_t seed) { random_.seed(seed); }

  SceneRandom& random() { return random_; }
  const SeenTable& table() const { return table_; }

  /// Another table in another light, seen by a camera that is calibrated as well as one can.
  void lay(const CameraModel& camera) {
    camera_ = camera;
    lay_table(table_.state, random_, {});
    const bool usual = random_.below(3) == 0;
    const double azimuth = usual ? 0.9 : random_.between(0, 2 * std::numbers::pi);
    const double elevation = usual ? 1.1 : random_.between(0.8, 1.4);
    table_.state.light = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                          std::sin(elevation)};
    table_.state.light_intensity = usual ? 1 : random_.between(0.6, 1.4);
    table_.state.opening = random_.between(0.0, 0.08);
    HandEye told;
    told.pose = to_isometry(camera.mount);
    told.focal_length = camera.focal_length;
    real_ = disturbed(told, {0.001, 0.0035, 0.005}, random_.bits());
    RendererPlan plan;
    plan.pinhole.focal_length = real_.focal_length;
    plan.seed = random_.bits();
    renderer_.begin(plan);
    table_.bytes.resize(std::size_t{640} * 480 * 3);
  }

  const SeenTable& see(Look look) {
    table_.look = look;
    Eigen::Vector3d eye(random_.between(0.32, 0.58), random_.between(-0.22, 0.22),
                        random_.between(0.25, 0.55));
    if (look == Look::approach) {
      const SceneBody& part = table_.state.parts[random_.below(12)];
      eye = Eigen::Vector3d(part.position[0] + random_.between(-0.03, 0.03),
                            part.position[1] + random_.between(-0.03, 0.03),
                            part.size[2] + random_.between(0.15, 0.30));
    }
    Eigen::Isometry3d camera = Eigen::Isometry3d::Identity();
    camera.linear() = (Eigen::AngleAxisd(random_.between(0, 2 * std::numbers::pi), Eigen::Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()))
                          .toRotationMatrix();
    if (look == Look::tilted) {
      const double about = random_.between(0, 2 * std::numbers::pi);
      camera.linear() *=
          Eigen::AngleAxisd(random_.between(0.05, 0.35), Eigen::Vector3d(std::cos(about), std::sin(about), 0))
              .toRotationMatrix();
    }
    camera.translation() = eye;
    const Eigen::Isometry3d tool = camera * to_isometry(camera_.mount).inverse();
    const Eigen::Isometry3d real = tool * real_.pose;
    table_.tool = to_pose(tool);
    table_.told = CameraView(camera_, table_.tool);
    CameraModel real_camera = camera_;
    real_camera.mount = to_pose(real_.pose);
    real_camera.focal_length = real_.focal_length;
    table_.real = CameraView(real_camera, table_.tool);
    table_.blind = camera_.blind;
    table_.state.held = look == Look::carrying ? 1 + random_.below(12) : 0;
    if (look == Look::carrying) hold(table_.state, tool);
    renderer_.draw(table_.state, real, tool, ++frame_, table_.bytes);
    return table_;
  }

 private:
  /// Between the fingertips, which reach 15 mm down along the part.
  void hold(SceneState& state, const Eigen::Isometry3d& tool) {
    const SceneBody& part = state.parts[state.held - 1];
    Eigen::Isometry3d grip = Eigen::Isometry3d::Identity();
    grip.translation().z() = HandModel{}.reach + part.size[2] - 0.015;
    grip.linear() = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
    const Pose pose = to_pose(grip);
    state.grip_position = pose.position;
    state.grip_orientation = pose.orientation;
    state.opening = 0.03;
    carry_held_part(state, tool);
  }

  SceneRandom random_;
  CameraModel camera_{};
  HandEye real_;
  SceneRenderer renderer_;
  SeenTable table_;
  std::uint64_t frame_ = 0;
};

inline bool is_in_picture(const SeenTable& table, const Eigen::Vector2d& pixel) {
  const auto& blind = table.blind;
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < 640 && pixel.y() < 480 &&
         !(pixel.x() >= blind[0] && pixel.y() >= blind[1] && pixel.x() < blind[0] + blind[2] &&
           pixel.y() < blind[1] + blind[3]);
}

inline bool is_held(const SeenTable& table, const SceneBody& part) {
  return table.state.held != 0 && &part == &table.state.parts[table.state.held - 1];
}

/// What lies between a point and the camera.
inline bool is_hidden(const SeenTable& table, const SceneBody& own, const Eigen::Vector3d& point) {
  const Eigen::Vector3d way = table.real.position() - point;
  const auto hides = [&](const SceneBody& body) {
    if (body.kind == SceneKind::none || &body == &own) return false;
    // Along the ray up to the body's top.
    const double rise = (body.size[2] - point.z()) / way.z();
    if (!(rise > 0)) return false;
    const OutlinePieces pieces = pieces_of(body);
    for (const Outline& piece : pieces.all()) {
      const Outline there = placed(piece, {body.position[0], body.position[1]}, body.angle);
      constexpr int steps = 60;
      for (int i = 1; i <= steps; ++i) {
        const Eigen::Vector3d at = point + way * (rise * i / steps);
        bool inside = there.count > 2;
        for (std::size_t k = 0; k < there.count && inside; ++k) {
          const PlaneVector a = there.corners[k];
          const PlaneVector b = there.corners[(k + 1) % there.count];
          inside = (b.x - a.x) * (at.y() - a.y) - (b.y - a.y) * (at.x() - a.x) > 0;
        }
        if (inside) return true;
      }
    }
    return false;
  };
  return std::any_of(table.state.parts.begin(), table.state.parts.end(), hides) ||
         std::any_of(table.state.obstacles.begin(), table.state.obstacles.end(), hides);
}

/// How a part is seen.
struct PartSight {
  double within = 0;   ///< part of its top that lies in the picture, and not behind the hand
  double visible = 0;  ///< and that nothing hides
  bool touches = false;
};

inline PartSight sight_of(const SeenTable& table, const SceneBody& part) {
  const Outline outline = placed(outline_of(part), {part.position[0], part.position[1]}, part.angle);
  PlaneVector low{1e9, 1e9};
  PlaneVector high{-1e9, -1e9};
  for (const PlaneVector corner : outline.all()) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  constexpr int grid = 14;
  int all = 0;
  int within = 0;
  int visible = 0;
  for (int i = 0; i < grid * grid; ++i) {
    const int column = i % grid;
    const int row = i / grid;
    const PlaneVector at{low.x + (high.x - low.x) * (column + 0.5) / grid,
                         low.y + (high.y - low.y) * (row + 0.5) / grid};
    bool inside = false;
    for (std::size_t a = 0, b = outline.count - 1; a < outline.count; b = a++) {
      const PlaneVector p = outline.corners[a];
      const PlaneVector q = outline.corners[b];
      if ((p.y > at.y) != (q.y > at.y) && at.x < p.x + (q.x - p.x) * (at.y - p.y) / (q.y - p.y))
        inside = !inside;
    }
    if (!inside) continue;
    ++all;
    const Eigen::Vector3d point(at.x, at.y, part.size[2]);
    Eigen::Vector2d pixel;
    if (!table.real.to_picture(point, pixel) || !is_in_picture(table, pixel)) continue;
    ++within;
    if (!is_hidden(table, part, point)) ++visible;
  }
  PartSight sight;
  sight.within = static_cast<double>(within) / std::max(all, 1);
  sight.visible = static_cast<double>(visible) / std::max(all, 1);
  for (const SceneBody& other : table.state.parts)
    if (&other != &part && other.kind != SceneKind::none &&
        separation_of(footprint_of(other), footprint_of(part), 0.001).gap < 0.001)
      sight.touches = true;
  return sight;
}

/// The box about all that is seen of a body, in pixels.
inline PixelRectangle box_of(const SeenTable& table, const SceneBody& body) {
  const Outline outline = placed(outline_of(body), {body.position[0], body.position[1]}, body.angle);
  Eigen::Vector2d low(1e9, 1e9);
  Eigen::Vector2d high(-1e9, -1e9);
  for (const PlaneVector corner : outline.all())
    for (const double z : {0.0, body.size[2]}) {
      Eigen::Vector2d pixel(0, 0);
      if (!table.real.to_picture({corner.x, corner.y, body.position[2] + z}, pixel)) return {};
      low = low.cwiseMin(pixel);
      high = high.cwiseMax(pixel);
    }
  return {static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(high.x() - low.x()) + 1,
          static_cast<int>(high.y() - low.y()) + 1};
}

}  // namespace flexrf::user
