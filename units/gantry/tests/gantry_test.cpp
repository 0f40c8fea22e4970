// A gantry on two mock drives: what it follows, and how old what it tells is.
#include "units/gantry/gantry.hpp"

#include <cmath>
#include <cstring>

#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/mock/mock_servo_drive.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace flexrf::gantry_test {
namespace {

using namespace flexrf::user;

constexpr Duration cycle = std::chrono::milliseconds(2);

struct World {
  DeviceBench<MockServoDrive> x{nullptr};
  DeviceBench<MockServoDrive> z{nullptr};
  UnitBench<Gantry> bench;
  SlotBench<GantryOrder> order;
  SlotBench<GantryState> state;
  InputBinding inputs[1] = {order.input(std::chrono::milliseconds(500))};
  SlotControl* outputs[1] = {&state.control()};
  Device* x_device = &x.driver();
  Device* z_device = &z.driver();
  Device* const* devices[2] = {&x_device, &z_device};
  GantryOrder wanted{};

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.devices = devices;
    bench.unit().connect(binding);
    x.configuration().homing_method = z.configuration().homing_method = 35;  // at home where it is
    assert_true(x.driver().initialise().is_ok() && z.driver().initialise().is_ok());
    assert_true(bench.unit().initialise().is_ok());
  }
  /// The order is published in each cycle, as a sequence does, unless `publishes` is false.
  void run(int cycles, bool publishes = true) {
    for (int n = 0; n < cycles; ++n) {
      x.receive(cycle);
      z.receive(cycle);
      if (publishes) order.publish(wanted, bench.now());
      bench.step(cycle);
      x.send();
      z.send();
    }
  }
  void say(GantryCommand command, double to = 0) {
    ++wanted.number;
    wanted.command = command;
    wanted.point = {to, to};
    wanted.speed = 1;
  }
  void permit(bool on) {
    bench.tick().motion_inhibited = !on;
    if (on) bench.tick().permitted_since = bench.now() + std::chrono::microseconds(1);
    x.driver().set_inhibited(!on);
    z.driver().set_inhibited(!on);
  }
  void home() {
    run(3);  // the drives enable themselves
    say(GantryCommand::home);
    run(200);
    assert_int_equal(told().outcome, GantryOutcome::done);
  }
  GantryState told() {
    const auto now = state.latest();
    assert_true(now.has_value());
    return *now;
  }
  bool is_at(double position) {
    return std::abs(told().position[0] - position) < 1e-6 && std::abs(told().position[1] - position) < 1e-6;
  }
};

void goes_where_it_is_ordered(void**) {
  World world;
  world.home();
  world.say(GantryCommand::move, 0.1);
  world.run(10);
  assert_int_equal(world.told().outcome, GantryOutcome::busy);
  world.run(1000);
  assert_int_equal(world.told().outcome, GantryOutcome::done);
  assert_true(world.is_at(0.1));
}

/// Given while nothing may move, and so shortly before the Start that the gantry had no cycle between them.
// [stop-96]
void an_order_from_before_the_start_is_not_followed(void**) {
  World world;
  world.home();
  for (const int cycles_between : {3, 0}) {
    world.permit(false);
    world.run(3);
    world.say(GantryCommand::move, 0.1);
    world.order.publish(world.wanted, world.bench.now());
    world.run(cycles_between, false);
    world.permit(true);
    world.run(500);
    assert_true(world.is_at(0));
    assert_int_equal(world.told().order, world.wanted.number);
    assert_int_equal(world.told().outcome, GantryOutcome::failed);
  }
  world.say(GantryCommand::move, 0.1);
  world.run(1000);
  assert_true(world.is_at(0.1));
}

/// Without a step between them, as its thread sees them.
void a_stop_and_start_in_motion_leave_it_where_it_is(void**) {
  World world;
  world.home();
  world.say(GantryCommand::move, 0.2);
  world.run(100);
  world.permit(false);
  world.run(1);
  const double stopped = world.told().position[0];
  assert_true(stopped > 0.001 && stopped < 0.199);
  world.permit(true);
  world.run(1000);
  assert_true(world.is_at(stopped));
  assert_int_equal(world.told().outcome, GantryOutcome::failed);
}

void its_state_is_as_old_as_what_the_drives_told(void**) {
  World world;
  world.run(5);
  world.told();
  assert_true(world.state.sampled_at() == world.bench.now());
  world.z.driver().set_delay(std::chrono::milliseconds(14));
  world.run(20);
  world.told();
  assert_true(world.state.sampled_at() == world.bench.now() - std::chrono::milliseconds(14));
  world.x.driver().set_state(std::nullopt);
  world.run(1);
  assert_false(world.told().known);
  assert_non_null(std::strstr(world.told().trouble.data(), "says nothing"));
  assert_true(world.state.sampled_at() == world.bench.now());
}

}  // namespace
}  // namespace flexrf::gantry_test

int main() {
  using namespace flexrf::gantry_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(goes_where_it_is_ordered),
      cmocka_unit_test(an_order_from_before_the_start_is_not_followed),
      cmocka_unit_test(a_stop_and_start_in_motion_leave_it_where_it_is),
      cmocka_unit_test(its_state_is_as_old_as_what_the_drives_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
