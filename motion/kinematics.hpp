#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "motion/kinematic_chain.hpp"
#include "runtime/unit/restraint.hpp"

namespace flexrf {

// Positions of all joints, in rad, or m where a joint slides (or their rates); entries from the chain's
// joint_count on are zero.
using JointVector = Eigen::Matrix<double, static_cast<int>(max_joints), 1>;

// Rows: linear velocity of the tool in m/s, then angular velocity in rad/s, both in the base frame and per
// rad/s of a joint that turns, per m/s of one that slides. Columns from joint_count on are zero.
using JacobianMatrix = Eigen::Matrix<double, 6, static_cast<int>(max_joints)>;

// The tool's pose in the base frame. Not finite only when `joints` is not.
Eigen::Isometry3d forward_kinematics(const KinematicChain& chain, const JointVector& joints);

JacobianMatrix geometric_jacobian(const KinematicChain& chain, const JointVector& joints);

// Of the Jacobian: 0 where the tool has lost a direction of motion. Metres and radians are weighed alike.
double smallest_singular_value(const JacobianMatrix& jacobian);

// `joints` with each within its limits; what is not finite becomes the joint's home.
JointVector within_limits(const KinematicChain& chain, const JointVector& joints);

// The first of finite `joints` that its limits do not let go there; none: all may.
Restraint restraint_of(const KinematicChain& chain, std::span<const double> joints);

JointVector home_position(const KinematicChain& chain);

enum class InverseOutcome {
  converged,    // `joints` reach the target within the tolerances
  unreachable,  // no posture near the seed comes closer: the target is out of reach
  singular,     // gave up in a singular posture: the motion needed is one the arm has lost there
  at_limit,     // a joint at its limit is in the way
  invalid,      // target or seed is not finite or not a rotation
};

struct InverseOptions {
  double position_tolerance = 1e-6;     // m
  double orientation_tolerance = 1e-6;  // rad
  int iterations = 60;                  // bounds the time: each takes a few microseconds
};

// `joints` are always finite and within their limits: the best posture found, or the seed.
struct InverseResult {
  InverseOutcome outcome = InverseOutcome::invalid;
  JointVector joints = JointVector::Zero();
  double position_error = 0;     // m
  double orientation_error = 0;  // rad
  double singular_value = 0;     // the smallest one at `joints`
  int iterations = 0;
};

// The posture nearest to `seed` (in the sense of descent from it, so that a small motion of the target never
// flips an elbow) in which the tool is at `target`.
//
// Damped least squares: Levenberg-Marquardt, with the damping raised where the smallest singular value
// becomes small (Nakamura and Hanafusa 1986; Chiaverini 1997). A joint that would leave its range is set on
// the limit and taken out of the step. Real-time safe: no allocation, no lock, bounded iterations.
InverseResult inverse_kinematics(const KinematicChain& chain, const Eigen::Isometry3d& target,
                                 const JointVector& seed, const InverseOptions& options = {});

// For messages: "converged", "out of reach", ...
const char* to_text(InverseOutcome outcome);

}  // namespace flexrf
