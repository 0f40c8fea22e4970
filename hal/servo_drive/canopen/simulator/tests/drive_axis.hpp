// One axis of the simulated drive with what a driver does in each cycle of 7 ms: a controlword, set-points,
// SYNC.
#pragma once

#include <cmath>

#include "hal/canopen/drive_modes.hpp"
#include "hal/servo_drive/canopen/simulator/tests/drive_bench.hpp"
#include "motion/set_point_follower.hpp"

namespace flexrf {

using canopen::cia402::DrivePower;
using canopen::cia402::HomingRun;
using canopen::cia402::Mode;
using canopen::cia402::SetPointHandshake;

inline constexpr double fastest = 20000;  // increments/s that the master commands
inline constexpr Duration cycle = milliseconds(cycle_ms);

struct Axis {
  explicit Axis(Mode with = Mode::cyclic_position) : mode{with} {
    bench.drive.power_on(bench.now());
    bench.begin();
    came_up = bench.run_until_operational(500);
    power.begin({});
    for (int i = 0; i < 3; ++i) step();
  }

  void step() {
    std::uint64_t read[3] = {};
    if (unpack(state_pdo(), bench.last_state_pdo, read)) {
      status = static_cast<std::uint16_t>(read[0]);
      moved = std::abs(static_cast<double>(canopen::with_sign(read[1], 32)) - position);
      position = static_cast<double>(canopen::with_sign(read[1], 32));
    }
    std::uint16_t word = power.advance(status, moved == 0, bench.now());
    if (power.was_just_enabled()) {
      cyclic.seed(position);
      handshake.reset(static_cast<std::int32_t>(position));
    }
    double target = position;
    if (power.is_enabled()) {
      if (mode == Mode::cyclic_position) target = cyclic.next(seconds(cycle));
      if (mode == Mode::profile_position) {
        word |= handshake.advance(status, bench.now());
        target = handshake.target();
      }
      if (mode == Mode::homing) word |= homing.advance(status, true, true, bench.now());
    }
    if (halts) word |= canopen::cia402::control_bit::halt;
    const std::uint64_t values[] = {word, static_cast<std::uint64_t>(std::llround(target)),
                                    static_cast<std::uint64_t>(mode)};
    bench.send(pack(command_pdo(), values));
    const std::uint64_t velocities[] = {
        static_cast<std::uint64_t>(std::llround(power.is_enabled() ? velocity : 0))};
    bench.send(pack(velocity_pdo(), velocities));
    bench.send({canopen::sync_identifier, 0, {}});
    bench.run(cycle_ms);
  }
  void run(int ms) {
    for (int i = 0; i < ms; i += cycle_ms) step();
  }
  bool enable() {
    power.pursue(DrivePower::Goal::enabled);
    for (int i = 0; i < 300 && power.problem().is_ok() && !power.is_enabled(); ++i) step();
    return power.is_enabled();
  }
  bool switch_off() {
    power.pursue(DrivePower::Goal::off);
    for (int i = 0; i < 1000 && power.problem().is_ok() && !power.is_off(); ++i) step();
    return power.is_off();
  }
  double actual() const { return bench.drive.motion().position(); }

  DriveBench bench;
  Mode mode;
  DrivePower power;
  SetPointFollower cyclic{{.velocity = fastest, .acceleration = 1e6}};
  SetPointHandshake handshake{milliseconds(500)};
  HomingRun homing{std::chrono::seconds(20), milliseconds(50), true};
  double velocity = 0;
  bool halts = false;
  bool came_up = false;
  std::uint16_t status = 0;
  double position = 0;
  double moved = 0;
};

}  // namespace flexrf
