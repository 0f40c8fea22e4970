// For tests of streams: what the tool and the joints did, differentiated from where they were.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "motion/kinematics.hpp"
#include "motion/pose_motion.hpp"

namespace flexrf {

/// Differences of one vector's positions, cycle by cycle: means over a cycle of velocity, over two of
/// acceleration, over three of jerk, so that none is greater than the greatest value.
class Differences {
 public:
  void add(const Eigen::Vector3d& way, double time) {
    const Eigen::Vector3d velocity = way / time;
    const Eigen::Vector3d acceleration = (velocity - velocity_) / time;
    const Eigen::Vector3d jerk = (acceleration - acceleration_) / time;
    note(largest.velocity, velocity);
    note(largest.acceleration, acceleration);
    note(largest.jerk, jerk);
    velocity_ = velocity;
    acceleration_ = acceleration;
  }
  bool keep(const MotionLimits& limits) const {
    return largest.velocity <= limits.velocity * hair && largest.acceleration <= limits.acceleration * hair &&
           largest.jerk <= limits.jerk * hair;
  }

  MotionLimits largest{};  // magnitudes; from rest

 private:
  static constexpr double hair =
      1 + 1e-5;  // of positions that are exact to 1e-16 m, three times divided by 7 ms
  static void note(double& largest_so_far, const Eigen::Vector3d& value) {
    const double size = value.norm();
    largest_so_far =
        std::isnan(size) ? std::numeric_limits<double>::infinity() : std::max(largest_so_far, size);
  }
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
};

/// A stream from rest on: after each advance() of `time` s, look().
template <class Stream>
class StreamCheck {
 public:
  StreamCheck(const KinematicChain& chain, const Stream& stream)
      : chain_(chain), stream_(stream), pose_(stream.motion().pose()), joints_(stream.set_point()) {}

  void look(double time) {
    const Eigen::Isometry3d now = stream_.motion().pose();
    linear.add(now.translation() - pose_.translation(), time);
    angular.add(rotation_vector(Eigen::Quaterniond(now.linear() * pose_.linear().transpose())), time);
    const JointVector joints = stream_.set_point();
    for (std::size_t i = 0; i < chain_.joint_count; ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      const ChainJoint& joint = chain_.joints[i];
      joint_use = std::max(joint_use, std::abs(joints[index] - joints_[index]) / (joint.velocity * time));
      out_of_range = std::max({out_of_range, joints[index] - joint.upper, joint.lower - joints[index]});
    }
    if (!joints.allFinite()) joint_use = std::numeric_limits<double>::infinity();
    off_the_tool =
        std::max(off_the_tool, (forward_kinematics(chain_, joints).matrix() - now.matrix()).norm());
    pose_ = now;
    joints_ = joints;
  }

  bool holds(const StreamLimits& limits) const {
    const bool good = linear.keep(limits.linear) && angular.keep(limits.angular) && joint_use <= 1 + 1e-9 &&
                      out_of_range <= 0 && off_the_tool < 1e-9;
    return good && stream_.emergencies() == 0;
  }

  Differences linear;
  Differences angular;
  double joint_use = 0;     // of a joint's velocity; above 1 is a violation
  double out_of_range = 0;  // rad or m
  double off_the_tool = 0;  // between the tool and where the joints put it

 private:
  const KinematicChain& chain_;
  const Stream& stream_;
  Eigen::Isometry3d pose_;
  JointVector joints_;
};

}  // namespace flexrf
