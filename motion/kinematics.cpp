#include "motion/kinematics.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace flexrf {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Farther than any arm: keeps squares of target coordinates from overflowing.
constexpr double largest_coordinate = 1e3;  // m
// Below this singular value damping sets in.
constexpr double singular_threshold = 0.05;
constexpr double largest_singular_damping = 0.04;
// One step follows the linearised arm only so far.
constexpr double longest_position_step = 0.25;    // m
constexpr double longest_orientation_step = 0.6;  // rad
constexpr double longest_joint_step = 0.5;        // rad or m
constexpr double all_but_reached = 0.01;          // m
// Beyond this the damping leaves no motion worth the name: a local minimum.
constexpr double hopeless_damping = 1e6;

struct ChainFrames {
  std::array<Eigen::Vector3d, max_joints> position;  // of each joint
  std::array<Eigen::Vector3d, max_joints> axis;      // of each joint
  Eigen::Isometry3d tool;
};

Eigen::Isometry3d to_isometry(const ChainTransform& transform) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::Map<const Eigen::Matrix3d>(transform.rotation.data());
  result.translation() = Eigen::Map<const Eigen::Vector3d>(transform.position.data());
  return result;
}

ChainFrames frames_of(const KinematicChain& chain, const JointVector& joints) {
  ChainFrames frames;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const ChainJoint& joint = chain.joints[i];
    const Eigen::Vector3d axis = Eigen::Map<const Eigen::Vector3d>(joint.axis.data());
    frame = frame * to_isometry(joint.origin);
    frames.position[i] = frame.translation();
    frames.axis[i] = frame.linear() * axis;
    const double position = joints[static_cast<Eigen::Index>(i)];
    if (joint.kind == JointKind::prismatic)
      frame.translation() += frames.axis[i] * position;
    else
      frame.linear() = frame.linear() * Eigen::AngleAxisd(position, axis).toRotationMatrix();
  }
  frames.tool = frame * to_isometry(chain.tool);
  return frames;
}

JacobianMatrix jacobian_of(const KinematicChain& chain, const ChainFrames& frames) {
  JacobianMatrix jacobian = JacobianMatrix::Zero();
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (chain.joints[i].kind == JointKind::prismatic) {
      jacobian.block<3, 1>(0, column) = frames.axis[i];
      continue;
    }
    const Eigen::Vector3d lever = frames.tool.translation() - frames.position[i];
    jacobian.block<3, 1>(0, column) = frames.axis[i].cross(lever);
    jacobian.block<3, 1>(3, column) = frames.axis[i];
  }
  return jacobian;
}

// From the tool to the target: translation in m, rotation vector in rad, both in the base frame.
Vector6 error_of(const Eigen::Isometry3d& target, const Eigen::Isometry3d& tool) {
  const Eigen::AngleAxisd rotation(target.linear() * tool.linear().transpose());
  Vector6 error;
  error.head<3>() = target.translation() - tool.translation();
  error.tail<3>() = rotation.angle() * rotation.axis();
  return error;
}

// What one step is asked for: the error, shortened to where the linearised arm can be believed.
Vector6 shortened(const Vector6& error) {
  Vector6 result = error;
  const double position = error.head<3>().norm();
  const double orientation = error.tail<3>().norm();
  if (position > longest_position_step) result.head<3>() *= longest_position_step / position;
  if (orientation > longest_orientation_step) result.tail<3>() *= longest_orientation_step / orientation;
  return result;
}

// (J J^T + damping) is inverted by its eigenvectors, since their eigenvalues, the squared singular values,
// are needed for the damping anyway.
struct DampedStep {
  JointVector step;
  double singular_value;
};

DampedStep damped_step(const JacobianMatrix& jacobian, const Vector6& error, double damping) {
  const Matrix6 squared = jacobian * jacobian.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(squared);
  const double smallest = std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
  double squared_damping = damping * damping;
  if (smallest < singular_threshold) {
    const double nearness = smallest / singular_threshold;
    squared_damping += (1 - nearness * nearness) * largest_singular_damping * largest_singular_damping *
                       std::min(1.0, error.squaredNorm());
  }
  // An eigenvalue below this is rounding, whatever the damping.
  constexpr double rounding = 1e-12;
  Vector6 in_eigenvectors = solver.eigenvectors().transpose() * error;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double value = std::max(0.0, solver.eigenvalues()[i]) + squared_damping;
    in_eigenvectors[i] = value > rounding ? in_eigenvectors[i] / value : 0.0;
  }
  JointVector step = jacobian.transpose() * (solver.eigenvectors() * in_eigenvectors);
  const double longest = step.cwiseAbs().maxCoeff();
  if (longest > longest_joint_step) step *= longest_joint_step / longest;
  return {step, smallest};
}

