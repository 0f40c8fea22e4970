// The flat faces of all that stands in a scene.
#pragma once

#include <array>
#include <span>

#include "hal/scene/interface/scene_shapes.hpp"

namespace flexrf {

/// Convex, in the scene's frame; its corners go around, in either direction.
struct SceneFace {
  std::array<Eigen::Vector3d, most_corners> corners;
  std::size_t count = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector, outwards
  BodyColour colour;

  void add(const Eigen::Vector3d& corner) noexcept { corners[count++] = corner; }
};

/// Calls visit(face) for each face of a body; the frame of its outline is `pose`.
template <class Visit>
void visit_body(const SceneBody& body, const Visit& visit) noexcept {
  if (body.kind == SceneKind::none) return;
  const Eigen::Isometry3d pose = pose_of(body);
  const double height = body.size[2];
  SceneFace face;
  face.colour = colour_of(body.kind);
  const auto at = [&pose](PlaneVector corner, double z) -> Eigen::Vector3d {
    return pose * Eigen::Vector3d(corner.x, corner.y, z);
  };
  const OutlinePieces pieces = pieces_of(body);
  for (const Outline& piece : pieces.all()) {
    for (const double z : {height, 0.0}) {
      face.count = 0;
      face.normal = pose.linear().col(2) * (z > 0 ? 1.0 : -1.0);
      for (const PlaneVector corner : piece.all()) face.add(at(corner, z));
      visit(face);
    }
  }
  const Outline outline = outline_of(body);
  for (std::size_t i = 0; i < outline.count; ++i) {
    const PlaneVector from = outline.corners[i];
    const PlaneVector to = outline.corners[i + 1 == outline.count ? 0 : i + 1];
    const PlaneVector outward = -left_of(unit(to - from));
    face.count = 0;
    face.normal = pose.linear() * Eigen::Vector3d(outward.x, outward.y, 0);
    face.add(at(from, 0));
    face.add(at(to, 0));
    face.add(at(to, height));
    face.add(at(from, height));
    visit(face);
  }
}

/// Likewise of a box of the hand.
template <class Visit>
void visit_box(const HandBox& box, const Eigen::Isometry3d& pose, const Visit& visit) noexcept {
  // Of the corners as corners_of() gives them, around each face; first the two across x, then y, then z.
  constexpr std::size_t around[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
  const auto corners = corners_of(box, pose);
  SceneFace face;
  face.colour = finger_colour;
  for (std::size_t i = 0; i < 6; ++i) {
    face.count = 0;
    face.normal = pose.linear().col(static_cast<Eigen::Index>(i / 2)) * (i % 2 == 0 ? -1.0 : 1.0);
    for (const std::size_t corner : around[i]) face.add(corners[corner]);
    visit(face);
  }
}

}  // namespace flexrf
