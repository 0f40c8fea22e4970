#include "hal/scene/interface/scene_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "hal/scene/interface/joint_samples.hpp"
#include "hal/scene/interface/scene_arm.hpp"
#include "motion/kinematics.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

bool is_near(double one, double other, double within = 1e-12) {
  return std::abs(one - other) <= within;
}

bool sines_are_those_of_the_library() {
  for (int i = -4000; i <= 4000; ++i) {
    const double angle = i * 0.01137;
    const SineCosine found = sine_cosine(angle);
    if (!is_near(found.sine, std::sin(angle), 4e-15) || !is_near(found.cosine, std::cos(angle), 4e-15))
      return false;
    const double x = std::cos(angle) * 0.3;
    const double y = std::sin(angle) * 0.3;
    if (!is_near(arc_tangent(y, x), std::atan2(y, x), 4e-15)) return false;
  }
  return arc_tangent(0, 0) == 0 && is_near(arc_tangent(0, -1), std::acos(-1.0)) &&
         is_near(arc_tangent(-1, 0), -std::acos(-1.0) / 2);
}

double area_of(const Outline& outline) {
  double area = 0;
  for (std::size_t i = 0; i < outline.count; ++i)
    area += cross(outline.corners[i], outline.corners[(i + 1) % outline.count]) / 2;
  return area;
}

PlaneVector centroid_of(const Outline& outline) {
  PlaneVector sum;
  for (std::size_t i = 0; i < outline.count; ++i) {
    const PlaneVector one = outline.corners[i];
    const PlaneVector next = outline.corners[(i + 1) % outline.count];
    sum = sum + (one + next) * (cross(one, next) / 6);
  }
  return sum * (1 / area_of(outline));
}

// As the drawings say; counter-clockwise, as its area is above 0.
bool the_catalogue_is_as_drawn() {
  const double areas[] = {0.050 * 0.030, 0, 0.866025403784 * 0.036 * 0.036, 0.050 * 0.018 + 0.022 * 0.018};
  for (std::size_t i = 0; i < part_kinds; ++i) {
    const PartModel& model = part_catalogue[i];
    const PlaneVector middle = centroid_of(model.outline);
    if (!is_near(middle.x, 0) || !is_near(middle.y, 0)) return false;
    if (areas[i] > 0 && !is_near(area_of(model.outline), areas[i], 1e-12)) return false;
    double low = 1;
    double high = -1;
    double left = 1;
    double right = -1;
    for (const PlaneVector corner : model.outline.all()) {
      low = std::min(low, corner.y);
      high = std::max(high, corner.y);
      left = std::min(left, corner.x);
      right = std::max(right, corner.x);
    }
    if (!is_near(right - left, model.length) || !is_near(high - low, model.width)) return false;
    if (part_model(model.kind) != &model || part_bins[i].kind != model.kind) return false;
  }
  return part_catalogue[1].outline.count == 24 && part_model(SceneKind::box) == nullptr;
}

bool pieces_are_convex_and_make_the_whole() {
  for (const PartModel& model : part_catalogue) {
    const SceneBody body = part_at(model.kind, {0.4, 0.1}, 0.3);
    double sum = 0;
    const OutlinePieces pieces = pieces_of(body);
    for (const Outline& piece : pieces.all()) {
      sum += area_of(piece);
      for (std::size_t i = 0; i < piece.count; ++i) {
        const PlaneVector one = piece.corners[i];
        const PlaneVector two = piece.corners[(i + 1) % piece.count];
        const PlaneVector three = piece.corners[(i + 2) % piece.count];
        if (cross(two - one, three - two) <= 0) return false;
      }
    }
    if (!is_near(sum, area_of(model.outline))) return false;
  }
  return pieces_of(part_at(SceneKind::bracket, {}, 0)).count == 2 && pieces_of(SceneBody{}).count == 0;
}

