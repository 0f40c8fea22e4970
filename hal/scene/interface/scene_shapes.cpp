#include "hal/scene/interface/scene_shapes.hpp"

#include "motion/pose_conversion.hpp"

namespace flexrf {

Outline outline_of(const SceneBody& body) noexcept {
  if (const PartModel* const model = part_model(body.kind)) return model->outline;
  if (body.kind == SceneKind::box) return rectangle(body.size[0], body.size[1]);
  if (body.kind == SceneKind::post) return circle(body.size[0] / 2);
  return {};
}

OutlinePieces pieces_of(const SceneBody& body) noexcept {
  const Outline outline = outline_of(body);
  OutlinePieces pieces;
  if (outline.count == 0) return pieces;
  if (body.kind != SceneKind::bracket) {
    pieces.pieces[pieces.count++] = outline;
    return pieces;
  }
  // An L is cut where its inner corner meets the outer side.
  const auto& corner = outline.corners;
  Outline& foot = pieces.pieces[pieces.count++];
  const PlaneVector cut{corner[0].x, corner[3].y};
  for (const PlaneVector one : {corner[0], corner[1], corner[2], cut}) foot.add(one);
  Outline& leg = pieces.pieces[pieces.count++];
  for (const PlaneVector one : {cut, corner[3], corner[4], corner[5]}) leg.add(one);
  return pieces;
}

Outline placed(const Outline& outline, PlaneVector position, double angle) noexcept {
  const SineCosine turn = sine_cosine(angle);
  Outline result;
  for (const PlaneVector corner : outline.all()) result.add(position + turned(corner, turn));
  return result;
}

BodyColour colour_of(SceneKind kind) noexcept {
  const PartModel* const model = part_model(kind);
  return model != nullptr ? model->colour : obstacle_colour;
}

SceneBody part_at(SceneKind kind, PlaneVector position, double angle) noexcept {
  SceneBody body{};
  body.kind = kind;
  body.position = {position.x, position.y, 0};
  body.angle = angle;
  if (const PartModel* const model = part_model(kind))
    body.size = {model->length, model->width, model->height};
  return body;
}

Eigen::Isometry3d pose_of(const SceneBody& body) noexcept {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = body.position_map();
  pose.linear() = turn_about(Eigen::Vector3d::UnitZ(), body.angle);
  const double tilt = length({body.tilt[0], body.tilt[1]});
  if (tilt > 0)
    pose.linear() =
        turn_about({body.tilt[0] / tilt, body.tilt[1] / tilt, 0}, tilt) * Eigen::Matrix3d(pose.linear());
  return pose;
}

void set_pose(SceneBody& body, const Eigen::Isometry3d& pose) noexcept {
  // Less than this is what computing leaves, and no tilt.
  constexpr double level = 1e-9;
  body.position_map() = pose.translation();
  const Eigen::Matrix3d turn = pose.linear();
  const Eigen::Vector3d up = turn.col(2);
  const double sine = length({up.x(), up.y()});
  body.tilt = {};
  Eigen::Matrix3d upright = turn;
  if (sine > level) {
    const double tilt = arc_tangent(sine, up.z());
    const Eigen::Vector3d axis(-up.y() / sine, up.x() / sine, 0);
    body.tilt = {axis.x() * tilt, axis.y() * tilt};
    upright = turn_about(axis, -tilt) * turn;
  } else if (up.z() < 0) {
    body.tilt = {3.14159265358979323846, 0};
    upright = turn_about(Eigen::Vector3d::UnitX(), -body.tilt[0]) * turn;
  }
  body.angle = arc_tangent(upright(1, 0), upright(0, 0));
}

void carry_held_part(SceneState& state, const Eigen::Isometry3d& tool) noexcept {
  if (state.held == 0) return;
  Pose grip{};
  grip.position = state.grip_position;
  grip.orientation = state.grip_orientation;
  set_pose(state.parts[state.held - 1], tool * to_isometry(grip));
}

std::array<HandBox, 3> hand_boxes(const HandModel& hand, double opening) noexcept {
  const double x = hand.finger_width / 2;
  const double inner = opening / 2;
  const double outer = inner + hand.finger_thickness;
  const double root = hand.reach - hand.finger_length;
  return {HandBox{{-x, inner, root}, {x, outer, hand.reach}},
          HandBox{{-x, -outer, root}, {x, -inner, hand.reach}},
          HandBox{{-hand.palm_width / 2, -hand.palm_length / 2, root - hand.palm_depth},
                  {hand.palm_width / 2, hand.palm_length / 2, root}}};
}

std::array<Eigen::Vector3d, 8> corners_of(const HandBox& box, const Eigen::Isometry3d& pose) noexcept {
  std::array<Eigen::Vector3d, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d corner((i & 1) != 0 ? box.to.x() : box.from.x(),
                                 (i & 2) != 0 ? box.to.y() : box.from.y(),
                                 (i & 4) != 0 ? box.to.z() : box.from.z());
    corners[i] = pose * corner;
  }
  return corners;
}

}  // namespace flexrf