struct LimitedStep {
  JointVector joints;
  double singular_value;
  bool limited;
};

// A joint that the step would take out of its range goes to the limit; the others are asked for the rest.
LimitedStep limited_step(const KinematicChain& chain, const JointVector& joints, JacobianMatrix jacobian,
                         Vector6 error, double damping) {
  LimitedStep result{joints, 0, false};
  std::array<bool, max_joints> fixed{};
  for (std::size_t round = 0; round <= chain.joint_count; ++round) {
    const DampedStep damped = damped_step(jacobian, error, damping);
    if (round == 0) result.singular_value = damped.singular_value;
    bool crossed = false;
    for (std::size_t i = 0; i < chain.joint_count; ++i) {
      if (fixed[i]) continue;
      const auto index = static_cast<Eigen::Index>(i);
      const double proposed = joints[index] + damped.step[index];
      const double allowed = std::clamp(proposed, chain.joints[i].lower, chain.joints[i].upper);
      result.joints[index] = allowed;
      if (allowed == proposed) continue;
      error -= jacobian.col(index) * (allowed - joints[index]);
      jacobian.col(index).setZero();
      fixed[i] = true;
      crossed = true;
    }
    if (!crossed) break;
    result.limited = true;
  }
  return result;
}

bool usable(const Eigen::Isometry3d& target) {
  const Eigen::Matrix3d& rotation = target.linear();
  return target.matrix().allFinite() && target.translation().cwiseAbs().maxCoeff() <= largest_coordinate &&
         (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
         rotation.determinant() > 0;
}

bool finite_joints(const KinematicChain& chain, const JointVector& joints) {
  return joints.head(static_cast<Eigen::Index>(chain.joint_count)).allFinite();
}

// A few hundredths of a radian (or a metre) in fixed directions of either sign: out of a posture in which the
// gradient happens to vanish (a straight wrist, a stretched elbow), and the same in every run.
JointVector nudged(const KinematicChain& chain, const JointVector& joints, int attempt) {
  JointVector result = joints;
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const double sign = (i + static_cast<std::size_t>(attempt)) % 2 == 0 ? 1.0 : -1.0;
    result[static_cast<Eigen::Index>(i)] += sign * (0.02 + 0.01 * static_cast<double>(i));
  }
  return within_limits(chain, result);
}

struct Descent {
  JointVector joints;
  Vector6 error;
  double singular_value = 0;
  bool limited = false;
  bool stalled = false;  // nothing comes closer; else out of iterations
};

bool close_enough(const Vector6& error, const InverseOptions& options) {
  return error.head<3>().norm() <= options.position_tolerance &&
         error.tail<3>().norm() <= options.orientation_tolerance;
}

Descent descend(const KinematicChain& chain, const Eigen::Isometry3d& target, const JointVector& start,
                const InverseOptions& options, int& iterations) {
  Descent now{.joints = start, .error = {}};
  ChainFrames frames = frames_of(chain, now.joints);
  now.error = error_of(target, frames.tool);
  double damping = 0;
  double progress_mark = now.error.squaredNorm();
  int since_mark = 0;
  while (!close_enough(now.error, options) && iterations < options.iterations) {
    ++iterations;
    const LimitedStep next =
        limited_step(chain, now.joints, jacobian_of(chain, frames), shortened(now.error), damping);
    now.singular_value = next.singular_value;
    now.limited = next.limited;
    const ChainFrames next_frames = frames_of(chain, next.joints);
    const Vector6 next_error = error_of(target, next_frames.tool);
    if (next_error.squaredNorm() < now.error.squaredNorm()) {
      now.joints = next.joints;
      now.error = next_error;
      frames = next_frames;
      damping = damping < 1e-3 ? 0 : damping / 4;
    } else {
      damping = std::max(1e-3, damping * 4);
      if (damping > hopeless_damping) {
        now.stalled = true;
        break;
      }
    }
    if (++since_mark == 8) {  // slower than a thousandth in eight steps is a minimum for our purposes
      if (now.error.squaredNorm() > 0.999 * progress_mark) {
        now.stalled = true;
        break;
      }
      progress_mark = now.error.squaredNorm();
      since_mark = 0;
    }
  }
  return now;
}

}  // namespace

