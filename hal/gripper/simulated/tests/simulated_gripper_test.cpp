// What the simulated gripper has beyond every gripper: what it tells as it came, and disturbances.
#include "hal/gripper/simulated/simulated_gripper.hpp"

#include <cmath>
#include <functional>

#include "hal/driver/device_bench.hpp"
#include "hal/modbus/link/simulated/simulated_modbus_link.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr Duration cycle = std::chrono::milliseconds(7);

class World {
 public:
  explicit World(double object_width = 0) {
    link_.configuration().response_timeout = 0.1;
    gripper_.configuration().object_width = object_width;
    is_good_ = link_.driver().initialise().is_ok() && gripper_.driver().initialise().is_ok();
    gripper_.driver().activate();
    is_good_ = is_good_ && until([&] { return told().activated || (activate(), false); });
  }
  ~World() {
    gripper_.driver().stop();
    link_.driver().stop();
  }

  bool is_good() const { return is_good_; }
  SimulatedGripper& gripper() { return gripper_.driver(); }
  const SimulatedGripperFeedback& told() { return gripper_.feedback(); }
  SimulatedGripperRuntime& runtime() { return gripper_.runtime(); }
  void activate() { gripper().activate(); }

  void step() {
    link_.receive(cycle);
    gripper_.receive(cycle);
    // As the executive does: a press counts in one cycle.
    runtime().take_object = runtime().overload = 0;
    gripper_.send();
    link_.send();
  }
  bool until(const std::function<bool()>& is_so) {
    for (int i = 0; i < 10'000; ++i) {
      step();
      if (is_so()) return true;
    }
    return false;
  }
  bool until_it_rests() {
    step();
    return until([&] { return !told().moving; });
  }

 private:
  DeviceBench<SimulatedModbusLink> link_{nullptr};
  DeviceBench<SimulatedGripper> gripper_{nullptr, {}, &link_.driver()};
  bool is_good_ = false;
};

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

bool it_tells_as_it_came() {
  World world;
  if (!world.is_good() || (world.told().status_byte & 0x31U) != 0x31U || world.told().fault_code != 0)
    return false;
  world.gripper().close();
  if (!world.until([&] { return world.told().motor_current > 0; })) return false;
  if (std::abs(world.told().motor_current - 0.2) > 1e-9 || (world.told().status_byte & 0x08U) == 0)
    return false;
  if (!world.until_it_rests()) return false;
  return world.told().position_count == 255 && world.told().motor_current == 0 &&
         world.told().status_byte >> 6U == 3;  // arrived, nothing in between
}

bool an_object_is_taken_away() {
  World world(0.03);
  world.gripper().close();
  if (!world.until_it_rests() || world.told().object != GripperObject::gripped) return false;
  world.runtime().take_object = 1;
  if (!world.until([&] { return world.told().object == GripperObject::lost; })) return false;
  if (world.told().losses != 1) return false;
  // The next is there again.
  world.gripper().open();
  if (!world.until_it_rests()) return false;
  world.gripper().close();
  return world.until_it_rests() && world.told().object == GripperObject::gripped;
}

bool fingers_are_stuck_as_long_as_they_shall_be() {
  World world;
  world.runtime().stuck = true;
  world.gripper().close();
  if (!world.until([&] { return !world.told().trouble_view().empty(); })) return false;
  if (world.told().trouble_view().find("did not come to rest") == std::string_view::npos) return false;
  world.runtime().stuck = false;
  world.gripper().close();
  return world.until_it_rests() && world.told().trouble_view().empty() && world.told().position_count == 255;
}

bool an_overload_stays_until_it_is_activated() {
  World world;
  world.runtime().overload = 1;
  if (!world.until([&] { return world.told().fault_code == 0x0E; })) return false;
  if (world.told().trouble_view().find("0x0E") == std::string_view::npos) return false;
  for (int i = 0; i < 100; ++i) world.step();
  if (world.told().fault_code != 0x0E) return false;
  world.activate();
  return world.until([&] { return world.told().activated && world.told().fault_code == 0; });
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(judged<it_tells_as_it_came>),
                              cmocka_unit_test(judged<an_object_is_taken_away>),
                              cmocka_unit_test(judged<fingers_are_stuck_as_long_as_they_shall_be>),
                              cmocka_unit_test(judged<an_overload_stays_until_it_is_activated>)};
  return cmocka_run_group_tests_name("simulated gripper", tests, nullptr, nullptr);
}
