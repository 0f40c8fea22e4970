#include "hal/robot_arm/melfa_mxt/tests/melfa_faults.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include "runtime/realtime/realtime_scope.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr Duration longest_recovery = std::chrono::seconds(2);

MakeMelfaWorld make_world = nullptr;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)(MelfaWorld&)>
void in_a_world(void**) {
  bool passed = false;
  {
    const auto world = make_world();
    passed = world->initialised() && world->begin_leading() && Run(*world) && world->ask("alarm") == "none";
  }
  assert_true(passed);
}

JointAngles goal() {
  JointAngles joints = melfa_home();
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) joints[i] += 0.2;
  return joints;
}
bool stands_at(MelfaWorld& world, const JointAngles& where) {
  const auto state = world.arm().state();
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
    if (!state || std::abs(state->position[i] - where[i]) > 1e-4) return false;
  }
  return true;
}

bool foreign_datagrams_are_dropped_and_counted(MelfaWorld& world) {
  std::uint64_t counted = 0;
  for (const char* kind : {"stranger", "short", "long", "number", "nonsense"}) {
    if (!world.tell(std::string{"foreign "} + kind)) return false;
    world.idle(2);
    if (world.feedback().foreign != ++counted || !stands_at(world, melfa_home())) return false;
  }
  return world.feedback().lost == 0 && world.feedback().late == 0 && arrives(world);
}

bool lost_answers_are_counted_and_nothing_jumps(MelfaWorld& world) {
  world.command(goal(), 20);
  if (!world.tell("drop 3")) return false;
  world.command(goal(), 20);
  return world.feedback().lost == 3 && world.feedback().late == 0 && arrives(world);
}

bool lost_packets_are_counted_and_nothing_jumps(MelfaWorld& world) {
  world.command(goal(), 20);
  if (!world.tell("lose 3")) return false;
  world.command(goal(), 20);
  return world.feedback().lost == 3 && world.feedback().late == 0 && arrives(world);
}

bool late_answers_are_counted_and_not_taken_for_new_ones(MelfaWorld& world) {
  world.command(goal(), 20);
  if (!world.tell("delay 1")) return false;
  world.command(goal(), 20);
  const std::uint64_t sent = world.arm().counters().sent;
  world.command(goal(), 10);
  // One packet each cycle: the late answer did not make two.
  return world.feedback().late == 1 && world.feedback().lost == 1 &&
         world.arm().counters().sent == sent + 10 && arrives(world);
}

bool a_silence_while_it_is_led_is_a_fault_until_it_is_restarted(MelfaWorld& world) {
  world.command(goal(), 20);
  if (!world.tell("silence")) return false;
  world.command(goal(), 20);
  if (!has_fault_of_silence(world)) return false;
  world.arm().set_inhibited(true);
  if (!world.tell("well")) return false;
  world.idle(40);
  // It is seen again, and does not move by itself.
  const auto rest = world.arm().state();
  if (!rest || world.arm().is_ready()) return false;
  if (!world.restart()) return false;
  world.idle(10);
  world.arm().set_inhibited(false);
  world.idle(10);
  return stands_at(world, rest->position) && arrives(world);
}

bool a_silence_while_nothing_moves_is_no_fault(MelfaWorld& world) {
  world.arm().set_inhibited(true);
  world.idle(10);
  if (!world.tell("silence")) return false;
  world.idle(40);
  if (world.arm().state() || !world.arm().fault().is_ok()) return false;
  if (!world.tell("well")) return false;
  const Time since = world.now();
  while (!world.arm().state() && world.now() - since < longest_recovery) world.idle(1);
  world.arm().set_inhibited(false);
  return world.arm().state() && arrives(world);
}

bool it_begins_where_the_controller_is(MelfaWorld& world) {
  world.command(goal(), 300);
  world.arm().set_inhibited(true);
  world.idle(10);
  // Another one leads it in between.
  if (!world.tell("led -0.5")) return false;
  JointAngles elsewhere = goal();
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) elsewhere[i] -= 0.5;
  world.idle(10);
  world.arm().set_inhibited(false);
  world.idle(50);
  return stands_at(world, elsewhere) && arrives(world);
}

bool the_end_of_a_session_is_told_once(MelfaWorld& world) {
  const auto ends = [&world] { return std::atoi(world.ask("ends").c_str()); };
  world.command(goal(), 20);
  int cycles = 0;
  while (!world.arm().make_safe() && cycles < 300) {
    world.idle(1);
    ++cycles;
  }
  // At rest before the end: it is on its way to nowhere.
  const auto rest = world.arm().state();
  if (ends() != 1 || !rest) return false;
  world.idle(20);
  world.arm().set_inhibited(true);
  world.idle(20);
  if (ends() != 1 || !stands_at(world, rest->position)) return false;
  world.arm().set_inhibited(false);
  if (!world.begin_leading() || !arrives(world)) return false;
  return world.restart() && ends() >= 2;
}

