#include "tests/visual_servoing/way_judge.hpp"

#include <algorithm>

#include "motion/pose_conversion.hpp"
#include "tests/distance_to_line.hpp"
#include "types/pose.hpp"
#include "types/servo_target.hpp"

namespace flexrf::visual_servoing {
namespace {

// A goal that moves less is the same, as seen by then.
constexpr double same_goal = 0.004;  // m

}  // namespace

void WayJudge::look() {
  const Eigen::Vector3d reach(0, 0, cell_.configuration_of<PartPickerConfiguration>("picker").hand_reach);
  const Eigen::Vector3d tip = to_isometry(cell_.newest<Pose>("tool_pose")) * reach;
  const double elapsed = cell_.elapsed();
  const double speed = elapsed > looked_ ? (tip - tip_).norm() / (elapsed - looked_) : 0;
  tip_ = tip;
  looked_ = elapsed;
  const auto servo = cell_.newest<ServoTarget>("servo");
  if (!servo.valid) {
    if (is_led_) ways_.push_back(now_);
    is_led_ = false;
    return;
  }
  const Eigen::Vector3d goal = to_isometry(servo.pose) * reach;
  if (!is_led_ || (goal - now_.to).norm() > same_goal) {
    if (is_led_) ways_.push_back(now_);
    now_ = {.began = elapsed, .state = cell_.picker().state, .from = tip, .to = goal, .speed = speed};
    is_led_ = true;
  }
  now_.to = goal;
  now_.farthest = std::max(now_.farthest, distance_to_line(tip, now_.from, goal));
}

}  // namespace flexrf::visual_servoing
