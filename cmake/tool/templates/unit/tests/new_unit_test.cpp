#include "units/new_unit/new_unit.hpp"

#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;
using TestedUnit = flexrf::user::NewUnit;

struct World {
  UnitBench<TestedUnit> bench;
  SlotBench<Pose> wanted;
  SlotBench<Pose> raised;
  InputBinding inputs[1] = {wanted.input(std::chrono::milliseconds(500))};
  SlotControl* outputs[1] = {&raised.control()};

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    bench.unit().connect(binding);
  }

  void want(double height) {
    Pose pose{};
    pose.position = {0.5, -0.25, height};
    wanted.publish(pose, bench.now());
  }
};

bool raises_the_pose() {
  World world;
  world.bench.runtime().height = 0.25;
  world.want(0.5);
  world.bench.step(std::chrono::milliseconds(1));
  const auto pose = world.raised.latest();
  return pose && pose->position[0] == 0.5 && pose->position[1] == -0.25 && pose->position[2] == 0.75 &&
         world.bench.feedback().passed == 1;
}

bool publishes_nothing_without_a_pose() {
  World world;
  world.bench.step(std::chrono::milliseconds(1));
  return world.raised.control().published() == 0 && world.bench.feedback().passed == 0;
}

// A failing assertion jumps over destructors, so what is tested runs in functions of its own.
void raises(void**) {
  assert_true(raises_the_pose());
}
void without(void**) {
  assert_true(publishes_nothing_without_a_pose());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(raises), cmocka_unit_test(without)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
