// Whatever fails in a drive or on its bus, in whatever order: one that counts as off has no torque and
// stands, and stays so until it may move again.
#include <array>
#include <span>

#include "hal/servo_drive/canopen/simulator/tests/axis_cell.hpp"
#include "tests/cmocka.hpp"
#include "tests/event_orders.hpp"

namespace flexrf {
namespace {

enum class Fault : std::uint8_t {
  heartbeat_lost,
  state_lost,       // TPDO 1 does not arrive
  motion_lost,      // TPDO 2 likewise
  pdos_not_in_use,  // in either direction
  cable_out,
  sync_lost,
  stuck_enabled,
  stuck_in_quick_stop,
  stuck_off,
  trips,
  trips_for_good,
  resets,
  power_off,
  power_on,
  motor_cut,
  mode_ignored,
  all_well,
  stopped,
  started,
  count
};
constexpr std::array<const char*, events_of<Fault>> names{
    "heartbeat lost", "TPDO 1 lost", "TPDO 2 lost",    "PDOs not in use",
    "cable out",      "SYNC lost",   "stuck enabled",  "stuck in quick stop",
    "stuck off",      "trips",       "trips for good", "resets",
    "power off",      "power on",    "motor cut",      "mode ignored",
    "all well",       "stopped",     "started"};

constexpr int between = 100;  // ms

class FaultyCell {
 public:
  explicit FaultyCell(Mode mode) : cell_(with(mode)) {
    assert_true(cell_.run_until_enabled());
    if (mode == Mode::cyclic_position) cell_.position = 9;
    if (mode == Mode::profile_position) cell_.axis.move_to(9, 2);
    if (mode == Mode::cyclic_velocity || mode == Mode::profile_velocity) cell_.velocity = 2;
    run(500);
  }

  void happens(Fault fault) {
    SimulatedCia402Drive& drive = cell_.drive;
    switch (fault) {
      case Fault::heartbeat_lost:
        drive.silence_heartbeat(true);
        break;
      case Fault::state_lost:
        cell_.lost = canopen::transmit_pdo_identifier(1, node);
        break;
      case Fault::motion_lost:
        cell_.lost = canopen::transmit_pdo_identifier(2, node);
        break;
      case Fault::pdos_not_in_use:
        use_pdos(false);
        break;
      case Fault::cable_out:
        cell_.cable = false;
        break;
      case Fault::sync_lost:
        cell_.syncs = false;
        break;
      case Fault::stuck_enabled:
        drive.stick_in(DriveState::operation_enabled);
        break;
      case Fault::stuck_in_quick_stop:
        drive.stick_in(DriveState::quick_stop_active);
        break;
      case Fault::stuck_off:
        drive.stick_in(DriveState::switch_on_disabled);
        break;
      case Fault::trips:
      case Fault::trips_for_good:
        drive.trip(0x2310, fault == Fault::trips_for_good, cell_.heard);
        break;
      case Fault::resets:
        drive.reset_itself(cell_.now);
        break;
      case Fault::power_off:
        drive.power_off();
        break;
      case Fault::power_on:
        drive.power_on(cell_.now);
        break;
      case Fault::motor_cut:
        drive.cut_motor(true);
        break;
      case Fault::mode_ignored:
        drive.ignore_mode(true);
        break;
      case Fault::all_well:
        heal();
        break;
      case Fault::stopped:
        cell_.may_move = false;
        break;
      default:
        cell_.axis.forget_fault();
        cell_.may_move = true;
        break;
    }
    run(between);
  }
  /// It is to be safe; false: it said so and was not.
  bool is_made_safe_rightly() {
    cell_.may_move = false;
    run(3000);
    was_safe_ = cell_.axis.is_off();
    return !lied_;
  }
  bool was_safe() const { return was_safe_; }

 private:
  static AxisPlan with(Mode mode) {
    AxisPlan result = plan();
    result.mode = mode;
    return result;
  }
  void use_pdos(bool on) {
    constexpr std::uint16_t pdos[] = {0x1400, 0x1401, 0x1800, 0x1801};
    constexpr std::uint64_t not_in_use = 0x80000000;
    for (const std::uint16_t index : pdos) {
      const std::uint64_t identifier = cell_.drive.objects().get({index, 1});
      cell_.drive.objects().set(
          {index, 1}, static_cast<std::int64_t>(on ? identifier & ~not_in_use : identifier | not_in_use));
    }
  }
  void heal() {
    cell_.drive.silence_heartbeat(false);
    cell_.drive.stick_in(std::nullopt);
    cell_.drive.cut_motor(false);
    cell_.drive.ignore_mode(false);
    cell_.drive.heal();
    cell_.lost.reset();
    cell_.cable = cell_.syncs = true;
    use_pdos(true);
  }
  void run(int ms) {
    for (int i = 0; i < ms; i += 7) {
      cell_.step();
      const bool moves = cell_.drive.motion().velocity() != 0;
      lied_ = lied_ || (!cell_.may_move && cell_.axis.is_off() && moves);
    }
  }

  Cell cell_;
  bool lied_ = false;
  bool was_safe_ = false;
};

template <Mode Of>
void what_counts_as_off_stands(void**) {
  const bool held = hold_in_orders<Fault, 2, 3>(names, 300, 5000, [](std::span<const Fault> order) {
    FaultyCell cell(Of);
    for (const Fault fault : order) cell.happens(fault);
    const bool rightly = cell.is_made_safe_rightly();
    return OrderOutcome{rightly ? nullptr : "it counted as off and moved", cell.was_safe() ? 1 : 0};
  });
  assert_true(held);
}

}  // namespace
}  // namespace flexrf

int main() {
  using flexrf::Mode;
  using flexrf::what_counts_as_off_stands;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_counts_as_off_stands<Mode::cyclic_position>),
      cmocka_unit_test(what_counts_as_off_stands<Mode::cyclic_velocity>),
      cmocka_unit_test(what_counts_as_off_stands<Mode::profile_position>),
      cmocka_unit_test(what_counts_as_off_stands<Mode::profile_velocity>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
