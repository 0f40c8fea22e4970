// A bus on a bus in a running cell: lines of a module, whose chip is on a CAN bus, from the tables to the
// terminals and back, in virtual time.
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/gpio/chip/canopen/simulator/module_on_can.hpp"
#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

Options for_a_minute() {
  Options options;
  options.virtual_time = std::chrono::minutes(1);
  options.realtime = false;
  return options;
}

class IoModuleCell {
 public:
  IoModuleCell() : executive_(application::application, for_a_minute()) {
    const Status status = executive_.prepare();
    if (!status) throw fixture::CheckFailed{std::string{"prepare: "} + status.cause()};
    CHECK(bus().wire()->attach(module_) != nullptr);
  }
  ~IoModuleCell() { bus().wire()->detach(module_); }

  Control& control() { return executive_.control(); }
  ModuleOnCan& module() { return module_; }
  bool valve_is_open() const { return module_.sees_high(0); }
  void press(bool pressed) { module_.drive(0, !pressed); }

  /// One after the other, each as soon as its condition is so.
  void when(const char* what, std::function<bool()> condition, std::function<void()> act) {
    steps_.push_back({what, std::move(condition), std::move(act)});
  }
  void run() {
    std::function<void()> job;
    job = [this, &job] {
      if (place_ < steps_.size() && steps_[place_].condition()) steps_[place_++].act();
      if (place_ == steps_.size()) executive_.request_end();
      executive_.lifecycle().post(job);
    };
    executive_.lifecycle().post(job);
    CHECK_EQUAL(executive_.run().exit_code, 0);
    if (place_ < steps_.size()) throw fixture::CheckFailed{"it waits in vain for: " + steps_[place_].what};
  }

 private:
  struct Step {
    std::string what;
    std::function<bool()> condition;
    std::function<void()> act;
  };

  InProcessCanBus& bus() {
    const Application& application = executive_.cell().application();
    std::size_t i = 0;
    while (std::strcmp(application.devices[i].name, "can0") != 0) ++i;
    return static_cast<InProcessCanBus&>(*application.device_states[i].device);
  }

  Executive executive_;
  ModuleOnCan module_{{.node = 5}, Time{}};
  std::vector<Step> steps_;
  std::size_t place_ = 0;
};

void the_stop_on_a_module_shuts_the_valve_on_it() {
  IoModuleCell cell;
  const auto is_started = [&cell] {
    cell.control().clear_stop_motion();
    return cell.control().start_motion().is_ok();
  };
  // Until the module has said that nobody presses it, it is as good as pressed.
  cell.when(
      "the stop of a module that is not there", [&] { return cell.control().safe_state_latched(); },
      [&] { CHECK(!cell.control().start_motion()); });
  cell.when(
      "the module", [&] { return cell.module().module().nmt_state() == canopen::NmtState::operational; },
      [&] { cell.press(false); });
  cell.when("a Start", is_started, [&] { CHECK(!cell.valve_is_open()); });
  cell.when(
      "an open valve", [&] { return cell.valve_is_open(); }, [&] { cell.press(true); });
  cell.when(
      "a shut valve", [&] { return cell.control().safe_state_latched() && !cell.valve_is_open(); },
      [&] { cell.press(false); });
  cell.when("another Start", is_started, [] {});
  cell.when(
      "an open valve again", [&] { return cell.valve_is_open(); }, [&] { cell.module().set_plugged(false); });
  // The module notices by itself.
  cell.when(
      "a shut valve without a cable",
      [&] { return cell.control().safe_state_latched() && !cell.valve_is_open(); },
      [&] { cell.module().set_plugged(true); });
  cell.when("a third Start", is_started, [&] { CHECK(!cell.valve_is_open()); });
  cell.when(
      "an open valve at last", [&] { return cell.valve_is_open(); }, [] {});
  cell.run();
  CHECK(!cell.valve_is_open());
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {TEST_APART(the_stop_on_a_module_shuts_the_valve_on_it)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