bool a_pose_is_found_again() {
  SceneBody body = part_at(SceneKind::block, {0.4, -0.1}, 2.5);
  body.tilt = {0.2, -0.7};
  const Eigen::Isometry3d pose = pose_of(body);
  SceneBody found = part_at(SceneKind::block, {}, 0);
  set_pose(found, pose);
  if (!is_near(found.angle, 2.5) || !is_near(found.tilt[0], 0.2) || !is_near(found.tilt[1], -0.7))
    return false;
  if (!pose_of(found).isApprox(pose, 1e-12)) return false;
  // One that is upright has no tilt at all.
  set_pose(found, pose_of(part_at(SceneKind::block, {0.4, -0.1}, -1.0)));
  return found.tilt[0] == 0 && found.tilt[1] == 0 && is_near(found.angle, -1.0);
}

bool a_held_part_is_carried() {
  SceneState state{};
  state.parts[3] = part_at(SceneKind::disc, {0.4, 0}, 0);
  state.held = 4;
  state.grip_position = {0.01, 0, 0.15};
  state.grip_orientation = {1, 0, 0, 0};  // the hand points downwards, so the part stands upright
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
  tool.linear() = turn_about(Eigen::Vector3d::UnitX(), std::acos(-1.0));
  tool.translation() = Eigen::Vector3d(0.5, 0.2, 0.4);
  carry_held_part(state, tool);
  const SceneBody& part = state.parts[3];
  return is_near(part.position[0], 0.51) && is_near(part.position[1], 0.2) &&
         is_near(part.position[2], 0.25) && is_near(part.tilt[0], 0, 1e-9);
}

bool the_arm_is_where_its_chain_says() {
  const SceneArm arm = to_scene_arm(six_axis);
  JointVector joints = home_position(six_axis);
  for (int step = 0; step < 20; ++step) {
    for (Eigen::Index i = 0; i < 6; ++i) joints[i] += 0.03 * static_cast<double>(i + 1) - 0.1;
    const ArmFrames frames = frames_of(arm, {joints.data(), max_joints});
    if (!frames.tool.isApprox(forward_kinematics(six_axis, joints), 1e-12)) return false;
  }
  return arm.joints == 6 && !arm.slides[0];
}

// A cubic is found again, whatever the time; beyond the last sample it goes on as it went.
bool joints_move_smoothly_between_samples() {
  const auto position = [](double time) {
    return 0.3 + 0.5 * time - 2 * time * time + 7 * time * time * time;
  };
  const auto velocity = [](double time) { return 0.5 - 4 * time + 21 * time * time; };
  const auto sample = [&](double time) {
    JointSample told;
    told.time = Time{duration_of(5 + time)};
    told.position[2] = position(time);
    told.velocity[2] = velocity(time);
    return told;
  };
  for (const double time : {0.01, 0.012, 0.016, 0.017}) {
    const auto found = joints_between(sample(0.01), sample(0.017), Time{duration_of(5 + time)});
    if (!is_near(found[2], position(time), 1e-9) || found[1] != 0) return false;
  }
  const auto beyond = joints_after(sample(0.01), Time{duration_of(5.013)});
  return is_near(beyond[2], position(0.01) + 0.003 * velocity(0.01), 1e-9);
}

bool the_hand_leaves_its_opening_free() {
  const HandModel hand;
  const auto boxes = hand_boxes(hand, 0.04);
  return boxes[0].from.y() == 0.02 && boxes[1].to.y() == -0.02 && boxes[0].to.z() == hand.reach &&
         boxes[2].to.z() == boxes[0].from.z();
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<sines_are_those_of_the_library>),
      cmocka_unit_test(judged<the_catalogue_is_as_drawn>),
      cmocka_unit_test(judged<pieces_are_convex_and_make_the_whole>),
      cmocka_unit_test(judged<a_pose_is_found_again>),
      cmocka_unit_test(judged<a_held_part_is_carried>),
      cmocka_unit_test(judged<the_arm_is_where_its_chain_says>),
      cmocka_unit_test(judged<joints_move_smoothly_between_samples>),
      cmocka_unit_test(judged<the_hand_leaves_its_opening_free>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
