#include "units/arm_motion/key_motion.hpp"

#include "motion/pose_conversion.hpp"

namespace flexrf {
namespace {

struct KeyMotion {
  Key key;
  char character;
  bool turns;
  int axis;  // x, y, z
  double sign;
};

constexpr KeyMotion key_motions[] = {
    {Key::character, 'w', false, 0, 1}, {Key::character, 's', false, 0, -1},
    {Key::character, 'a', false, 1, 1}, {Key::character, 'd', false, 1, -1},
    {Key::character, 'q', false, 2, 1}, {Key::character, 'e', false, 2, -1},
    {Key::character, 'u', true, 0, 1},  {Key::character, 'o', true, 0, -1},
    {Key::up, 0, true, 1, 1},           {Key::down, 0, true, 1, -1},
    {Key::left, 0, true, 2, 1},         {Key::right, 0, true, 2, -1},
};

}  // namespace

bool move_by_key(Pose& pose, const KeyEvent& event, double step, double turn) noexcept {
  for (const KeyMotion& motion : key_motions) {
    if (event.key != motion.key || event.character != static_cast<std::uint32_t>(motion.character)) continue;
    if (motion.turns) {
      Eigen::Isometry3d frame = to_isometry(pose);
      frame.linear() =
          Eigen::AngleAxisd(motion.sign * turn, Eigen::Vector3d::Unit(motion.axis)).toRotationMatrix() *
          frame.linear();
      pose.orientation = to_pose(frame).orientation;
    } else {
      pose.position_map()[motion.axis] += motion.sign * step;
    }
    return true;
  }
  return false;
}

}  // namespace flexrf
