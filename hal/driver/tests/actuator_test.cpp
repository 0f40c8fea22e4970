// The guard of what moves something: whatever its driver does, a command is taken and leaves only while it
// may act.
// [stop-88]
#include "hal/driver/actuator.hpp"

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

class LampInterface : public Device {
 public:
  const ComponentType& component_type() const noexcept override { return type_; }
  ParameterMemory parameter_memory() noexcept override { return {}; }
  void connect(const DeviceBinding& /*binding*/) noexcept override {}

 private:
  static constexpr ComponentType type_{};
};

class Lamp : public Actuator<LampInterface> {
 public:
  void command(bool on) noexcept {
    if (may_act()) set(on);
  }

 private:
  virtual void set(bool on) noexcept = 0;
};

/// Sends what it was told; it knows nothing of inhibition, faults and safe states.
class CarelessLamp final : public Lamp {
 public:
  bool is_on() const { return on_; }
  int commands() const { return commands_; }
  bool was_told_to_act_last() const { return acted_; }
  void break_down() { set_fault(Status::error(StatusCode::device_fault, "its bulb broke")); }
  void repair() { clear_fault(); }

 private:
  void set(bool on) noexcept override {
    wanted_ = on;
    ++commands_;
  }
  void forget() noexcept override { wanted_ = false; }
  void act(const Tick& /*tick*/) noexcept override {
    on_ = wanted_;
    acted_ = true;
  }
  void rest(const Tick& /*tick*/) noexcept override {
    on_ = wanted_;
    acted_ = false;
  }
  bool become_safe() noexcept override {
    on_ = wanted_ = false;
    return true;
  }

  bool wanted_ = false;
  bool on_ = false;
  bool acted_ = false;
  int commands_ = 0;
};

constexpr Tick tick{};

void cycle(CarelessLamp& lamp, bool command) {
  lamp.receive(tick);
  lamp.command(command);
  lamp.send(tick);
}

struct LitLamp {
  CarelessLamp lamp;
  LitLamp() {
    lamp.set_inhibited(false);
    cycle(lamp, true);
  }
};

void a_command_is_taken_while_it_may_act(void**) {
  LitLamp lit;
  assert_true(lit.lamp.is_on() && lit.lamp.was_told_to_act_last());
}

void from_its_construction_on_it_may_not(void**) {
  CarelessLamp lamp;
  cycle(lamp, true);
  assert_int_equal(lamp.commands(), 0);
  assert_false(lamp.is_on() || lamp.was_told_to_act_last());
}

void inhibited_it_hears_no_command_and_rests(void**) {
  LitLamp lit;
  lit.lamp.set_inhibited(true);
  cycle(lit.lamp, true);
  assert_int_equal(lit.lamp.commands(), 1);
  assert_false(lit.lamp.is_on() || lit.lamp.was_told_to_act_last());
}

void what_an_inhibition_overtook_does_not_leave(void**) {
  LitLamp lit;
  cycle(lit.lamp, false);
  lit.lamp.receive(tick);
  lit.lamp.command(true);
  lit.lamp.set_inhibited(true);
  lit.lamp.send(tick);
  assert_false(lit.lamp.is_on());
  // Nor later.
  lit.lamp.set_inhibited(false);
  lit.lamp.receive(tick);
  lit.lamp.send(tick);
  assert_false(lit.lamp.is_on());
}

void in_fault_it_hears_no_command_and_rests(void**) {
  LitLamp lit;
  lit.lamp.break_down();
  cycle(lit.lamp, true);
  assert_int_equal(lit.lamp.commands(), 1);
  assert_false(lit.lamp.is_on() || lit.lamp.was_told_to_act_last());
  lit.lamp.repair();
  cycle(lit.lamp, true);
  assert_true(lit.lamp.is_on());
}

void made_safe_it_waits_for_another_permission(void**) {
  LitLamp lit;
  assert_true(lit.lamp.make_safe());
  cycle(lit.lamp, true);
  cycle(lit.lamp, true);
  assert_int_equal(lit.lamp.commands(), 1);
  assert_false(lit.lamp.is_on() || lit.lamp.was_told_to_act_last());
  lit.lamp.set_inhibited(true);
  cycle(lit.lamp, true);
  lit.lamp.set_inhibited(false);
  cycle(lit.lamp, true);
  assert_true(lit.lamp.is_on());
}

void a_permission_that_it_did_not_see_withdrawn_is_none(void**) {
  LitLamp lit;
  lit.lamp.make_safe();
  // Between two cycles: what could have been sent in between was not.
  lit.lamp.set_inhibited(true);
  lit.lamp.set_inhibited(false);
  cycle(lit.lamp, true);
  assert_false(lit.lamp.is_on());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_command_is_taken_while_it_may_act),
      cmocka_unit_test(from_its_construction_on_it_may_not),
      cmocka_unit_test(inhibited_it_hears_no_command_and_rests),
      cmocka_unit_test(what_an_inhibition_overtook_does_not_leave),
      cmocka_unit_test(in_fault_it_hears_no_command_and_rests),
      cmocka_unit_test(made_safe_it_waits_for_another_permission),
      cmocka_unit_test(a_permission_that_it_did_not_see_withdrawn_is_none),
  };
  return cmocka_run_group_tests_name("actuator", tests, nullptr, nullptr);
}
