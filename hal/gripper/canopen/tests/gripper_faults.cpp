// Each case: what the operator reads, what state driver and drive are in, and that both come back once the
// cause is gone and a person activates the gripper, and how soon.
#include "hal/gripper/canopen/tests/gripper_faults.hpp"

#include <cstdio>

#include "hal/gripper/conformance/gripper_cases.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"
#include "tests/recovery.hpp"

namespace flexrf {
// Beside drive_faults.cpp, whose cases have names of their own for the same.
namespace gripper_faults {
namespace {

using namespace gripper_cases;

MakeAxisGripperWorld make_axis = nullptr;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)(AxisGripperWorld&), bool Homes = false>
void judged(void**) {
  bool good = false;
  {
    const std::unique_ptr<AxisGripperWorld> world = make_axis({.homes = Homes});
    const Status started = world->start({});
    good = started && Run(*world);
    if (!started) std::printf("the test's world cannot be made: %s\n", started.cause());
    if (!good) {
      std::printf("the operator reads: %s; the drive: %s\n", world->gripper().trouble().cause(),
                  world->ask("state").c_str());
    }
  }
  assert_true(good);
}

bool says(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// What the operator reads, in the device's feedback as well.
bool reads(AxisGripperWorld& world, std::string_view part) {
  return until(world, [&] { return says(world.gripper().trouble().cause(), part); }) && [&] {
    const auto& feedback =
        *static_cast<const CanopenGripper::Feedback*>(world.driver().parameter_memory().feedback);
    return says(feedback.trouble_view(), part);
  }();
}

bool closes(AxisGripperWorld& world) {
  if (!becomes_active(world) || !goes_to(world, opened)) return false;
  act(world, [](Gripper& gripper) { gripper.close(); });
  return until(world, [&] { return world.fingers() < opened - 0.005; });
}

bool drive_is(AxisGripperWorld& world, std::string_view state) {
  return until(world, [&] {
    const std::string said = world.ask("state");
    return says(said, state) && says(said, "with 0/s");
  });
}

// Nothing is enabled by itself, and nothing is remembered.
bool stays_off(AxisGripperWorld& world) {
  const double before = world.fingers();
  act(world, [](Gripper& gripper) { gripper.open(); });
  idle_for(world, std::chrono::seconds(1));
  const auto state = world.gripper().state();
  return !(state && state->activated) && world.fingers() == before && world.gripper().fault().is_ok() &&
         !says(world.ask("state"), "operation enabled");
}

bool comes_back(AxisGripperWorld& world, const char* from) {
  const Time begin = world.now();
  if (!becomes_active(world)) return false;
  return is_back_in_time(from, world.now() - begin) && world.gripper().trouble().is_ok() &&
         goes_to(world, closed) && fingers_at(world, closed);
}

bool cable_out_and_in_again_in_motion(AxisGripperWorld& world) {
  if (!closes(world) || !world.set_cable(false)) return false;
  if (!reads(world, "not heard: node 5: no process data") || world.gripper().state()) return false;
  // The drive no longer hears us, and stops by itself.
  if (!drive_is(world, "switch on disabled") || !world.set_cable(true)) return false;
  return reads(world, "was gone, and is off") && stays_off(world) &&
         comes_back(world, "a cable that was out");
}

bool power_of_the_drive_lost_while_it_holds(AxisGripperWorld& world) {
  if (!becomes_active(world) || !goes_to(world, opened) || !world.put_object(0.03)) return false;
  if (!goes_to(world, closed) || object(world) != GripperObject::gripped || !world.tell("off")) return false;
  if (!reads(world, "not heard") || !world.take_away() || !world.tell("on")) return false;
  // Whether it still holds something is not known.
  return reads(world, "activate it") && object(world) == GripperObject::unknown && stays_off(world) &&
         comes_back(world, "a loss of power");
}

bool heartbeat_of_the_drive_lost(AxisGripperWorld& world) {
  if (!closes(world) || !world.tell("silence") || !reads(world, "no heartbeat of node 5")) return false;
  if (!drive_is(world, "switch on disabled") || !stays_off(world) || !world.tell("speak")) return false;
  return reads(world, "activate it") && comes_back(world, "a lost heartbeat of the drive");
}

bool our_heartbeat_lost(AxisGripperWorld& world) {
  if (!closes(world)) return false;
  world.stall(std::chrono::seconds(1));
  if (!says(world.ask("state"), "switch on disabled")) return false;
  return reads(world, "8130") && stays_off(world) && comes_back(world, "a lost heartbeat of ours");
}

bool drive_fault_in_motion(AxisGripperWorld& world) {
  if (!closes(world) || !world.tell("trip 0x2310") || !reads(world, "the drive is in fault")) return false;
  if (!says(world.gripper().trouble().cause(), "current")) return false;
  return drive_is(world, "fault") && stays_off(world) && comes_back(world, "a fault of the drive");
}

bool drive_fault_whose_cause_stays(AxisGripperWorld& world) {
  if (!closes(world) || !world.tell("trip 0x4210 stays") || !reads(world, "temperature")) return false;
  act(world, [](Gripper& gripper) { gripper.activate(); });
  if (!reads(world, "still in fault after 3 resets") || !stays_off(world) || !world.tell("heal"))
    return false;
  return comes_back(world, "a fault whose cause went");
}

bool drive_that_resets_in_motion(AxisGripperWorld& world) {
  if (!closes(world) || !world.tell("reset") || !reads(world, "node 5 reset itself")) return false;
  return stays_off(world) && comes_back(world, "a reset of the drive");
}

bool another_drive_than_was_declared(AxisGripperWorld& world) {
  if (!world.tell("object 1018:01 0x999") || !reads(world, "is not the one that was declared")) return false;
  if (!stays_off(world) || !world.tell("object 1018:01 0x123")) return false;
  act(world, [](Gripper& gripper) { gripper.activate(); });  // it is asked anew who it is
  return until(world, [&] { return world.gripper().state().has_value(); }) &&
         comes_back(world, "a wrong identity");
}

bool object_that_the_drive_refuses(AxisGripperWorld& world) {
  // One that refuses what it has already is no worse for that.
  if (!world.tell("object 6065:00 1000") || !world.tell("refuse 6065:00 0x06090030")) return false;
  if (!reads(world, "6065:00")) return false;
  if (!world.tell("accept")) return false;
  act(world, [](Gripper& gripper) { gripper.activate(); });
  return until(world, [&] { return world.gripper().state().has_value(); }) &&
         comes_back(world, "a refused object");
}

bool drive_that_is_stuck_in_a_state(AxisGripperWorld& world) {
  if (!until(world, [&] { return world.gripper().state().has_value(); })) return false;
  if (!world.tell("stick ready to switch on")) return false;
  act(world, [](Gripper& gripper) { gripper.activate(); });
  if (!reads(world, "the drive stays 'ready to switch on'") || !stays_off(world)) return false;
  return world.tell("free") && comes_back(world, "a state that it was stuck in");
}

bool garbage_and_truncated_frames(AxisGripperWorld& world) {
  for (int i = 0; i < 5; ++i) {  // also while it is brought up
    idle_for(world, std::chrono::milliseconds(30));
    if (!world.tell("garbage")) return false;
  }
  if (!closes(world)) return false;
  const bool rested = until(world, [&] { return !world.tell("garbage") || rests(world); });
  return rested && fingers_at(world, closed) && world.gripper().trouble().is_ok();
}

bool homing_that_fails(AxisGripperWorld& world) {
  if (!until(world, [&] { return world.gripper().state().has_value(); })) return false;
  if (world.gripper().state()->opening || !world.tell("lose home")) return false;
  act(world, [](Gripper& gripper) { gripper.activate(); });
  if (!reads(world, "did not find their home") || !stays_off(world) || !world.tell("find home")) return false;
  return comes_back(world, "a home that was not found") && world.gripper().state()->opening.has_value();
}

// Motion is inhibited while it finds its home.
bool activation_that_is_inhibited(AxisGripperWorld& world) {
  if (!until(world, [&] { return world.gripper().state().has_value(); }) || !world.tell("lose home"))
    return false;
  act(world, [](Gripper& gripper) { gripper.activate(); });
  if (!until(world, [&] { return says(world.ask("state"), "operation enabled"); })) return false;
  act(world, [](Gripper& gripper) { gripper.set_inhibited(true); });
  if (!comes_to_rest(world) || !drive_is(world, "switch on disabled") || !world.tell("find home"))
    return false;
  world.gripper().set_inhibited(false);
  return stays_off(world) && comes_back(world, "an activation that was given up");
}

int run_cases(const char* where) {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<cable_out_and_in_again_in_motion>),
      cmocka_unit_test(judged<power_of_the_drive_lost_while_it_holds>),
      cmocka_unit_test(judged<heartbeat_of_the_drive_lost>),
      cmocka_unit_test(judged<our_heartbeat_lost>),
      cmocka_unit_test(judged<drive_fault_in_motion>),
      cmocka_unit_test(judged<drive_fault_whose_cause_stays>),
      cmocka_unit_test(judged<drive_that_resets_in_motion>),
      cmocka_unit_test(judged<another_drive_than_was_declared>),
      cmocka_unit_test(judged<object_that_the_drive_refuses>),
      cmocka_unit_test(judged<drive_that_is_stuck_in_a_state>),
      cmocka_unit_test(judged<garbage_and_truncated_frames>),
      {"homing that fails", judged<homing_that_fails, true>, nullptr, nullptr, nullptr},
      {"activation that is inhibited", judged<activation_that_is_inhibited, true>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests_name(where, tests, nullptr, nullptr);
}

}  // namespace
}  // namespace gripper_faults

int run_gripper_faults(const char* where, MakeAxisGripperWorld make) {
  gripper_faults::make_axis = make;
  return gripper_faults::run_cases(where);
}

}  // namespace flexrf
