// 500 units in one thread, 1000 slots.
#include <array>

#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::scale_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr std::uint16_t units = 500;

/// Unit i reads slot i − 1 and publishes one more in slot i, and its own count in slot 500 + i.
class Chain : public TestApplication {
 public:
  Chain() {
    for (std::uint16_t i = 0; i < 2 * units; ++i) add(SlotPlan{.name = "slot" + std::to_string(i)});
    ThreadPlan thread;
    thread.name = "all";
    thread.trigger = TriggerPlan::periodic(milliseconds{10});
    for (std::uint16_t i = 0; i < units; ++i) {
      UnitPlan unit;
      unit.name = "unit" + std::to_string(i);
      unit.parameters = false;
      unit.budget = microseconds{1};
      if (i > 0) unit.inputs = {InputPlan{.slot = static_cast<std::uint16_t>(i - 1)}};
      unit.outputs = {i, static_cast<std::uint16_t>(units + i)};
      unit.script.step = [this, i](TestUnit& self, const Tick& tick) {
        // Virtual time may end within a release, on the wall clock a stop is seen by whole releases only.
        if (tick.stop_requested) return;
        // The first are released while the last are still to be initialised: a round begins when the last one
        // has stepped, for only then are all of them the thread's.
        if (i == 0 ? unit_state(units - 1).steps == 0 : rounds_[i] == rounds_[i - 1u]) return;
        const View<Item> before = self.inputs[0].latest();
        self.outputs[0].publish(Item{before ? before->number + 1 : 1, 0});
        self.outputs[1].publish(Item{rounds_[i]++, 0});
      };
      thread.units.push_back(add(std::move(unit)));
    }
    add(std::move(thread));
  }
  std::int64_t latest(std::uint16_t slot) {
    SlotReader* observer = application().slots[slot].observer;
    return observer->newest() == nullptr ? -1 : static_cast<const Item*>(observer->payload())->number;
  }

 private:
  std::array<std::int64_t, units> rounds_{};  ///< of each unit, for the unit's thread
};

void check(Chain& cell) {
  const std::uint64_t steps = cell.slot_control(0).published();
  CHECK(steps > 10);
  CHECK_EQUAL(cell.application().slots.size(), 1000U);
  for (std::uint16_t i = 0; i < units; ++i) {
    CHECK(cell.unit_state(i).steps >= steps);
    CHECK_EQUAL(cell.slot_control(i).published(), steps);
    // Table order: in one release a value passes through all units.
    CHECK_EQUAL(cell.latest(i), i + 1);
    CHECK_EQUAL(cell.latest(static_cast<std::uint16_t>(units + i)), static_cast<std::int64_t>(steps) - 1);
  }
}

// [exec-1] [exec-58]
void in_virtual_time_all_units_step() {
  Chain cell;
  Executive executive(cell.application(), in_virtual_time(milliseconds{200}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  check(cell);
}

// [exec-1] [exec-58]
void on_the_wall_clock_too() {
  Chain cell;
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(units - 1).steps > 20; }));
  CHECK_EQUAL(running.finish().exit_code, 0);
  check(cell);
}

}  // namespace
}  // namespace flexrf::fixture::scale_test

int main() {
  using namespace flexrf::fixture::scale_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(in_virtual_time_all_units_step),
      CONTAINED_TEST(on_the_wall_clock_too),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
