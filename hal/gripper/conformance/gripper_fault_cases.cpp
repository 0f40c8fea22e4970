#include "hal/gripper/conformance/gripper_cases.hpp"

namespace flexrf::gripper_cases {

// [gripper-16] [gripper-21]
Verdict fingers_that_do_not_move_are_told(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  if (!world.make(GripperFarEnd::stuck)) return Verdict::skipped;
  if (!goes_to(world, closed) || !is_heard(world)) return Verdict::failed;
  const Status& trouble = world.gripper().trouble();
  if (trouble.code() != StatusCode::timeout || trouble.cause()[0] == '\0') return Verdict::failed;
  world.make(GripperFarEnd::well);
  const double before = world.fingers();
  idle_for(world, std::chrono::milliseconds(300));
  if (world.fingers() != before) return Verdict::failed;  // only when it is told again
  return verdict(becomes_active(world) && goes_to(world, closed) && fingers_at(world, closed) &&
                 world.gripper().trouble().is_ok());
}

namespace {

const GripperFeedback& feedback(GripperWorld& world) {
  return *static_cast<const GripperFeedback*>(world.gripper().parameter_memory().feedback);
}

}  // namespace

// It is noticed, told and counted; once the cause is gone it is known again how it is, in 2 s at most, and
// follows.
// [gripper-4] [gripper-5]
template <GripperFarEnd Behaviour>
Verdict is_heard_again(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  if (!world.make(Behaviour)) return Verdict::skipped;
  if (!until(world, [&] { return !world.gripper().state(); })) return Verdict::failed;
  const Status& trouble = world.gripper().trouble();
  const bool told = trouble.code() == StatusCode::unavailable && trouble.cause()[0] != '\0';
  act(world, [](Gripper& gripper) { gripper.close(); });  // to nobody: not remembered
  if (!told || feedback(world).troubles == 0 || feedback(world).trouble_view().empty())
    return Verdict::failed;
  world.make(GripperFarEnd::well);
  const Time since = world.now();
  if (!until(world, [&] { return world.gripper().state().has_value(); })) return Verdict::failed;
  const bool soon = !world.has_virtual_time() || world.now() - since <= std::chrono::seconds(2);
  idle_for(world, std::chrono::milliseconds(300));
  if (!soon || !fingers_at(world, opened)) return Verdict::failed;
  return verdict(becomes_active(world) && goes_to(world, closed) && fingers_at(world, closed) &&
                 world.gripper().trouble().is_ok() && feedback(world).recoveries > 0);
}

// [gripper-6]
Verdict without_power_it_is_no_longer_activated(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, closed)) return Verdict::failed;
  if (!world.make(GripperFarEnd::off)) return Verdict::skipped;
  if (!until(world, [&] { return !world.gripper().state(); })) return Verdict::failed;
  world.make(GripperFarEnd::well);
  if (!until(world, [&] { return world.gripper().state().has_value(); })) return Verdict::failed;
  idle_for(world, std::chrono::milliseconds(700));  // longer than anything is repeated after
  return verdict(!world.gripper().state()->activated && fingers_at(world, closed) && becomes_active(world) &&
                 goes_to(world, opened) && fingers_at(world, opened));
}

// [gripper-5] [gripper-6]
Verdict its_own_fault_is_told_and_ended_by_activation(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  act(world, [](Gripper& gripper) { gripper.close(); });
  if (!world.make(GripperFarEnd::tripped)) return Verdict::skipped;
  if (!until(world, [&] { return world.gripper().trouble().code() == StatusCode::device_fault; }))
    return Verdict::failed;
  idle_for(world, std::chrono::milliseconds(100));
  const auto state = world.gripper().state();
  if (!state || state->activated || state->moving || world.gripper().trouble().cause()[0] == '\0')
    return Verdict::failed;
  world.make(GripperFarEnd::well);
  return verdict(becomes_active(world) && world.gripper().trouble().is_ok() && goes_to(world, closed) &&
                 fingers_at(world, closed));
}

// [gripper-5]
Verdict switches_that_contradict_are_told(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  if (!world.make(GripperFarEnd::switch_broken)) return Verdict::skipped;
  if (!until(world, [&] { return world.gripper().trouble().code() == StatusCode::device_fault; }))
    return Verdict::failed;
  if (world.gripper().state()->opening) return Verdict::failed;
  world.make(GripperFarEnd::well);
  return verdict(until(world, [&] { return world.gripper().trouble().is_ok(); }) && becomes_active(world) &&
                 goes_to(world, closed) && fingers_at(world, closed));
}

template Verdict is_heard_again<GripperFarEnd::silent>(GripperWorld& world);
template Verdict is_heard_again<GripperFarEnd::off>(GripperWorld& world);
template Verdict is_heard_again<GripperFarEnd::unplugged>(GripperWorld& world);
template Verdict is_heard_again<GripperFarEnd::damaged>(GripperWorld& world);

}  // namespace flexrf::gripper_cases
