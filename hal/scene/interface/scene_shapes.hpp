// Shapes of bodies, of the hand and of links, which world, renderer and whoever looks at pictures share.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "hal/scene/interface/part_catalogue.hpp"
#include "types/scene_body.hpp"
#include "types/scene_state.hpp"

namespace flexrf {

/// Of a body in its own frame, in m; without corners for SceneKind::none.
Outline outline_of(const SceneBody& body) noexcept;

/// The same as convex outlines that share sides and no area.
struct OutlinePieces {
  std::array<Outline, 2> pieces{};
  std::size_t count = 0;

  std::span<const Outline> all() const& noexcept { return {pieces.data(), count}; }
  /// As of an outline.
  std::span<const Outline> all() const&& = delete;
};
OutlinePieces pieces_of(const SceneBody& body) noexcept;

/// Turned by an angle in rad, then moved.
Outline placed(const Outline& outline, PlaneVector position, double angle) noexcept;

BodyColour colour_of(SceneKind kind) noexcept;

/// A part of the catalogue, upright on the table.
SceneBody part_at(SceneKind kind, PlaneVector position, double angle) noexcept;

/// The body's frame in the scene's, and back: angle and tilt are found so that pose_of() gives it again.
Eigen::Isometry3d pose_of(const SceneBody& body) noexcept;
void set_pose(SceneBody& body, const Eigen::Isometry3d& pose) noexcept;

/// The held part goes to where the tool holds it: for a time between two of the scene's steps.
void carry_held_part(SceneState& state, const Eigen::Isometry3d& tool) noexcept;

/// A two-finger hand on the tool's frame: it reaches along z, its fingers close along y.
struct HandModel {
  double reach = 0.16;              ///< m from the tool's frame to the fingertips
  double finger_length = 0.05;      ///< m along z
  double finger_width = 0.02;       ///< m along x
  double finger_thickness = 0.008;  ///< m along y
  double palm_depth = 0.03;         ///< m along z, behind the fingers
  double palm_width = 0.05;         ///< m along x
  double palm_length = 0.13;        ///< m along y
};
/// In the tool's frame, its sides along the axes.
struct HandBox {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
};
/// The finger on the side of +y, the other, and the palm.
std::array<HandBox, 3> hand_boxes(const HandModel& hand, double opening) noexcept;
/// The eight corners, x changing first, then y, in the frame that `pose` gives the box's.
std::array<Eigen::Vector3d, 8> corners_of(const HandBox& box, const Eigen::Isometry3d& pose) noexcept;

}  // namespace flexrf
