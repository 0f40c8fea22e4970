#include "hal/robot_arm/conformance/robot_arm_conformance.hpp"

#include <cmath>
#include <limits>
#include <string_view>

#include "motion/kinematics.hpp"
#include "tests/conformance.hpp"

namespace flexrf {
namespace {

constexpr Duration cycle = std::chrono::milliseconds(7);
constexpr double cycle_seconds = 0.007;
constexpr double tolerance = 1e-3;  // rad, beside the sensors' noise

MakeRobotArmWorld make_world = nullptr;

JointPositions positions_of(const JointVector& joints) {
  JointPositions positions{};
  positions.position_map() = joints;
  return positions;
}

std::optional<JointVector> sensed(RobotArmWorld& world) {
  const auto state = world.arm().state();
  if (!state) return std::nullopt;
  return JointVector(state->position_map());
}

double distance(RobotArmWorld& world, const JointVector& joints) {
  const auto at = sensed(world);
  return at ? (*at - joints).cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity();
}

// Commands `to` in every cycle of `duration`.
void command_for(RobotArmWorld& world, const JointVector& to, double duration) {
  for (double time = 0; time < duration; time += cycle_seconds) {
    world.receive(cycle);
    world.arm().command(positions_of(to));
    world.send();
  }
  world.receive(cycle);
  world.send();
}

void idle_for(RobotArmWorld& world, double duration) {
  for (double time = 0; time < duration; time += cycle_seconds) {
    world.receive(cycle);
    world.send();
  }
}

// What it said in so long, led to `to` in each cycle.
Restraint said_while(RobotArmWorld& world, const JointVector& to, double duration) {
  Restraint said;
  for (double time = 0; time < duration; time += cycle_seconds) {
    world.receive(cycle);
    world.arm().command(positions_of(to));
    world.send();
    if (const Restraint now = world.arm().take_restraint(); now.reason != nullptr) said = now;
  }
  return said;
}

// A cycle in which the arm is commanded to its actual position, which is returned.
JointVector begin_here(RobotArmWorld& world) {
  world.receive(cycle);
  const JointVector here = sensed(world).value_or(JointVector(JointVector::Zero()));
  lead_from_here(world.arm());
  world.send();
  return here;
}

// A posture beside the present one, inside the limits. The arm is led from where it is.
JointVector beside(RobotArmWorld& world, double offset) {
  JointVector joints = begin_here(world);
  for (std::size_t i = 0; i < world.arm().kinematic_chain().joint_count; ++i) {
    joints[static_cast<Eigen::Index>(i)] += offset;
  }
  return within_limits(world.arm().kinematic_chain(), joints);
}

// [robot-arm-1]
Verdict tells_a_sane_state(RobotArmWorld& world) {
  idle_for(world, 0.05);
  const auto state = world.arm().state();
  if (!state) return Verdict::failed;
  const JointVector at = state->position_map();
  const bool inside =
      (at - within_limits(world.arm().kinematic_chain(), at)).cwiseAbs().maxCoeff() <= world.noise();
  return verdict(at.allFinite() && inside && state->velocity_map().isZero(tolerance));
}

// [robot-arm-13]
Verdict tells_when_it_measured(RobotArmWorld& world) {
  idle_for(world, 0.05);
  Time before = world.arm().measured_at();
  if (before == Time{}) return Verdict::failed;
  for (int look = 0; look < 5; ++look) {
    idle_for(world, 0.05);
    const Time now = world.arm().measured_at();
    if (now <= before) return Verdict::failed;
    before = now;
  }
  if (!world.lose_sensors()) return Verdict::passed;
  idle_for(world, 0.1);
  return verdict(!world.arm().state() && world.arm().measured_at() == Time{});
}

// [robot-arm-10]
Verdict stays_where_it_is_without_a_command(RobotArmWorld& world) {
  idle_for(world, 0.05);
  const auto start = sensed(world);
  idle_for(world, 0.5);
  return verdict(start && distance(world, *start) <= tolerance + 2 * world.noise());
}

// So far that no joint goes there in a few cycles, and inside the limits.
JointVector far_from(RobotArmWorld& world, const JointVector& here) {
  JointVector far = here;
  for (std::size_t i = 0; i < world.arm().kinematic_chain().joint_count; ++i) {
    const ChainJoint& joint = world.arm().kinematic_chain().joints[i];
    const auto index = static_cast<Eigen::Index>(i);
    const double way = 0.1 * joint.velocity;
    far[index] += here[index] + way < joint.upper ? way : -way;
  }
  return far;
}

/// A first command far from the actual position is ignored, and reported.
// [robot-arm-12]
Verdict begins_only_where_it_is(RobotArmWorld& world) {
  for (int permission = 0; permission < 2; ++permission) {
    idle_for(world, 0.5);
    const auto start = sensed(world);
    if (!start) return Verdict::failed;
    const JointVector far = far_from(world, *start);
    const Restraint said = said_while(world, far, 0.5);
    if (said.reason == nullptr ||
        std::string_view{said.reason}.find("do not begin") == std::string_view::npos)
      return Verdict::failed;
    if (distance(world, *start) > tolerance + 2 * world.noise() || !world.arm().fault().is_ok())
      return Verdict::failed;
    // From where it is it goes there.
    begin_here(world);
    command_for(world, far, 2.0);
    if (distance(world, far) > tolerance + world.noise()) return Verdict::failed;
    // And what was begun before an inhibition counts no more.
    world.arm().set_inhibited(true);
    idle_for(world, 0.3);
    world.arm().set_inhibited(false);
  }
  return Verdict::passed;
}

/// Somebody may have moved the arm while it told no positions.
// [robot-arm-12]
Verdict begins_anew_after_a_silence(RobotArmWorld& world) {
  const JointVector here = beside(world, 0);
  command_for(world, here, 0.1);
  if (!world.lose_sensors()) return Verdict::skipped;
  command_for(world, here, 0.05);
  if (!world.find_sensors()) return Verdict::skipped;
  idle_for(world, 0.02);
  const Restraint said = said_while(world, far_from(world, here), 0.2);
  return verdict(said.reason != nullptr && distance(world, here) <= tolerance + 2 * world.noise());
}

// [robot-arm-2]
Verdict follows_commands_and_holds(RobotArmWorld& world) {
  const JointVector goal = beside(world, 0.1);
  command_for(world, goal, 2.0);
  if (distance(world, goal) > tolerance + world.noise()) return Verdict::failed;
  idle_for(world, 0.5);  // the last command stands
  return verdict(distance(world, goal) <= tolerance + world.noise());
}

// [robot-arm-3]
Verdict keeps_to_its_limits(RobotArmWorld& world) {
  const KinematicChain& chain = world.arm().kinematic_chain();
  begin_here(world);
  JointVector far = JointVector::Zero();
  for (std::size_t i = 0; i < chain.joint_count; ++i) far[static_cast<Eigen::Index>(i)] = 100;
  for (double time = 0; time < 3; time += cycle_seconds) {
    command_for(world, far, cycle_seconds);
    const auto at = sensed(world);
    if (!at) return Verdict::failed;
    if ((*at - within_limits(chain, *at)).cwiseAbs().maxCoeff() > world.noise()) return Verdict::failed;
  }
  return Verdict::passed;
}

// [robot-arm-6] [exec-73]
Verdict an_inhibited_arm_holds(RobotArmWorld& world) {
  const JointVector start = beside(world, 0);
  world.arm().set_inhibited(true);
  const JointVector goal = beside(world, 0.2);
  command_for(world, goal, 0.25);
  static_cast<void>(world.arm().take_restraint());
  if (said_while(world, goal, 0.25).reason != nullptr) return Verdict::failed;
  if (distance(world, start) > tolerance + 2 * world.noise()) return Verdict::failed;
  // What was commanded meanwhile is forgotten.
  world.arm().set_inhibited(false);
  idle_for(world, 0.5);
  return verdict(distance(world, start) <= tolerance + 2 * world.noise());
}

// [robot-arm-6]
Verdict inhibiting_ends_a_motion(RobotArmWorld& world) {
  const JointVector goal = beside(world, 0.5);
  command_for(world, goal, 0.1);
  world.arm().set_inhibited(true);
  idle_for(world, 1.0);
  const auto rest = sensed(world);
  idle_for(world, 0.3);
  return verdict(rest && distance(world, *rest) <= 2 * world.noise() + 1e-9);
}

/// A command that the inhibition overtook.
// [robot-arm-6]
Verdict a_command_from_before_is_forgotten(RobotArmWorld& world) {
  idle_for(world, 0.05);
  const JointVector start = beside(world, 0);
  world.arm().command(positions_of(beside(world, 0.2)));
  world.arm().set_inhibited(true);
  idle_for(world, 0.3);
  world.arm().set_inhibited(false);
  idle_for(world, 0.5);
  return verdict(distance(world, start) <= tolerance + 2 * world.noise());
}

// [robot-arm-5]
Verdict nonsense_is_a_fault_and_never_followed(RobotArmWorld& world) {
  const JointVector start = beside(world, 0);
  JointVector bad = start;
  bad[0] = std::numeric_limits<double>::quiet_NaN();
  command_for(world, bad, 0.1);
  const auto at = sensed(world);
  return verdict(!world.arm().fault().is_ok() && at && at->allFinite() &&
                 distance(world, start) <= tolerance + 2 * world.noise());
}

// [robot-arm-8]
Verdict can_be_made_safe(RobotArmWorld& world) {
  const JointVector goal = beside(world, 0.5);
  command_for(world, goal, 0.1);
  for (int cycles = 0; cycles < 300; ++cycles) {
    world.receive(cycle);
    world.send();
    if (!world.arm().make_safe()) continue;
    const auto rest = sensed(world);
    world.arm().set_inhibited(true);
    idle_for(world, 0.2);
    return verdict(rest && distance(world, *rest) <= tolerance + 2 * world.noise());
  }
  return Verdict::failed;
}

// [robot-arm-1]
Verdict says_nothing_when_its_sensors_are_lost(RobotArmWorld& world) {
  idle_for(world, 0.05);
  if (!world.lose_sensors()) return Verdict::skipped;
  idle_for(world, 0.1);
  return verdict(!world.arm().state());
}

/// Half a second may pass, or less where the driver has a limit of its own; then nobody knows where it is,
/// and that is no reason to go on.
// [robot-arm-7]
Verdict silence_in_operation_is_a_fault(RobotArmWorld& world) {
  const JointVector goal = beside(world, 0.02);
  command_for(world, goal, 0.1);
  if (!world.lose_sensors()) return Verdict::skipped;
  idle_for(world, 0.7);
  return verdict(!world.arm().fault().is_ok() && world.arm().fault().cause()[0] != '\0');
}

/// Without the permission to move nobody needs to know.
// [robot-arm-11]
Verdict silence_while_inhibited_is_none(RobotArmWorld& world) {
  idle_for(world, 0.05);
  world.arm().set_inhibited(true);
  idle_for(world, 0.05);
  if (!world.lose_sensors()) return Verdict::skipped;
  idle_for(world, 1.0);
  return verdict(world.arm().fault().is_ok());
}

// [robot-arm-7]
Verdict a_joint_that_sticks_is_a_fault(RobotArmWorld& world) {
  idle_for(world, 0.05);
  if (!world.stick_joint()) return Verdict::skipped;
  // As fast as it may, so that what it is behind is what it does not move.
  const JointVector start = beside(world, 0);
  const KinematicChain& chain = world.arm().kinematic_chain();
  const ChainJoint& joint = chain.joints[0];
  const double direction = joint.upper - start[0] > start[0] - joint.lower ? 1 : -1;
  for (double time = 0; time < 0.8 && world.arm().fault().is_ok(); time += cycle_seconds) {
    JointVector goal = start;
    goal[0] += direction * std::min(joint.velocity * time,
                                    0.9 * (direction > 0 ? joint.upper - start[0] : start[0] - joint.lower));
    command_for(world, goal, cycle_seconds);
  }
  const Status& fault = world.arm().fault();
  return verdict(fault.code() == StatusCode::device_fault &&
                 std::string_view{fault.cause()}.find("behind") != std::string_view::npos);
}

/// It falls behind, as long as it lasts; a motion that its joints can follow is none of that.
// [robot-arm-4]
Verdict says_that_it_is_led_too_fast(RobotArmWorld& world) {
  const JointVector start = beside(world, 0);
  said_while(world, start, 0.1);
  const KinematicChain& chain = world.arm().kinematic_chain();
  JointVector goal = start;
  for (int cycles = 0; cycles < 50; ++cycles) {
    for (std::size_t i = 0; i < chain.joint_count; ++i)
      goal[static_cast<Eigen::Index>(i)] += 0.1 * chain.joints[i].velocity * cycle_seconds;
    goal = within_limits(chain, goal);
    if (said_while(world, goal, cycle_seconds / 2).reason != nullptr) return Verdict::failed;
  }
  idle_for(world, 0.5);
  static_cast<void>(world.arm().take_restraint());
  goal = start;
  // So far that it takes 0.2 s at least; farther behind would be a fault.
  goal[0] += (start[0] > 0 ? -0.2 : 0.2) * chain.joints[0].velocity;
  if (said_while(world, goal, 0.05).reason == nullptr) return Verdict::failed;
  const Restraint said = said_while(world, goal, 0.05);
  if (said.reason == nullptr || std::string_view{said.reason}.find("joint 1 is led faster") != 0)
    return Verdict::failed;
  const bool counts =
      std::abs(said.asked - goal[0]) < tolerance && std::abs(said.given - goal[0]) > tolerance;
  command_for(world, goal, 2);
  static_cast<void>(world.arm().take_restraint());
  return verdict(counts && said_while(world, goal, 0.1).reason == nullptr && world.arm().fault().is_ok());
}

// [robot-arm-9]
Verdict reports_tripped_drives(RobotArmWorld& world) {
  idle_for(world, 0.05);
  if (!world.trip_drives()) return Verdict::skipped;
  idle_for(world, 0.1);
  const Status& fault = world.arm().fault();
  return verdict(fault.code() == StatusCode::device_fault && fault.cause()[0] != '\0');
}

template <Verdict (*Run)(RobotArmWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_robot_arm_conformance(const char* driver, MakeRobotArmWorld make) {
  make_world = make;
  const CMUnitTest tests[] = {
      {"tells a sane state", judged<tells_a_sane_state>, nullptr, nullptr, nullptr},
      {"tells when it measured", judged<tells_when_it_measured>, nullptr, nullptr, nullptr},
      {"stays where it is without a command", judged<stays_where_it_is_without_a_command>, nullptr, nullptr,
       nullptr},
      {"begins only where it is", judged<begins_only_where_it_is>, nullptr, nullptr, nullptr},
      {"needs a new beginning after a silence", judged<begins_anew_after_a_silence>, nullptr, nullptr,
       nullptr},
      {"follows commands and holds the last", judged<follows_commands_and_holds>, nullptr, nullptr, nullptr},
      {"keeps to its limits", judged<keeps_to_its_limits>, nullptr, nullptr, nullptr},
      {"holds while inhibited and forgets", judged<an_inhibited_arm_holds>, nullptr, nullptr, nullptr},
      {"comes to rest when inhibited", judged<inhibiting_ends_a_motion>, nullptr, nullptr, nullptr},
      {"forgets what an inhibition overtook", judged<a_command_from_before_is_forgotten>, nullptr, nullptr,
       nullptr},
      {"never follows nonsense", judged<nonsense_is_a_fault_and_never_followed>, nullptr, nullptr, nullptr},
      {"can be made safe", judged<can_be_made_safe>, nullptr, nullptr, nullptr},
      {"is silent without sensors", judged<says_nothing_when_its_sensors_are_lost>, nullptr, nullptr,
       nullptr},
      {"is in fault when it is silent in operation", judged<silence_in_operation_is_a_fault>, nullptr,
       nullptr, nullptr},
      {"may be silent while inhibited", judged<silence_while_inhibited_is_none>, nullptr, nullptr, nullptr},
      {"is in fault when a joint sticks", judged<a_joint_that_sticks_is_a_fault>, nullptr, nullptr, nullptr},
      {"says that it is led too fast", judged<says_that_it_is_led_too_fast>, nullptr, nullptr, nullptr},
      {"reports tripped drives", judged<reports_tripped_drives>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
