#include "units/fence/fence.hpp"

#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

struct World {
  UnitBench<Fence> bench;
  SlotBench<Pose> wanted;
  SlotBench<Pose> allowed;
  InputBinding inputs[1] = {wanted.input()};
  SlotControl* outputs[1] = {&allowed.control()};

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    bench.unit().connect(binding);
    bench.runtime().lowest = 0.3;
  }

  /// The height that is let through for a wanted one.
  double height_for(double height) {
    Pose pose{};
    pose.position = {0.5, -0.25, height};
    wanted.publish(pose, bench.now());
    bench.step(std::chrono::milliseconds(1));
    const auto through = allowed.latest();
    return through && through->position[0] == 0.5 && through->position[1] == -0.25 ? through->position[2]
                                                                                   : -1;
  }
};

bool lifts_what_is_below() {
  World world;
  return world.height_for(0.1) == 0.3 && world.bench.feedback().lifted;
}

bool lets_through_what_is_above() {
  World world;
  return world.height_for(0.4) == 0.4 && !world.bench.feedback().lifted;
}

bool publishes_nothing_without_a_target() {
  World world;
  world.bench.step(std::chrono::milliseconds(1));
  return world.allowed.control().published() == 0;
}

void below(void**) {
  assert_true(lifts_what_is_below());
}
void above(void**) {
  assert_true(lets_through_what_is_above());
}
void without(void**) {
  assert_true(publishes_nothing_without_a_target());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(below), cmocka_unit_test(above), cmocka_unit_test(without)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
