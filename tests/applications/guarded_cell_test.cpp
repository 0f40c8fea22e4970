// An emergency-stop input in a running cell, on mock and on simulated chips: what is safe, and what a person
// has to do before anything moves again. And the cell's watchdog, which is a mock.
#include <cstring>

#include "hal/gpio/chip/mock/mock_gpio_chip.hpp"
#include "hal/gpio/chip/simulated/simulated_gpio_chip.hpp"
#include "hal/watchdog/mock/mock_watchdog.hpp"
#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

Options on(const char* driver) {
  Options options;
  options.hardware.push_back({"", driver});
  return options;
}

Device& device_of(const Application& application, const char* name) {
  std::size_t i = 0;
  while (std::strcmp(application.devices[i].name, name) != 0) ++i;
  return *application.device_states[i].device;
}

template <class Chip>
class Guarded {
 public:
  explicit Guarded(const char* driver) : running_(application::application, on(driver)) {}

  Control& control() { return running_.control(); }
  Chip& chip(const char* name) { return static_cast<Chip&>(device_of(running_.application(), name)); }
  MockWatchdog& watchdog() {
    return static_cast<MockWatchdog&>(device_of(running_.application(), "watchdog"));
  }
  void press(bool pressed) { chip("panel").line("ESTOP").drive(!pressed); }
  bool valve_is_open() { return chip("machine").line("VALVE").is_high(); }
  bool lamp_is_lit() { return chip("panel").line("LAMP").is_high(); }
  /// A person clears the stop and gives Start until it is accepted.
  bool clear_and_start() {
    return wait_until([this] {
      control().clear_stop_motion();
      return control().start_motion().is_ok();
    });
  }
  void check_moves() {
    CHECK(wait_until([this] { return valve_is_open() && !lamp_is_lit(); }));
  }
  void check_stops() {
    CHECK(wait_until([this] { return control().safe_state_latched(); }));
    CHECK(wait_until([this] { return !valve_is_open() && lamp_is_lit(); }));
    CHECK(!control().may_move());
  }
  void check_ends_well() { CHECK_EQUAL(running_.stop().exit_code, 0); }

 private:
  Running running_;
};

template <class Chip>
void it_shuts_the_valve_until_cleared_and_started(const char* driver) {
  Guarded<Chip> cell(driver);
  // Nobody drives the input yet: it is as good as pressed.
  cell.check_stops();
  cell.control().clear_stop_motion();
  CHECK(!cell.control().start_motion());
  cell.press(false);
  CHECK(cell.clear_and_start());
  cell.check_moves();

  cell.press(true);
  cell.check_stops();
  cell.control().clear_stop_motion();
  const Status refused = cell.control().start_motion();
  CHECK(!refused);
  CHECK(refused.cause()[0] != '\0');
  // Cleared while pressed, it is latched again.
  CHECK(wait_until([&] { return cell.control().safe_state_latched(); }));

  cell.press(false);
  // Released is not cleared: nothing moves by itself.
  CHECK(!cell.control().start_motion());
  CHECK(!cell.valve_is_open());
  CHECK(cell.clear_and_start());
  cell.check_moves();
  cell.check_ends_well();
}

template <class Chip>
void a_chip_that_is_unplugged_stops_too(const char* driver) {
  Guarded<Chip> cell(driver);
  cell.press(false);
  CHECK(cell.clear_and_start());
  cell.check_moves();
  cell.chip("panel").unplug();
  CHECK(wait_until([&] { return cell.control().safe_state_latched() && !cell.valve_is_open(); }));
  cell.control().clear_stop_motion();
  CHECK(!cell.control().start_motion());
  cell.chip("panel").plug_in();
  CHECK(cell.clear_and_start());
  cell.check_moves();
  cell.check_ends_well();
}

// [stop-12] [stop-16]
void on_the_mock_it_shuts_the_valve() {
  it_shuts_the_valve_until_cleared_and_started<MockGpioChip>("mock");
}
// [stop-12] [stop-16]
void on_the_simulator_it_shuts_the_valve() {
  it_shuts_the_valve_until_cleared_and_started<SimulatedGpioChip>("simulated");
}
void on_the_mock_an_unplugged_chip_stops_too() {
  a_chip_that_is_unplugged_stops_too<MockGpioChip>("mock");
}
void on_the_simulator_an_unplugged_chip_stops_too() {
  a_chip_that_is_unplugged_stops_too<SimulatedGpioChip>("simulated");
}

// [watchdog-3] [watchdog-4]
void the_watchdog_is_fed_and_let_go_at_the_end() {
  Guarded<MockGpioChip> cell("mock");
  CHECK(wait_until([&] { return cell.watchdog().resets_at() != Time::max(); }));
  CHECK(cell.watchdog().is_armed());
  CHECK(!cell.watchdog().was_late());
  cell.check_ends_well();
  CHECK(!cell.watchdog().is_armed());
}

void in_virtual_time_it_is_fed_in_time() {
  Options options = on("mock");
  options.virtual_time = std::chrono::minutes{10};
  Executive executive(application::application, options);
  CHECK(executive.prepare().is_ok());
  const auto& watchdog =
      static_cast<const MockWatchdog&>(device_of(executive.cell().application(), "watchdog"));
  CHECK(executive.run().exit_code == 0);
  CHECK(!watchdog.was_late());
  CHECK(watchdog.times_fed() > 200);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(on_the_mock_it_shuts_the_valve),
      TEST_APART(on_the_simulator_it_shuts_the_valve),
      TEST_APART(on_the_mock_an_unplugged_chip_stops_too),
      TEST_APART(on_the_simulator_an_unplugged_chip_stops_too),
      TEST_APART(the_watchdog_is_fed_and_let_go_at_the_end),
      TEST_APART(in_virtual_time_it_is_fed_in_time),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
