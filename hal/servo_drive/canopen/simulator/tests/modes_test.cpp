// The modes of a CiA 402 drive, against the simulated drive.
#include "hal/servo_drive/canopen/simulator/tests/drive_axis.hpp"
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

// Object by object, as CiA 402 says, without the master's switch for it: points are taken at any time, and
// gone to while bit 4 of the controlword is set, each within the period (60C2) that was told.
void points_are_gone_to_while_interpolation_is_enabled(void**) {
  SimulatedCia402Drive drive{{.node = drive_node}};
  DriveObjects& objects = drive.objects();
  Time now{std::chrono::seconds(1)};
  canopen::Outbox said;
  const auto run = [&](int ms) {
    for (int i = 0; i < ms; ++i) {
      now += milliseconds(1);
      drive.advance(now, said);
      while (!said.is_empty()) said.pop();
    }
  };
  const auto send = [&](const canopen::Message& message) {
    drive.receive(message, now, said);
    while (!said.is_empty()) said.pop();
  };
  drive.power_on(now);
  run(30);
  using namespace canopen::cia402::objects;
  // RPDO 1: controlword and point, with SYNC; period 10 ms.
  objects.set({0x1400, 1}, 0x205);
  objects.set({0x1400, 2}, 1);
  objects.set({0x1600, 0}, 2);
  objects.set({0x1600, 1}, 0x60400010);
  objects.set({0x1600, 2}, 0x60C10120);
  objects.set(period_value, 10);
  objects.set(canopen::cia402::objects::mode, 7);
  send({0x000, 2, {0x01, drive_node}});
  const auto cycle_with = [&](std::uint16_t word, std::int32_t point) {
    canopen::Message message{0x205, 6, {}};
    canopen::write_number(message.data.data(), 2, word);
    canopen::write_number(message.data.data() + 2, 4, static_cast<std::uint32_t>(point));
    send(message);
    send({0x080, 0, {}});
    run(10);
    return objects.get(statusword);
  };
  for (const auto word : {std::uint16_t{0x06}, std::uint16_t{0x07}, std::uint16_t{0x0F}}) {
    for (int i = 0; i < 10; ++i) cycle_with(word, 1000);
  }
  assert_int_equal(objects.get(statusword) & 0x6F, 0x27);
  assert_int_equal(objects.get_signed(mode_display), 7);
  // Enabled, and not led: however far the point is.
  assert_int_equal(cycle_with(0x0F, 5000) & 0x1000, 0);
  run(100);
  assert_true(drive.motion().position() == 1000);
  assert_true((cycle_with(0x1F, 1100) & 0x1000) != 0);
  assert_true(drive.motion().position() == 1100);
  // In a straight line through the period.
  canopen::Message next{0x205, 6, {0x1F, 0, 0xB0, 0x04, 0, 0}};  // 1200
  send(next);
  send({0x080, 0, {}});
  run(5);
  assert_true(std::abs(drive.motion().position() - 1150) < 1e-6);
  run(5);
  assert_true(drive.motion().position() == 1200);
  // No point comes: it holds.
  run(100);
  assert_true(drive.motion().position() == 1200 && drive.motion().is_at_rest());
  assert_int_equal(cycle_with(0x0F, 1300) & 0x1000, 0);
  run(100);
  assert_true(drive.motion().position() == 1200);
  // Enabled again, it goes to the point that stands.
  assert_true((cycle_with(0x1F, 1300) & 0x1000) != 0);
  assert_true(drive.motion().position() == 1300);
  // Halt stops it, and a quick stop ends interpolation with the operation.
  cycle_with(0x11F, 9000);
  run(100);
  assert_true(drive.motion().is_at_rest() && drive.motion().position() < 2000);
  assert_int_equal(cycle_with(0x02, 9000) & 0x1000, 0);
}

void braked_cyclic_positions_come_to_rest_with_their_acceleration(void**) {
  Axis one;
  one.cyclic =
      SetPointFollower{{.lowest = -10000, .highest = 8000, .velocity = fastest, .acceleration = 50000}};
  assert_true(one.enable());
  one.cyclic.command(9000);
  one.run(1500);
  assert_true(one.bench.drive.motion().is_at_rest());
  assert_true(one.actual() == 8000);  // as far as it may
  one.cyclic.command(-5000);
  one.run(203);
  one.cyclic.brake();
  one.run(1000);
  assert_true(one.bench.drive.motion().is_at_rest());
  // 0.203 s of acceleration, and as much of braking.
  assert_true(std::abs(one.actual() - (8000 - 50000 * 0.203 * 0.203)) < 200);
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
      cmocka_unit_test(points_are_gone_to_while_interpolation_is_enabled),
      cmocka_unit_test(braked_cyclic_positions_come_to_rest_with_their_acceleration),
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
