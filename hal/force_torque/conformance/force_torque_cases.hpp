// What the cases of the suite have in common: a unit's steps, and what it waits for.
#pragma once

#include <cmath>

#include "hal/force_torque/conformance/force_torque_conformance.hpp"
#include "tests/verdict.hpp"

namespace flexrf::force_torque_cases {

using Vector = std::array<double, 3>;

// By the world's clock, for what must happen sooner or later: a loaded machine takes long.
inline constexpr Duration patience = std::chrono::seconds(40);

inline constexpr Vector some_force{12.5, -3.25, 40};
inline constexpr Vector some_torque{0.125, 1.5, -0.75};

template <class Condition>
inline bool until(ForceTorqueWorld& world, const Condition& is_so) {
  for (const Time start = world.now(); world.now() - start < patience;) {
    world.receive();
    if (is_so()) return true;
  }
  return false;
}

inline bool near(const Vector& one, const Vector& other) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(one[i] - other[i]) < 1e-6)) return false;
  return true;
}

/// It comes to say so.
inline bool measures(ForceTorqueWorld& world, const Vector& force, const Vector& torque) {
  return until(world, [&] {
    const auto state = world.sensor().state();
    return state && near(state->force, force) && near(state->torque, torque);
  });
}

inline bool is_heard(ForceTorqueWorld& world) {
  return until(world, [&] { return world.sensor().state().has_value() && world.sensor().trouble().is_ok(); });
}

/// Another measurement than before.
inline bool is_renewed(ForceTorqueWorld& world) {
  const auto before = world.sensor().state();
  return until(world, [&] {
    const auto state = world.sensor().state();
    return state && (!before || state->sequence > before->sequence);
  });
}

inline bool tares(ForceTorqueWorld& world) {
  world.sensor().tare();
  return until(world, [&] { return !world.sensor().is_taring(); }) && is_renewed(world) &&
         world.sensor().state()->tared;
}

// ---- the cases

Verdict measures_what_loads_it(ForceTorqueWorld& world);
Verdict measurements_follow_each_other(ForceTorqueWorld& world);
Verdict publishes_what_it_measures(ForceTorqueWorld& world);
Verdict gives_it_in_the_configured_frame(ForceTorqueWorld& world);
Verdict takes_off_a_tare(ForceTorqueWorld& world);
Verdict is_tared_and_cleared_by_a_person(ForceTorqueWorld& world);
Verdict refuses_a_frame_that_makes_no_sense(ForceTorqueWorld& world);
Verdict tells_a_force_beyond_its_limit(ForceTorqueWorld& world);
Verdict tells_a_torque_beyond_its_limit(ForceTorqueWorld& world);
Verdict judges_its_limits_before_any_tare(ForceTorqueWorld& world);
Verdict tells_an_overload_of_the_sensors_own(ForceTorqueWorld& world);
Verdict tells_a_fault_of_the_sensors_own(ForceTorqueWorld& world);
Verdict counts_what_is_lost(ForceTorqueWorld& world);
template <SensorFarEnd Behaviour>
Verdict is_heard_again(ForceTorqueWorld& world);
Verdict gives_up_a_tare_that_is_not_heard(ForceTorqueWorld& world);
Verdict is_initialised_again(ForceTorqueWorld& world);

}  // namespace flexrf::force_torque_cases