Eigen::Isometry3d forward_kinematics(const KinematicChain& chain, const JointVector& joints) {
  return frames_of(chain, joints).tool;
}

JacobianMatrix geometric_jacobian(const KinematicChain& chain, const JointVector& joints) {
  return jacobian_of(chain, frames_of(chain, joints));
}

double smallest_singular_value(const JacobianMatrix& jacobian) {
  const Matrix6 squared = jacobian * jacobian.transpose();
  if (!squared.allFinite()) return 0;
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(squared, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
}

JointVector within_limits(const KinematicChain& chain, const JointVector& joints) {
  JointVector result = JointVector::Zero();
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const ChainJoint& joint = chain.joints[i];
    result[index] =
        std::isfinite(joints[index]) ? std::clamp(joints[index], joint.lower, joint.upper) : joint.home;
  }
  return result;
}

Restraint restraint_of(const KinematicChain& chain, std::span<const double> joints) {
  // Each joint's own words, as a restraint keeps none.
  static constexpr const char* reasons[max_joints] = {
      "joint 1 is kept to its limit", "joint 2 is kept to its limit", "joint 3 is kept to its limit",
      "joint 4 is kept to its limit", "joint 5 is kept to its limit", "joint 6 is kept to its limit",
      "joint 7 is kept to its limit", "joint 8 is kept to its limit"};
  // What is computed to be on the limit is not beyond it.
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < chain.joint_count && i < joints.size(); ++i) {
    const double kept = std::clamp(joints[i], chain.joints[i].lower, chain.joints[i].upper);
    if (std::abs(joints[i] - kept) > rounding) return {reasons[i], joints[i], kept};
  }
  return {};
}

JointVector home_position(const KinematicChain& chain) {
  JointVector result = JointVector::Zero();
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    result[static_cast<Eigen::Index>(i)] = chain.joints[i].home;
  }
  return result;
}

InverseResult inverse_kinematics(const KinematicChain& chain, const Eigen::Isometry3d& target,
                                 const JointVector& seed, const InverseOptions& options) {
  InverseResult result;
  const JointVector start = within_limits(chain, seed);
  if (!usable(target) || !finite_joints(chain, seed)) {
    result.joints = start;
    result.singular_value = smallest_singular_value(geometric_jacobian(chain, start));
    return result;
  }

  Descent best = descend(chain, target, start, options, result.iterations);
  // Stuck where the gradient vanishes: look beside it, in both directions, before calling it out of reach.
  for (int attempt = 0; attempt < 2 && best.stalled && !close_enough(best.error, options); ++attempt) {
    const Descent other =
        descend(chain, target, nudged(chain, best.joints, attempt), options, result.iterations);
    if (other.error.squaredNorm() < best.error.squaredNorm()) best = other;
  }

  result.joints = best.joints;
  result.position_error = best.error.head<3>().norm();
  result.orientation_error = best.error.tail<3>().norm();
  result.singular_value = smallest_singular_value(geometric_jacobian(chain, best.joints));
  if (close_enough(best.error, options)) {
    result.outcome = InverseOutcome::converged;
  } else if (best.limited) {
    result.outcome = InverseOutcome::at_limit;
  } else {
    // Creeping towards a target that is all but reached is the singularity's doing; farther off, the creeping
    // is along the border of what the arm can reach.
    const bool creeping = !best.stalled && result.singular_value < singular_threshold &&
                          result.position_error < all_but_reached;
    result.outcome = creeping ? InverseOutcome::singular : InverseOutcome::unreachable;
  }
  return result;
}

const char* to_text(InverseOutcome outcome) {
  switch (outcome) {
    case InverseOutcome::converged:
      return "converged";
    case InverseOutcome::unreachable:
      return "out of reach";
    case InverseOutcome::singular:
      return "in a singular posture";
    case InverseOutcome::at_limit:
      return "a joint is at its limit";
    case InverseOutcome::invalid:
      break;
  }
  return "not a pose";
}

}  // namespace flexrf
