// Each case: what the operator reads, what state driver and drive are in, and that both come back once the
// cause is gone, and how soon.
#include "hal/servo_drive/canopen/tests/drive_faults.hpp"

#include <cmath>
#include <cstdio>

#include "tests/cmocka.hpp"
#include "tests/recovery.hpp"

namespace flexrf {
namespace {

constexpr double start = 1;
constexpr double target = 9;
constexpr Duration patience = std::chrono::seconds(30);

MakeDriveFaultWorld make_world = nullptr;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)(DriveFaultWorld&)>
void judged(void**) {
  bool good = false;
  {
    const std::unique_ptr<DriveFaultWorld> world = make_world();
    good = Run(*world);
    if (!good) {
      std::printf("the driver: %s; the drive: %s\n", world->drive().fault().cause(),
                  world->ask("state").c_str());
    }
  }
  assert_true(good);
}

bool says(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

template <class Condition>
bool until(DriveFaultWorld& world, double position, const Condition& is_so) {
  for (const Time begin = world.now(); world.now() - begin < patience;) {
    world.step(position);
    if (is_so()) return true;
  }
  return false;
}

void run(DriveFaultWorld& world, double position, Duration time) {
  for (const Time begin = world.now(); world.now() - begin < time;) world.step(position);
}

bool is_enabled(DriveFaultWorld& world) {
  const auto state = world.drive().state();
  return state && state->enabled;
}

bool is_enabled_in_time(DriveFaultWorld& world) {
  return until(world, start, [&] { return is_enabled(world); }) && world.drive().fault().is_ok();
}

const CanopenServoDrive::Feedback& told(DriveFaultWorld& world) {
  return *static_cast<const CanopenServoDrive::Feedback*>(world.drive().parameter_memory().feedback);
}

// What the operator reads of a drive that is not there, and is not in use.
bool tells_trouble(DriveFaultWorld& world, std::string_view part) {
  return says(told(world).trouble_view(), part);
}

// It is on its way, and far from both ends of it.
bool moves(DriveFaultWorld& world) {
  if (!is_enabled_in_time(world)) return false;
  return until(world, target, [&] {
    const auto state = world.drive().state();
    return state && state->position > start + 0.3;
  });
}

// What the operator reads, while the unit goes on commanding.
bool reads(DriveFaultWorld& world, std::string_view part) {
  return until(world, target, [&] { return !world.drive().fault().is_ok(); }) &&
         says(world.drive().fault().cause(), part) && says(world.drive().fault().cause(), "node 5");
}

bool drive_is(DriveFaultWorld& world, std::string_view state) {
  return until(world, target, [&] {
    const std::string said = world.ask("state");
    return says(said, state) && says(said, "with 0/s");
  });
}

// Nothing is enabled by itself.
bool stays_off(DriveFaultWorld& world) {
  run(world, target, std::chrono::seconds(1));
  return !is_enabled(world) && !says(world.ask("state"), "operation enabled");
}

// After what a person does when the cause is gone.
bool comes_back(DriveFaultWorld& world, const char* from, bool by_itself = false) {
  const Time begin = world.now();
  if (!by_itself) world.restart();
  if (!is_enabled_in_time(world)) return false;
  return is_back_in_time(from, world.now() - begin);
}

// The bus is there, and the drive tells its state; in use or not.
bool is_heard_again(DriveFaultWorld& world, double position, BusLoss lost) {
  if (!world.restore_bus(lost)) return false;
  const Time begin = world.now();
  return until(world, position, [&] { return world.drive().state().has_value(); }) &&
         is_back_in_time("silence on the bus", world.now() - begin);
}

// As the bus itself tells: of a cable out next to the drive it knows nothing.
bool is_told(DriveFaultWorld& world, BusLoss lost) {
  if (lost == BusLoss::cable) return true;
  const CanBusState told = lost == BusLoss::adapter ? CanBusState::gone : CanBusState::bus_off;
  return until(world, target, [&] { return world.bus_state() == told; });
}

bool lost_in_motion(DriveFaultWorld& world, BusLoss how, const char* what) {
  if (!moves(world) || !world.lose_bus(how) || !is_told(world, how)) return false;
  if (!reads(world, "no process data for 10 cycles") || world.drive().state()) return false;
  // The drive no longer hears us, and stops by itself.
  return drive_is(world, "switch on disabled") && is_heard_again(world, target, how) && stays_off(world) &&
         comes_back(world, what);
}

bool cable_out_and_in_again_in_motion(DriveFaultWorld& world) {
  return lost_in_motion(world, BusLoss::cable, "a cable that was out in motion");
}

bool adapter_gone_and_back_in_motion(DriveFaultWorld& world) {
  return lost_in_motion(world, BusLoss::adapter, "an adapter that was gone in motion");
}

bool bus_off_in_motion(DriveFaultWorld& world) {
  return lost_in_motion(world, BusLoss::bus_off, "being off the bus in motion");
}

bool cable_out_and_in_again_while_off(DriveFaultWorld& world) {
  world.drive().set_inhibited(true);
  if (!until(world, start, [&] { return world.drive().state().has_value(); })) return false;
  if (!world.lose_bus(BusLoss::cable)) return false;
  run(world, start, std::chrono::seconds(1));
  if (world.drive().state() || !tells_trouble(world, "node 5")) return false;
  // It was not used: nothing to reset.
  if (!world.drive().fault().is_ok() || !is_heard_again(world, start, BusLoss::cable)) return false;
  world.drive().set_inhibited(false);
  return is_enabled_in_time(world);
}

bool drive_that_falls_silent_in_motion(DriveFaultWorld& world) {
  if (!moves(world) || !world.tell("off")) return false;
  if (!reads(world, "no process data for 10 cycles") || world.drive().state()) return false;
  if (!world.tell("on")) return false;
  return stays_off(world) && comes_back(world, "a silent drive");
}

bool heartbeat_of_the_drive_lost(DriveFaultWorld& world) {
  if (!moves(world)) return false;
  const std::uint64_t silences = told(world).silences;
  if (!world.tell("silence") || !reads(world, "no heartbeat of node 5 for 250 ms")) return false;
  if (!until(world, target, [&] { return told(world).silences > silences; })) return false;
  if (!drive_is(world, "switch on disabled") || !stays_off(world) || !world.tell("speak")) return false;
  return comes_back(world, "a lost heartbeat of the drive");
}

bool our_heartbeat_lost(DriveFaultWorld& world) {
  if (!moves(world)) return false;
  world.stall(std::chrono::seconds(1));
  const std::string said = world.ask("state");
  if (!says(said, "switch on disabled") || !says(said, "with 0/s")) return false;
  return reads(world, "it is 'switch on disabled'") && says(world.drive().fault().cause(), "8130") &&
         stays_off(world) && comes_back(world, "a lost heartbeat of ours");
}

/// As it came from the drive, beside what the interface makes of it. `code` 0: of none.
bool tells_of_fault(DriveFaultWorld& world, unsigned code) {
  constexpr unsigned fault_bit = 8;
  constexpr int cyclic_position = 8;
  const auto& as_it_came = told(world);
  return as_it_came.emergency_code == code && ((as_it_came.status_word & fault_bit) != 0) == (code != 0) &&
         (as_it_came.error_register != 0) == (code != 0) && as_it_came.mode_display == cyclic_position;
}

bool drive_fault_in_motion(DriveFaultWorld& world) {
  if (!moves(world)) return false;
  const std::uint64_t emergencies = told(world).emergencies;
  if (!world.tell("trip 0x2310")) return false;
  return reads(world, "the drive is in fault") && says(world.drive().fault().cause(), "current") &&
         until(world, target, [&] { return told(world).emergencies > emergencies; }) &&
         drive_is(world, "fault") && stays_off(world) && tells_of_fault(world, 0x2310) &&
         comes_back(world, "a fault of the drive") && tells_of_fault(world, 0);
}

bool drive_fault_whose_cause_stays(DriveFaultWorld& world) {
  if (!moves(world) || !world.tell("trip 0x4210 stays") || !reads(world, "temperature")) return false;
  world.restart();
  if (!reads(world, "still in fault after 3 resets") || !world.tell("heal")) return false;
  return comes_back(world, "a fault whose cause went");
}

bool drive_that_resets_in_motion(DriveFaultWorld& world) {
  if (!moves(world)) return false;
  const std::uint64_t resets = told(world).resets;
  const std::uint64_t bring_ups = told(world).bring_ups;
  if (bring_ups == 0 || !world.tell("reset") || !reads(world, "node 5 reset itself")) return false;
  const auto is_counted = [&] { return told(world).resets > resets && told(world).bring_ups > bring_ups; };
  return until(world, target, is_counted) && stays_off(world) && comes_back(world, "a reset of the drive");
}

bool another_drive_than_was_declared(DriveFaultWorld& world) {
  if (!world.tell("object 1018:01 0x999")) return false;
  if (!reads(world, "is not the one that was declared: its vendor is 00000999")) return false;
  if (!stays_off(world) || !world.tell("object 1018:01 0x123")) return false;
  return comes_back(world, "a wrong identity");
}

bool object_that_the_drive_refuses(DriveFaultWorld& world) {
  if (!world.tell("refuse 60C2:01 0x06090030") || !reads(world, "60C2:01")) return false;
  if (!says(world.drive().fault().cause(), "06090030") || !world.tell("accept")) return false;
  return comes_back(world, "a refused object");
}

bool fixed_mapping_that_does_not_fit(DriveFaultWorld& world) {
  if (!world.tell("fix mapping") || !reads(world, "has a fixed PDO mapping, and object 1600:")) return false;
  // Another drive, whose mapping is what is needed.
  for (const char* line : {"object 1600:00 3", "object 1600:01 0x60400010", "object 1600:02 0x607A0020",
                           "object 1600:03 0x60600008", "object 1A00:00 3", "object 1A00:01 0x60410010",
                           "object 1A00:02 0x60640020", "object 1A00:03 0x60610008", "object 1A01:00 1",
                           "object 1A01:01 0x606C0020"}) {
    if (!world.tell(line)) return false;
  }
  return comes_back(world, "a mapping that did not fit");
}

bool drive_that_is_stuck_in_a_state(DriveFaultWorld& world) {
  if (!world.tell("stick ready to switch on")) return false;
  if (!reads(world, "the drive stays 'ready to switch on' for more than 500 ms")) return false;
  if (is_enabled(world) || !world.tell("free")) return false;
  return comes_back(world, "a state that it was stuck in");
}

bool drive_that_is_switched_on_late(DriveFaultWorld& world) {
  if (!world.tell("off")) return false;
  run(world, start, std::chrono::seconds(3));
  // It is no fault that it is not there yet.
  if (world.drive().state() || !world.drive().fault().is_ok()) return false;
  if (!tells_trouble(world, "node 5 does not say boot-up") || !world.tell("on")) return false;
  return comes_back(world, "being switched on late", true) && !tells_trouble(world, "node 5");
}

bool drive_that_answers_too_late(DriveFaultWorld& world) {
  if (!world.tell("delay 700")) return false;
  run(world, start, std::chrono::seconds(4));
  if (world.drive().state() || !world.drive().fault().is_ok()) return false;
  if (!tells_trouble(world, "node 5") || !world.tell("delay 0")) return false;
  const Time begin = world.now();
  // What it had said before is still on its way.
  run(world, start, std::chrono::seconds(1));
  return is_enabled_in_time(world) && is_back_in_time("answers that came too late", world.now() - begin);
}

bool garbage_and_truncated_frames(DriveFaultWorld& world) {
  for (int i = 0; i < 5; ++i) {  // also while it is brought up
    run(world, start, std::chrono::milliseconds(30));
    if (!world.tell("garbage")) return false;
  }
  if (!moves(world)) return false;
  double before = start;
  const bool arrived = until(world, target, [&] {
    const auto state = world.drive().state();
    if (!state || !state->enabled || state->position < before || !world.tell("garbage")) return false;
    before = state->position;
    return std::abs(state->position - target) < 2e-3;
  });
  return arrived && world.drive().fault().is_ok();
}

// Of a person at the simulator.
bool lines_that_make_no_sense(DriveFaultWorld& world) {
  return says(world.ask("stick nowhere"), "no state 'nowhere'") &&
         says(world.ask("trip 99999999"), "an error code") &&
         says(world.ask("delay soon"), "a number of ms") &&
         says(world.ask("object 1018 vendor"), "written as 1018:01 0x123") &&
         says(world.ask("dance"), "unknown: 'dance'") && is_enabled_in_time(world);
}

}  // namespace

void DriveFaultWorld::configure(CanopenServoDrive::Configuration& configuration) {
  configuration.lowest = -10;
  configuration.highest = 10;
  configuration.fastest = 1;
  configuration.node = node;
  configuration.vendor = 0x123;
  configuration.product = 0x456;
  configuration.increments_per_unit = 1000;
}

int run_drive_faults(const char* where, MakeDriveFaultWorld make) {
  make_world = make;
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<cable_out_and_in_again_in_motion>),
      cmocka_unit_test(judged<adapter_gone_and_back_in_motion>),
      cmocka_unit_test(judged<bus_off_in_motion>),
      cmocka_unit_test(judged<cable_out_and_in_again_while_off>),
      cmocka_unit_test(judged<drive_that_falls_silent_in_motion>),
      cmocka_unit_test(judged<heartbeat_of_the_drive_lost>),
      cmocka_unit_test(judged<our_heartbeat_lost>),
      cmocka_unit_test(judged<drive_fault_in_motion>),
      cmocka_unit_test(judged<drive_fault_whose_cause_stays>),
      cmocka_unit_test(judged<drive_that_resets_in_motion>),
      cmocka_unit_test(judged<another_drive_than_was_declared>),
      cmocka_unit_test(judged<object_that_the_drive_refuses>),
      cmocka_unit_test(judged<fixed_mapping_that_does_not_fit>),
      cmocka_unit_test(judged<drive_that_is_stuck_in_a_state>),
      cmocka_unit_test(judged<drive_that_is_switched_on_late>),
      cmocka_unit_test(judged<drive_that_answers_too_late>),
      cmocka_unit_test(judged<garbage_and_truncated_frames>),
      cmocka_unit_test(judged<lines_that_make_no_sense>),
  };
  return cmocka_run_group_tests_name(where, tests, nullptr, nullptr);
}

}  // namespace flexrf
