// In the guest, whose clock counts: the controller is another process and answers in its own cycle. The
// conformance suite, the faults, and those of a controller or a cable that is gone.
#include <cstdio>
#include <cstdlib>

#include "hal/robot_arm/melfa_mxt/tests/melfa_faults.hpp"
#include "hal/robot_arm/melfa_mxt/tests/process_world.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr Duration longest_recovery = std::chrono::seconds(2);

bool set_cable(bool in) {
  return std::system(in ? "ip link set dev lo up" : "ip link set dev lo down") == 0;
}

/// A far end that can be lost and be there again.
struct Loss {
  bool (*lose)(ProcessWorld&);
  bool (*restore)(ProcessWorld&);
};

bool stand_still(ProcessWorld& world) {
  world.controller().pause();
  return true;
}
bool go_on(ProcessWorld& world) {
  world.controller().resume();
  return true;
}
bool lose_power(ProcessWorld& world) {
  world.controller().kill();
  return true;
}
bool switch_on(ProcessWorld& world) {
  const std::uint16_t port = world.port();
  world.switch_on();
  return world.port() == port;
}
bool unplug(ProcessWorld& /*world*/) {
  return set_cable(false);
}
bool plug_in(ProcessWorld& /*world*/) {
  return set_cable(true);
}

constexpr Loss stall{stand_still, go_on};
constexpr Loss power{lose_power, switch_on};
constexpr Loss cable{unplug, plug_in};

/// From when it is back to when the driver hears it, on the clock that counts.
bool is_heard_in_time(ProcessWorld& world) {
  const Time since = MonotonicClock::now();
  while (!world.arm().state() && MonotonicClock::now() - since < longest_recovery) world.idle(1);
  std::fprintf(stderr, "heard after %lld ms\n",
               static_cast<long long>((MonotonicClock::now() - since).count() / 1'000'000));
  return world.arm().state().has_value();
}

bool is_lost_and_comes_back(const Loss& loss) {
  ProcessWorld world;
  if (!world.initialised() || !world.begin_leading()) return false;
  world.command(melfa_home(), 20);
  if (!loss.lose(world)) return false;
  world.command(melfa_home(), 20);
  const bool is_told = has_fault_of_silence(world);
  world.arm().set_inhibited(true);
  if (!loss.restore(world) || !is_told || !is_heard_in_time(world)) return false;
  // Nothing moves by itself; a person restarts the unit and gives Start.
  world.idle(20);
  if (world.arm().is_ready() || !world.restart()) return false;
  world.arm().set_inhibited(false);
  return world.begin_leading() && arrives(world) && world.ask("alarm") == "none";
}

template <const Loss& loss>
void is_lost(void**) {
  const bool passed = is_lost_and_comes_back(loss);
  set_cable(true);
  assert_true(passed);
}

}  // namespace

int main() {
  int failed = run_robot_arm_conformance("MELFA arm, controller another process",
                                         []() -> std::unique_ptr<RobotArmWorld> {
                                           return std::make_unique<MelfaConformanceWorld<ProcessWorld>>();
                                         });
  failed +=
      run_melfa_faults("faults of a MELFA arm, controller another process",
                       []() -> std::unique_ptr<MelfaWorld> { return std::make_unique<ProcessWorld>(); });
  const CMUnitTest tests[] = {
      {"a controller that stands still", is_lost<stall>, nullptr, nullptr, nullptr},
      {"a controller without power", is_lost<power>, nullptr, nullptr, nullptr},
      {"a network cable that is out", is_lost<cable>, nullptr, nullptr, nullptr},
  };
  failed += cmocka_run_group_tests_name("a MELFA controller that is lost", tests, nullptr, nullptr);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
