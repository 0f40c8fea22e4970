// What goes wrong between a PC and a MELFA controller, over UDP: what the operator reads, what the arm does,
// and that it goes on when the cause is gone.
#include <cmath>
#include <cstring>

#include "hal/interfaces/device_bench.hpp"
#include "hal/linux/melfa_mxt/melfa_mxt.hpp"
#include "hal/simulated/mxt_simulator/mxt_server.hpp"
#include "runtime/realtime/realtime_scope.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"
#include "tests/melfa/melfa_world.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::melfa;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)(MelfaWorld&)>
void in_a_world(void**) {
  bool passed = false;
  {
    MelfaWorld world;
    passed = world.initialised() && world.begin_leading() && Run(world) && world.alarm().empty();
  }
  assert_true(passed);
}

JointAngles home() {
  JointAngles joints{};
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) joints[i] = six_axis.joints[i].home;
  return joints;
}
JointAngles goal() {
  JointAngles joints = home();
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
/// There in the end, without an alarm of the controller on the way.
bool arrives(MelfaWorld& world) {
  world.command(goal(), 300);
  return stands_at(world, goal()) && world.arm().fault().is_ok();
}

bool foreign_datagrams_are_dropped_and_counted(MelfaWorld& world) {
  std::uint64_t counted = 0;
  for (const Foreign kind : {Foreign::by_stranger, Foreign::too_short, Foreign::too_long,
                             Foreign::other_number, Foreign::nonsense}) {
    world.with([kind](MxtWire& wire) { wire.add_foreign(kind); });
    world.idle(2);
    if (world.feedback().foreign != ++counted || !stands_at(world, home())) return false;
  }
  return world.feedback().lost == 0 && world.feedback().late == 0 && arrives(world);
}

bool lost_answers_are_counted_and_nothing_jumps(MelfaWorld& world) {
  world.command(goal(), 20);
  world.with([](MxtWire& wire) { wire.lose_answers(3); });
  world.command(goal(), 20);
  return world.feedback().lost == 3 && world.feedback().late == 0 && arrives(world);
}

bool lost_packets_are_counted_and_nothing_jumps(MelfaWorld& world) {
  world.command(goal(), 20);
  world.with([](MxtWire& wire) { wire.lose_packets(3); });
  world.command(goal(), 20);
  return world.feedback().lost == 3 && world.feedback().late == 0 && arrives(world);
}

bool late_answers_are_counted_and_not_taken_for_new_ones(MelfaWorld& world) {
  world.command(goal(), 20);
  world.with([](MxtWire& wire) { wire.delay_answers(1); });
  world.command(goal(), 20);
  const std::uint64_t sent = world.arm().counters().sent;
  world.command(goal(), 10);
  // One packet each cycle: the late answer did not make two.
  return world.feedback().late == 1 && world.feedback().lost == 1 &&
         world.arm().counters().sent == sent + 10 && arrives(world);
}

bool a_silence_while_it_is_led_is_a_fault_until_it_is_restarted(MelfaWorld& world) {
  world.command(goal(), 20);
  world.with([](MxtWire& wire) { wire.set_silent(true); });
  world.command(goal(), 20);
  const Status fault = world.arm().fault();
  if (fault.code() != StatusCode::timeout || std::strstr(fault.cause(), "127.0.0.1") == nullptr ||
      std::strstr(fault.cause(), "cable") == nullptr || world.arm().state())
    return false;
  world.arm().set_inhibited(true);
  world.with([](MxtWire& wire) { wire.set_silent(false); });
  world.idle(40);
  // It is seen again, and does not move by itself.
  const auto rest = world.arm().state();
  if (!rest || world.arm().is_leading()) return false;
  if (!world.restart()) return false;
  world.idle(10);
  world.arm().set_inhibited(false);
  world.idle(10);
  return stands_at(world, rest->position) && arrives(world);
}

bool a_silence_while_nothing_moves_is_no_fault(MelfaWorld& world) {
  world.arm().set_inhibited(true);
  world.idle(10);
  world.with([](MxtWire& wire) { wire.set_silent(true); });
  world.idle(40);
  if (world.arm().state() || !world.arm().fault().is_ok()) return false;
  world.with([](MxtWire& wire) { wire.set_silent(false); });
  // 2 s of the driver's clock at most.
  int cycles = 0;
  while (!world.arm().state() && cycles < 285) {
    world.idle(1);
    ++cycles;
  }
  world.arm().set_inhibited(false);
  return world.arm().state() && arrives(world);
}

bool it_begins_where_the_controller_is(MelfaWorld& world) {
  world.command(goal(), 300);
  world.arm().set_inhibited(true);
  world.idle(10);
  // Another one leads it in between.
  world.with([](MxtWire& wire) {
    Packet packet;
    packet.command = commands::move;
    packet.send_content = contents::joints;
    for (int step = 0; step < 50; ++step) {
      Joints joints{};
      for (std::size_t i = 0; i < joints.size(); ++i)
        joints[i] = static_cast<float>(wire.controller().commanded()[i] - (i < 6 ? 0.01 : 0));
      packet.data[0] = words_of(joints);
      wire.controller().answer(pack(packet), 1);
    }
  });
  JointAngles elsewhere = goal();
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) elsewhere[i] -= 0.5;
  world.idle(10);
  world.arm().set_inhibited(false);
  world.idle(50);
  return stands_at(world, elsewhere) && arrives(world);
}

bool the_end_of_a_session_is_told_once(MelfaWorld& world) {
  const auto ends = [&world] { return world.with([](MxtWire& wire) { return wire.controller().ends(); }); };
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
  world.with([](MxtWire& wire) { wire.lose_packets(1); });
  world.arm().stop();
  world.await_far_end();
  return world.with([](MxtWire& wire) { return wire.controller().ends(); }) >= 1;
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
    MelfaWorld world;
    DeviceBench<MelfaMxt> bench(&six_axis);
    bench.configuration().set_address("127.0.0.1");
    bench.configuration().local_port = world.port();  // the controller's
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

}  // namespace

int main() {
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
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