bool an_end_that_is_lost_is_told_again(MelfaWorld& world) {
  world.idle(5);
  world.receive();
  if (!world.tell("lose 1")) return false;
  world.arm().stop();
  world.await_far_end();
  return std::atoi(world.ask("ends").c_str()) >= 1;
}

bool a_cycle_allocates_nothing(MelfaWorld& world) {
  AllocationCounter allocations{0};
  {
    const RealtimeScope scope(allocations);
    world.command(goal(), 300);
  }
  return allocations == 0 && stands_at(world, goal());
}

void an_address_that_is_none_is_refused(void**) {
  Status status;
  {
    DeviceBench<MelfaMxt> bench(&six_axis);
    bench.configuration().set_address("robot");
    status = bench.driver().initialise();
  }
  assert_true(status.code() == StatusCode::invalid_argument);
  assert_non_null(std::strstr(status.cause(), "192.168."));
}

void a_port_of_another_program_is_refused(void**) {
  Status status;
  {
    const auto world = make_world();
    DeviceBench<MelfaMxt> bench(&six_axis);
    bench.configuration().set_address("127.0.0.1");
    bench.configuration().local_port = world->port();  // the controller's
    status = bench.driver().initialise();
  }
  assert_true(status.code() == StatusCode::unavailable);
  assert_non_null(std::strstr(status.cause(), "another program"));
}

void an_answer_time_beyond_the_silence_is_refused(void**) {
  Status status;
  {
    DeviceBench<MelfaMxt> bench(&six_axis);
    bench.configuration().answer_timeout = 0.1;
    bench.configuration().silence_limit = 0.1;
    status = bench.driver().initialise();
  }
  assert_true(status.code() == StatusCode::invalid_argument);
  assert_non_null(std::strstr(status.cause(), "silence_limit"));
}

void an_answer_time_within_a_cycle_is_refused(void**) {
  Status status;
  {
    DeviceBench<MelfaMxt> bench(&six_axis);
    bench.configuration().cycle = 0.02;
    status = bench.driver().initialise();
  }
  assert_true(status.code() == StatusCode::invalid_argument);
  assert_non_null(std::strstr(status.cause(),
                              "answer_timeout (0.012 s) has to be longer than the controller's"
                              " cycle (0.02 s)"));
}

}  // namespace

bool arrives(MelfaWorld& world) {
  world.command(goal(), 300);
  return stands_at(world, goal()) && world.arm().fault().is_ok();
}

bool has_fault_of_silence(MelfaWorld& world) {
  const Status& fault = world.arm().fault();
  return fault.code() == StatusCode::timeout && std::strstr(fault.cause(), "127.0.0.1") != nullptr &&
         std::strstr(fault.cause(), "cable") != nullptr && !world.arm().state();
}

int run_melfa_faults(const char* where, MakeMelfaWorld make) {
  make_world = make;
  const CMUnitTest tests[] = {
      cmocka_unit_test(in_a_world<foreign_datagrams_are_dropped_and_counted>),
      cmocka_unit_test(in_a_world<lost_answers_are_counted_and_nothing_jumps>),
      cmocka_unit_test(in_a_world<lost_packets_are_counted_and_nothing_jumps>),
      cmocka_unit_test(in_a_world<late_answers_are_counted_and_not_taken_for_new_ones>),
      cmocka_unit_test(in_a_world<a_silence_while_it_is_led_is_a_fault_until_it_is_restarted>),
      cmocka_unit_test(in_a_world<a_silence_while_nothing_moves_is_no_fault>),
      cmocka_unit_test(in_a_world<it_begins_where_the_controller_is>),
      cmocka_unit_test(in_a_world<the_end_of_a_session_is_told_once>),
      cmocka_unit_test(in_a_world<an_end_that_is_lost_is_told_again>),
      cmocka_unit_test(in_a_world<a_cycle_allocates_nothing>),
      cmocka_unit_test(an_address_that_is_none_is_refused),
      cmocka_unit_test(a_port_of_another_program_is_refused),
      cmocka_unit_test(an_answer_time_beyond_the_silence_is_refused),
      cmocka_unit_test(an_answer_time_within_a_cycle_is_refused),
  };
  return cmocka_run_group_tests_name(where, tests, nullptr, nullptr);
}

}  // namespace flexrf
