#include "hal/force_torque/conformance/force_torque_cases.hpp"
#include "tests/recovery.hpp"

namespace flexrf::force_torque_cases {
namespace {

bool is_overloaded(ForceTorqueWorld& world) {
  const auto state = world.sensor().state();
  const Status& trouble = world.sensor().trouble();
  return state && state->overload && trouble.code() == StatusCode::out_of_range && trouble.cause()[0] != '\0';
}

bool becomes_overloaded(ForceTorqueWorld& world) {
  return until(world, [&] { return is_overloaded(world); }) && world.feedback().overload &&
         world.feedback().overloads == 1;
}

/// The cause has gone.
bool is_well_again(ForceTorqueWorld& world) {
  return is_heard(world) && !world.sensor().state()->overload && world.feedback().trouble_view().empty() &&
         world.feedback().troubles == 1 && world.feedback().recoveries == 1;
}

constexpr const char* name_of(SensorFarEnd behaviour) {
  switch (behaviour) {
    case SensorFarEnd::off:
      return "power out";
    case SensorFarEnd::unplugged:
      return "cable out";
    case SensorFarEnd::damaged:
      return "garbage";
    case SensorFarEnd::truncated:
      return "truncated messages";
    case SensorFarEnd::foreign:
      return "somebody else's messages";
    default:
      return "silence";
  }
}

}  // namespace

// [force-torque-sensor-4] [force-torque-sensor-6]
Verdict tells_a_force_beyond_its_limit(ForceTorqueWorld& world) {
  if (!world.start({.force_limit = 100}) || !is_heard(world)) return Verdict::failed;
  world.load({0, 0, 99.5}, {30, 0, 0});
  if (!measures(world, {0, 0, 99.5}, {30, 0, 0}) || world.sensor().state()->overload) return Verdict::failed;
  world.load({0, -101, 0}, {0, 0, 0});
  if (!becomes_overloaded(world)) return Verdict::failed;
  world.sensor().tare();  // not with such a load
  if (world.sensor().is_taring()) return Verdict::failed;
  world.load({0, 0, 0}, {0, 0, 0});
  return verdict(measures(world, {0, 0, 0}, {0, 0, 0}) && is_well_again(world));
}

// [force-torque-sensor-4] [force-torque-sensor-6]
Verdict tells_a_torque_beyond_its_limit(ForceTorqueWorld& world) {
  if (!world.start({.torque_limit = 10}) || !is_heard(world)) return Verdict::failed;
  world.load({0, 0, 250}, {0, 0, 10.5});
  if (!becomes_overloaded(world)) return Verdict::failed;
  world.load({0, 0, 250}, {0, 0, -9.5});
  return verdict(measures(world, {0, 0, 250}, {0, 0, -9.5}) && is_well_again(world));
}

Verdict judges_its_limits_before_any_tare(ForceTorqueWorld& world) {
  if (!world.start({.force_limit = 100}) || !is_heard(world)) return Verdict::failed;
  world.load({80, 0, 0}, {0, 0, 0});
  if (!measures(world, {80, 0, 0}, {0, 0, 0}) || !tares(world)) return Verdict::failed;
  world.load({120, 0, 0}, {0, 0, 0});
  return verdict(becomes_overloaded(world));
}

// [force-torque-sensor-4] [force-torque-sensor-6]
Verdict tells_an_overload_of_the_sensors_own(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  if (!world.make(SensorFarEnd::saturated)) return Verdict::skipped;
  if (!becomes_overloaded(world)) return Verdict::failed;
  world.make(SensorFarEnd::well);
  return verdict(is_well_again(world));
}

/// What it sends then is no measurement.
// [force-torque-sensor-3] [force-torque-sensor-6]
Verdict tells_a_fault_of_the_sensors_own(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  if (!world.make(SensorFarEnd::faulty)) return Verdict::skipped;
  if (!until(world, [&] { return world.sensor().trouble().code() == StatusCode::device_fault; }))
    return Verdict::failed;
  if (world.sensor().state() || world.feedback().trouble_view().empty() || world.feedback().present)
    return Verdict::failed;
  world.sensor().tare();
  if (world.sensor().is_taring()) return Verdict::failed;
  world.make(SensorFarEnd::well);
  return verdict(is_well_again(world) && world.sensor().fault().is_ok());
}

Verdict counts_what_is_lost(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  const Wrench before = *world.sensor().state();
  if (!world.lose(7)) return Verdict::skipped;
  std::uint64_t lost_at = before.sequence;
  const bool counted = until(world, [&] {
    if (world.feedback().lost >= 7) return true;
    // A sensor that stood still is asked anew, and what is lost before its new stream is not known.
    const auto state = world.sensor().state();
    if (state && state->sequence > lost_at + 50) {
      lost_at = state->sequence;
      world.lose(7);
    }
    return false;
  });
  if (!counted) return Verdict::failed;
  const ForceTorqueSensorFeedback& told = world.feedback();
  // Each that was sent has its number, whether it came or not.
  return verdict(is_renewed(world) && world.sensor().state()->sequence >= before.sequence + 8 &&
                 world.sensor().state()->sequence == told.samples + told.lost);
}

// It is noticed, told and counted; once the cause is gone it measures again, in 2 s at most.
// [force-torque-sensor-1] [force-torque-sensor-6]
template <SensorFarEnd Behaviour>
Verdict is_heard_again(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  world.load(some_force, some_torque);
  if (!measures(world, some_force, some_torque)) return Verdict::failed;
  if (!world.make(Behaviour)) return Verdict::skipped;
  const auto is_counted = [&] {
    return Behaviour == SensorFarEnd::foreign ? world.feedback().foreign > 0
           : Behaviour == SensorFarEnd::damaged || Behaviour == SensorFarEnd::truncated
               ? world.feedback().damaged > 0
               : true;
  };
  if (!until(world, [&] { return !world.sensor().state() && is_counted(); })) return Verdict::failed;
  const Status& trouble = world.sensor().trouble();
  if (trouble.code() != StatusCode::unavailable || trouble.cause()[0] == '\0' ||
      world.feedback().troubles != 1 || world.feedback().trouble_view().empty() ||
      !world.sensor().fault().is_ok())
    return Verdict::failed;
  world.load({1, 2, 3}, {0, 0, 0});
  world.make(SensorFarEnd::well);
  const Time since = world.now();
  if (!measures(world, {1, 2, 3}, {0, 0, 0})) return Verdict::failed;
  const bool soon = !world.has_virtual_time() || is_back_in_time(name_of(Behaviour), world.now() - since);
  return verdict(soon && world.sensor().trouble().is_ok() && world.feedback().recoveries == 1);
}

Verdict gives_up_a_tare_that_is_not_heard(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  world.load(some_force, some_torque);
  if (!measures(world, some_force, some_torque)) return Verdict::failed;
  if (!world.make(SensorFarEnd::silent)) return Verdict::skipped;
  if (!until(world, [&] { return !world.sensor().state(); })) return Verdict::failed;
  world.sensor().tare();
  if (world.sensor().is_taring()) return Verdict::failed;
  world.make(SensorFarEnd::well);
  return verdict(measures(world, some_force, some_torque) && !world.sensor().state()->tared);
}

Verdict is_initialised_again(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  world.load(some_force, some_torque);
  if (!measures(world, some_force, some_torque) || !tares(world)) return Verdict::failed;
  world.sensor().stop();
  if (!world.sensor().initialise() || world.sensor().state()) return Verdict::failed;
  // What was taken off before is forgotten.
  return verdict(measures(world, some_force, some_torque) && !world.feedback().tared);
}

template Verdict is_heard_again<SensorFarEnd::silent>(ForceTorqueWorld& world);
template Verdict is_heard_again<SensorFarEnd::off>(ForceTorqueWorld& world);
template Verdict is_heard_again<SensorFarEnd::unplugged>(ForceTorqueWorld& world);
template Verdict is_heard_again<SensorFarEnd::damaged>(ForceTorqueWorld& world);
template Verdict is_heard_again<SensorFarEnd::truncated>(ForceTorqueWorld& world);
template Verdict is_heard_again<SensorFarEnd::foreign>(ForceTorqueWorld& world);

}  // namespace flexrf::force_torque_cases
