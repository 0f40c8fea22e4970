#include "motion/joint_tracking.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace flexrf {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Closer is there: rounding of poses a metre away is a hundred times less.
constexpr double reached = 1e-11;  // m or rad
// Steps are small, and each squares the error.
constexpr int most_steps = 8;
// In the least squares: below what counts, above rounding, so that a lost direction gives no infinite step.
constexpr double damping_squared = 1e-10;
// Farther than a tool moves in a cycle: no step of Newton's leads anywhere.
constexpr double longest_step = 1.0;  // rad or m

// Each joint's own words, as a restraint keeps none.
constexpr const char* at_its_limit[max_joints] = {
    "joint 1 would leave its range", "joint 2 would leave its range", "joint 3 would leave its range",
    "joint 4 would leave its range", "joint 5 would leave its range", "joint 6 would leave its range",
    "joint 7 would leave its range", "joint 8 would leave its range"};
constexpr const char* too_fast[max_joints] = {"joint 1 would be too fast", "joint 2 would be too fast",
                                              "joint 3 would be too fast", "joint 4 would be too fast",
                                              "joint 5 would be too fast", "joint 6 would be too fast",
                                              "joint 7 would be too fast", "joint 8 would be too fast"};
constexpr const char* not_there = "it is out of reach, or the arm is singular there";

Vector6 way_to(const Eigen::Isometry3d& target, const Eigen::Isometry3d& tool) {
  const Eigen::AngleAxisd rotation(target.linear() * tool.linear().transpose());
  Vector6 error;
  error.head<3>() = target.translation() - tool.translation();
  error.tail<3>() = rotation.angle() * rotation.axis();
  return error;
}

}  // namespace

Restraint track(const KinematicChain& chain, const Eigen::Isometry3d& pose, double time, double part,
                JointVector& joints) {
  JointVector next = joints;
  bool there = false;
  for (int step = 0; step <= most_steps; ++step) {
    const Vector6 error = way_to(pose, forward_kinematics(chain, next));
    there = error.cwiseAbs().maxCoeff() < reached;
    if (there || step == most_steps) break;
    const JacobianMatrix jacobian = geometric_jacobian(chain, next);
    Matrix6 squared = jacobian * jacobian.transpose();
    squared.diagonal().array() += damping_squared;
    const Vector6 solved = squared.ldlt().solve(error);
    const JointVector change = jacobian.transpose() * solved;
    if (!(change.cwiseAbs().maxCoeff() < longest_step)) break;
    next += change;
  }
  if (!there) return {.reason = not_there};
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const ChainJoint& joint = chain.joints[i];
    if (next[index] < joint.lower) return {at_its_limit[i], next[index], joint.lower};
    if (next[index] > joint.upper) return {at_its_limit[i], next[index], joint.upper};
    const double distance = std::abs(next[index] - joints[index]);
    const double most = part * joint.velocity * time;
    if (distance > most) return {too_fast[i], distance / time, part * joint.velocity};
  }
  joints = next;
  return {};
}

}  // namespace flexrf
