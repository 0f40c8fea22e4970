// The modes of a CiA 402 drive, against the simulated drive.
#include "hal/simulated/simulated_cia402_drive/tests/drive_axis.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

namespace status_bit = canopen::cia402::status_bit;

void cyclic_positions_are_followed_without_a_jump(void**) {
  Axis one;
  assert_true(one.enable());
  one.cyclic.command(9000);
  one.run(1000);
  assert_true(one.actual() == 9000);
  // In a cycle the master goes 140; the set-point of a cycle acts one SYNC later.
  assert_true(one.bench.drive.longest_jump() <= fastest * 0.007 * 2);
  assert_true((one.status & status_bit::follows) != 0);
  assert_true((one.status & status_bit::internal_limit) == 0);
}

void a_halt_of_cyclic_positions_takes_its_deceleration(void**) {
  Axis one;
  assert_true(one.enable());
  one.cyclic.command(9000);
  one.run(203);  // 29 cycles of 140
  one.cyclic.halt(50000, -10000, 8000);
  one.run(1000);
  assert_true(one.bench.drive.motion().is_at_rest());
  assert_true(one.actual() == 8000);  // as far as it may
  one.cyclic.command(-5000);
  one.run(203);
  one.cyclic.halt(50000, -10000, 8000);
  one.run(1000);
  // From 20000/s, over 4000.
  assert_true(std::abs(one.actual() - (8000 - 29 * 140 - 4000)) < 200);
}

void an_internal_limit_is_shown(void**) {
  Axis one(Mode::cyclic_velocity);
  assert_true(one.enable());
  one.velocity = 80000;
  one.run(1500);
  assert_true((one.status & status_bit::internal_limit) != 0);
  assert_true(one.bench.drive.motion().velocity() == 50000);
}

void cyclic_velocities_are_followed(void**) {
  Axis one(Mode::cyclic_velocity);
  assert_true(one.enable());
  one.run(100);
  assert_true(one.actual() == 1000);
  one.velocity = -3000;
  one.run(500);
  assert_true(one.bench.drive.motion().velocity() == -3000);
  one.velocity = 0;
  one.run(500);
  assert_true(one.bench.drive.motion().is_at_rest());
  assert_true(one.actual() < -400);
}

void profile_positions_are_handed_over_one_by_one(void**) {
  Axis one(Mode::profile_position);
  assert_true(one.enable());
  one.run(100);
  assert_true(one.actual() == 1000);
  for (const std::int32_t target : {5000, 2000, 2000}) {
    one.handshake.command(target, fastest);
    assert_false(one.handshake.is_reached(one.status));
    int cycles = 0;
    while (!one.handshake.is_reached(one.status) && cycles++ < 1000) one.step();
    assert_true(one.actual() == target);
  }
  assert_true(one.handshake.problem().is_ok());
}

void a_halt_interrupts_a_profile_and_lets_it_go_on(void**) {
  Axis one(Mode::profile_position);
  assert_true(one.enable());
  one.handshake.command(20000, fastest);
  one.run(500);
  one.halts = true;
  one.run(500);
  const double rest = one.actual();
  assert_true(rest > 1000 && rest < 20000 && one.bench.drive.motion().is_at_rest());
  one.run(100);
  assert_true(one.actual() == rest);
  one.halts = false;
  one.run(4000);
  assert_true(one.actual() == 20000);
}

std::int64_t torque_of(Axis& one) {
  return one.bench.drive.objects().get_signed(canopen::cia402::objects::actual_torque);
}

void a_blocked_axis_presses_and_is_not_where_it_was_sent(void**) {
  Axis one(Mode::profile_position);
  assert_true(one.enable());
  one.bench.drive.objects().set(canopen::cia402::objects::most_torque, 300);
  one.bench.drive.block(400, std::nullopt);
  one.handshake.command(-2000, fastest);
  one.run(2000);
  assert_true(one.actual() == 400 && one.bench.drive.motion().is_at_rest());
  assert_false(one.handshake.is_reached(one.status));
  assert_true(torque_of(one) == -300);
  one.bench.drive.block(std::nullopt, 5000);  // what it pressed against is gone: it goes on
  one.run(2000);
  assert_true(one.actual() == -2000 && one.handshake.is_reached(one.status) && torque_of(one) == 0);
  one.handshake.command(9000, fastest);
  one.run(2000);
  assert_true(one.actual() == 5000 && torque_of(one) == 300);
}

void an_axis_without_its_motor_stays_and_has_no_torque(void**) {
  Axis one(Mode::profile_position);
  assert_true(one.enable());
  one.bench.drive.cut_motor(true);
  one.handshake.command(9000, fastest);
  one.run(2000);
  assert_true(one.actual() == 1000 && torque_of(one) == 0);
  assert_false(one.handshake.is_reached(one.status));
  one.bench.drive.cut_motor(false);
  one.run(2000);
  assert_true(one.actual() == 9000);
}

void profile_velocities_are_reached(void**) {
  Axis one(Mode::profile_velocity);
  assert_true(one.enable());
  one.run(50);
  assert_true((one.status & status_bit::speed_is_zero) != 0);
  one.velocity = 4000;
  one.run(500);
  assert_true((one.status & status_bit::target_reached) != 0);
  assert_true((one.status & status_bit::speed_is_zero) == 0);
  assert_true(one.bench.drive.motion().velocity() == 4000);
}

void homing_runs_to_its_end(void**) {
  Axis one(Mode::homing);
  assert_true(one.enable());
  for (int run = 0; run < 2; ++run) {
    one.homing.start();
    int cycles = 0;
    while (one.homing.state() == HomingRun::State::running && cycles++ < 1000) one.step();
    assert_true(one.homing.state() == HomingRun::State::done);
    assert_true(one.actual() == 0);
  }
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(cyclic_positions_are_followed_without_a_jump),
      cmocka_unit_test(a_halt_of_cyclic_positions_takes_its_deceleration),
      cmocka_unit_test(an_internal_limit_is_shown),
      cmocka_unit_test(cyclic_velocities_are_followed),
      cmocka_unit_test(profile_positions_are_handed_over_one_by_one),
      cmocka_unit_test(a_halt_interrupts_a_profile_and_lets_it_go_on),
      cmocka_unit_test(a_blocked_axis_presses_and_is_not_where_it_was_sent),
      cmocka_unit_test(an_axis_without_its_motor_stays_and_has_no_torque),
      cmocka_unit_test(profile_velocities_are_reached),
      cmocka_unit_test(homing_runs_to_its_end),
  };
  return cmocka_run_group_tests_name("cia402 modes", tests, nullptr, nullptr);
}
