// The pneumatic gripper on simulated chips, in virtual time: with a cylinder on its lines, and with mere
// wires.
#include "hal/gpio/chip/mock/mock_gpio_chip.hpp"
#include "hal/gpio/chip/simulated/simulated_gpio_chip.hpp"
#include "hal/gripper/pneumatic/tests/pneumatic_world.hpp"
#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"

namespace {

using namespace flexrf;

template <class Chip, bool ClosedCentre>
class VirtualWorld final : public PneumaticWorld<Chip> {
 public:
  VirtualWorld() : PneumaticWorld<Chip>(ClosedCentre) {}

 private:
  Duration pass_time() override { return std::chrono::milliseconds(2); }
  Valves valves() override { return {line("VALVE_OPEN").is_high(), line("VALVE_CLOSE").is_high()}; }
  void connect(const ReedSwitches& reeds) override {
    line("REED_OPEN").drive(reeds.open);
    line("REED_CLOSED").drive(reeds.closed);
  }
  bool is_there() override { return there_; }
  bool unplug() override {
    there_ = false;
    this->chip().driver().unplug();
    return true;
  }
  bool plug_in() override {
    there_ = true;
    this->chip().driver().plug_in();
    return true;
  }
  VirtualLine& line(const char* name) { return this->chip().driver().line(name); }

  bool there_ = true;
};

template <class World>
int run(const char* name) {
  return run_gripper_conformance(name,
                                 []() -> std::unique_ptr<GripperWorld> { return std::make_unique<World>(); });
}

// As an application's table has it, without a model of anything; with a switch that stays off, if one is
// named.
struct MereWires {
  explicit MereWires(const char* blocked = "") {
    chip.configuration().set_wires("VALVE_OPEN>REED_OPEN VALVE_CLOSE>REED_CLOSED");
    chip.configuration().wire_delay = 0.1;
    chip.configuration().set_blocked(blocked);
    gripper.configuration().travel_timeout = 0.3;
    good = chip.driver().initialise().is_ok() && gripper.driver().initialise().is_ok();
    run_for(10);
  }
  PneumaticGripper& fingers() { return gripper.driver(); }
  GripperState state() { return fingers().state().value_or(GripperState{}); }
  void run_for(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      chip.receive(std::chrono::milliseconds(1));
      gripper.receive(std::chrono::milliseconds(1));
      gripper.send();
      chip.send();
    }
  }
  /// And whether it holds something then.
  bool grips_within(int milliseconds) {
    run_for(milliseconds);
    return state().object == GripperObject::gripped;
  }

  DeviceBench<SimulatedGpioChip> chip{nullptr};
  DeviceBench<PneumaticGripper> gripper{nullptr, {}, &chip.driver()};
  bool good = false;
};

bool follows_mere_wires() {
  MereWires cell;
  for (const bool opens : {true, false, true}) {
    opens ? cell.fingers().open() : cell.fingers().close();
    if (!cell.good || !cell.state().moving) return false;
    cell.run_for(400);
    const auto& told = cell.gripper.configuration();
    const double width = opens ? told.open_width : told.closed_width;
    if (cell.state().moving || cell.state().opening != width || !cell.fingers().trouble().is_ok())
      return false;
  }
  return true;
}

// Something is in the way of the switch for closed, until it is taken away.
bool finds_an_object_on_mere_wires() {
  MereWires cell{"REED_CLOSED"};
  cell.fingers().open();
  if (!cell.good || cell.grips_within(500)) return false;
  for (int grips = 1; grips <= 2; ++grips) {
    cell.fingers().close();
    if (!cell.grips_within(500) || !cell.fingers().trouble().is_ok()) return false;
    cell.fingers().open();
    if (cell.grips_within(500)) return false;
  }
  cell.fingers().close();
  if (!cell.grips_within(500)) return false;
  cell.chip.driver().line("REED_CLOSED").block(false);
  if (cell.grips_within(500) || cell.state().object != GripperObject::lost) return false;
  return cell.gripper.feedback().grips == 3 && cell.gripper.feedback().losses == 1;
}

