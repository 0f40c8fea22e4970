// The controller as another process: mxt_simulator, for the arm of these tests.
#pragma once

#include <string>
#include <vector>

#include "hal/robot_arm/paced/joint_follower.hpp"
#include "six_axis.hpp"

namespace flexrf {

/// Where its joints are before anything moves.
inline JointAngles melfa_home() {
  JointAngles joints{};
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) joints[i] = six_axis.joints[i].home;
  return joints;
}

/// As fast as the arm's joints, and no faster: a longer step is an alarm. `port` 0: a free one, which it
/// says.
inline std::vector<std::string> arguments_of_controller(std::uint16_t port, const JointAngles& start) {
  std::string starts;
  std::string speeds;
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
    starts += (i == 0 ? "" : ",") + std::to_string(start[i]);
    speeds += (i == 0 ? "" : ",") + std::to_string(six_axis.joints[i].velocity);
  }
  return {"--port", std::to_string(port), "--start", starts, "--speed", speeds};
}

}  // namespace flexrf
