#include "hal/force_torque/conformance/force_torque_conformance.hpp"

#include "hal/force_torque/conformance/force_torque_cases.hpp"
#include "tests/conformance.hpp"

namespace flexrf {
namespace force_torque_cases {

// [force-torque-sensor-3]
Verdict measures_what_loads_it(ForceTorqueWorld& world) {
  if (!world.start({})) return Verdict::failed;
  if (world.sensor().state()) return Verdict::failed;  // nothing came yet
  return verdict(
      measures(world, {0, 0, 0}, {0, 0, 0}) &&
      (world.load(some_force, some_torque), measures(world, some_force, some_torque)) &&
      (world.load({-300, 0, 0.01}, {0, -30, 0.001}), measures(world, {-300, 0, 0.01}, {0, -30, 0.001})) &&
      world.sensor().trouble().is_ok() && !world.sensor().state()->tared &&
      !world.sensor().state()->overload && world.feedback().trouble_view().empty());
}

// [force-torque-sensor-5]
Verdict measurements_follow_each_other(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  for (int i = 0; i < 10; ++i) {
    const Wrench before = *world.sensor().state();
    if (!is_renewed(world)) return Verdict::failed;
    const Wrench after = *world.sensor().state();
    if (after.time <= before.time || after.sequence <= before.sequence) return Verdict::failed;
    if (world.sensor().age() != world.now() - Time{Duration{after.time}} &&
        world.sensor().age() != Duration{})
      return Verdict::failed;
  }
  return verdict(world.feedback().samples >= 10 && world.feedback().present && world.feedback().foreign == 0);
}

Verdict publishes_what_it_measures(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  world.load(some_force, some_torque);
  if (!measures(world, some_force, some_torque)) return Verdict::failed;
  SlotReader reader(world.slot());
  const ItemHeader* const header = reader.newest();
  if (header == nullptr) return Verdict::failed;
  const auto& wrench = *static_cast<const Wrench*>(reader.payload());
  return verdict(near(wrench.force, some_force) && near(wrench.torque, some_torque) &&
                 header->sampled_at == Time{Duration{wrench.time}} &&
                 wrench.sequence == world.sensor().state()->sequence);
}

/// A quarter turn about z, and the sensor sits above: what pulls along its x pulls along y, and turns about
/// x.
// [force-torque-sensor-2]
Verdict gives_it_in_the_configured_frame(ForceTorqueWorld& world) {
  const double half = std::sqrt(0.5);
  if (!world.start({.position = {0, 0, 0.1}, .orientation = {0, 0, half, half}}) || !is_heard(world))
    return Verdict::failed;
  world.load({20, 0, 0}, {0, 0, 3});
  if (!measures(world, {0, 20, 0}, {-2, 0, 3})) return Verdict::failed;
  world.load({0, 10, 5}, {1, 0, 0});
  return verdict(measures(world, {-10, 0, 5}, {0, 0, 0}));
}

// [force-torque-sensor-2] [force-torque-sensor-7] [force-torque-sensor-8]
Verdict takes_off_a_tare(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  world.load(some_force, some_torque);
  if (!measures(world, some_force, some_torque) || !tares(world)) return Verdict::failed;
  if (!measures(world, {0, 0, 0}, {0, 0, 0}) || !near(world.feedback().force_tare, some_force))
    return Verdict::failed;
  world.load({some_force[0] + 5, some_force[1], some_force[2]}, some_torque);
  if (!measures(world, {5, 0, 0}, {0, 0, 0})) return Verdict::failed;
  if (!tares(world) || !measures(world, {0, 0, 0}, {0, 0, 0})) return Verdict::failed;
  world.sensor().clear_tare();
  return verdict(measures(world, {some_force[0] + 5, some_force[1], some_force[2]}, some_torque) &&
                 !world.sensor().state()->tared);
}

Verdict is_tared_and_cleared_by_a_person(ForceTorqueWorld& world) {
  if (!world.start({}) || !is_heard(world)) return Verdict::failed;
  world.load(some_force, some_torque);
  if (!measures(world, some_force, some_torque)) return Verdict::failed;
  world.runtime().tare = 1;
  world.receive();
  world.runtime().tare = 0;
  if (!measures(world, {0, 0, 0}, {0, 0, 0}) || !world.feedback().tared) return Verdict::failed;
  world.runtime().clear_tare = 1;
  world.receive();
  world.runtime().clear_tare = 0;
  return verdict(measures(world, some_force, some_torque) && !world.feedback().tared);
}

Verdict refuses_a_frame_that_makes_no_sense(ForceTorqueWorld& world) {
  return verdict(world.start({.orientation = {0, 0, 1, 1}}).code() == StatusCode::invalid_argument &&
                 world.start({.position = {0, NAN, 0}}).code() == StatusCode::invalid_argument &&
                 world.start({.force_limit = -1}).code() == StatusCode::invalid_argument &&
                 world.start({}).is_ok() && is_heard(world));
}

}  // namespace force_torque_cases

namespace {

using namespace force_torque_cases;

MakeForceTorqueWorld make_world = nullptr;

template <Verdict (*Run)(ForceTorqueWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

CMUnitTest test(const char* name, CMUnitTestFunction run) {
  return {name, run, nullptr, nullptr, nullptr};
}

}  // namespace

int run_force_torque_conformance(const char* driver, MakeForceTorqueWorld make) {
  make_world = make;
  using enum SensorFarEnd;
  const CMUnitTest tests[] = {
      test("measures what loads it", judged<measures_what_loads_it>),
      test("measurements follow each other", judged<measurements_follow_each_other>),
      test("publishes what it measures", judged<publishes_what_it_measures>),
      test("gives it in the configured frame", judged<gives_it_in_the_configured_frame>),
      test("takes off a tare", judged<takes_off_a_tare>),
      test("is tared and cleared by a person", judged<is_tared_and_cleared_by_a_person>),
      test("refuses a frame that makes no sense", judged<refuses_a_frame_that_makes_no_sense>),
      test("tells a force beyond its limit", judged<tells_a_force_beyond_its_limit>),
      test("tells a torque beyond its limit", judged<tells_a_torque_beyond_its_limit>),
      test("judges its limits before any tare", judged<judges_its_limits_before_any_tare>),
      test("tells an overload of the sensor's own", judged<tells_an_overload_of_the_sensors_own>),
      test("tells a fault of the sensor's own", judged<tells_a_fault_of_the_sensors_own>),
      test("counts what is lost", judged<counts_what_is_lost>),
      test("silent peer", judged<is_heard_again<silent>>),
      test("power out and in again", judged<is_heard_again<off>>),
      test("cable out and in again", judged<is_heard_again<unplugged>>),
      test("garbage", judged<is_heard_again<damaged>>),
      test("truncated messages", judged<is_heard_again<truncated>>),
      test("somebody else's messages", judged<is_heard_again<foreign>>),
      test("gives up a tare that is not heard", judged<gives_up_a_tare_that_is_not_heard>),
      test("is initialised again", judged<is_initialised_again>),
  };
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