// The write that switches a valve off fails for a while.
bool keeps_one_valve_off_while_the_other_does_not_go_off(bool closes) {
  DeviceBench<MockGpioChip> chip(nullptr);
  DeviceBench<PneumaticGripper> gripper(nullptr, {}, &chip.driver());
  constexpr Duration cycle = std::chrono::milliseconds(1);
  constexpr int dead_cycles = 20;
  gripper.configuration().dead_time = 1e-3 * dead_cycles;
  if (!gripper.driver().initialise()) return false;
  VirtualLine& first = chip.driver().line(closes ? "VALVE_OPEN" : "VALVE_CLOSE");
  VirtualLine& second = chip.driver().line(closes ? "VALVE_CLOSE" : "VALVE_OPEN");
  bool both = false;
  const auto run_for = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      chip.receive(cycle);
      gripper.receive(cycle);
      gripper.send();
      both = both || (first.is_high() && second.is_high());
    }
  };
  const auto go = [&](bool to_closed) { to_closed ? gripper.driver().close() : gripper.driver().open(); };
  run_for(1);
  go(!closes);
  run_for(100);
  if (!first.is_high()) return false;
  first.jam(true);
  go(closes);
  run_for(200);
  if (!first.is_high() || second.is_high()) return false;
  first.jam(false);
  // From when it is off, not from when that was wanted.
  run_for(dead_cycles);
  const bool waited = !first.is_high() && !second.is_high();
  run_for(2);
  return waited && second.is_high() && !both;
}

// Who reads the log alone sees that it was away, and that it came back.
bool says_in_the_log_that_it_was_away() {
  DeviceBench<MockGpioChip> chip(nullptr);
  DeviceBench<PneumaticGripper> gripper(nullptr, {}, &chip.driver());
  if (!gripper.driver().initialise()) return false;
  const auto run_for = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      chip.receive(std::chrono::milliseconds(10));
      gripper.receive(std::chrono::milliseconds(10));
      gripper.send();
    }
  };
  const LogEar ear;
  run_for(10);
  if (ear.has_heard("is away")) return false;
  chip.driver().unplug();
  run_for(10);
  if (!ear.has_heard("the GPIO chip with its valves") || ear.has_heard("well again")) return false;
  chip.driver().plug_in();
  run_for(10);
  return ear.has_heard("well again");
}

bool tells_a_line_it_cannot_have() {
  DeviceBench<MockGpioChip> chip(nullptr);
  chip.driver().refuse(Status::error(StatusCode::not_found, "no line of this name"));
  DeviceBench<PneumaticGripper> gripper(nullptr, {}, &chip.driver());
  return gripper.driver().initialise().code() == StatusCode::not_found;
}

void wires_of_a_simulated_chip_are_enough(void**) {
  assert_true(follows_mere_wires());
}
void an_object_is_found_on_mere_wires(void**) {
  assert_true(finds_an_object_on_mere_wires());
}
void the_valves_are_never_on_together_also_when_a_write_fails(void**) {
  assert_true(keeps_one_valve_off_while_the_other_does_not_go_off(true));
  assert_true(keeps_one_valve_off_while_the_other_does_not_go_off(false));
}
void troubles_are_in_the_log(void**) {
  assert_true(says_in_the_log_that_it_was_away());
}
void a_line_it_cannot_have_is_told(void**) {
  assert_true(tells_a_line_it_cannot_have());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(wires_of_a_simulated_chip_are_enough),
      cmocka_unit_test(an_object_is_found_on_mere_wires),
      cmocka_unit_test(the_valves_are_never_on_together_also_when_a_write_fails),
      cmocka_unit_test(troubles_are_in_the_log),
      cmocka_unit_test(a_line_it_cannot_have_is_told),
  };
  return cmocka_run_group_tests_name("pneumatic gripper", tests, nullptr, nullptr) +
         run<VirtualWorld<MockGpioChip, false>>("pneumatic gripper, valve with two coils, on a mock chip") +
         run<VirtualWorld<SimulatedGpioChip, true>>(
             "pneumatic gripper, valve with a closed centre, on a simulated chip");
}
