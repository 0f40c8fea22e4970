#include "hal/scene/interface/scene_arm.hpp"

#include <algorithm>

#include "hal/scene/interface/scene_math.hpp"

namespace flexrf {

SceneArm to_scene_arm(const KinematicChain& chain) noexcept {
  SceneArm arm{};
  arm.joints = static_cast<std::uint32_t>(chain.joint_count);
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const ChainJoint& joint = chain.joints[i];
    std::copy(joint.origin.position.begin(), joint.origin.position.end(), arm.origin.begin() + 3 * i);
    std::copy(joint.origin.rotation.begin(), joint.origin.rotation.end(), arm.rotation.begin() + 9 * i);
    std::copy(joint.axis.begin(), joint.axis.end(), arm.axis.begin() + 3 * i);
    arm.slides[i] = joint.kind == JointKind::prismatic;
  }
  arm.tool_origin = chain.tool.position;
  arm.tool_rotation = chain.tool.rotation;
  return arm;
}

namespace {

Eigen::Isometry3d frame_at(const double* origin, const double* rotation) noexcept {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translation() = Eigen::Map<const Eigen::Vector3d>(origin);
  frame.linear() = Eigen::Map<const Eigen::Matrix3d>(rotation);
  return frame;
}

}  // namespace

ArmFrames frames_of(const SceneArm& arm, std::span<const double> positions) noexcept {
  ArmFrames frames;
  frames.links.fill(Eigen::Isometry3d::Identity());
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const std::size_t joints = std::min<std::size_t>(arm.joints, max_joints);
  for (std::size_t i = 0; i < joints; ++i) {
    frame = frame * frame_at(&arm.origin[3 * i], &arm.rotation[9 * i]);
    const Eigen::Vector3d axis = Eigen::Map<const Eigen::Vector3d>(&arm.axis[3 * i]);
    const double position = i < positions.size() ? positions[i] : 0;
    if (arm.slides[i]) {
      frame.translation() += frame.linear() * (axis * position);
    } else {
      frame.linear() = Eigen::Matrix3d(frame.linear()) * turn_about(axis, position);
    }
    frames.links[i + 1] = frame;
  }
  frames.tool = frame * frame_at(arm.tool_origin.data(), arm.tool_rotation.data());
  return frames;
}

}  // namespace flexrf
