// Six drives on one simulated bus at 1 Mbit/s, followed in cycles of 7 ms: no window is missed. With the
// argument "hour": for an hour of virtual time.
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"
#include "hal/servo_drive/canopen/simulator/drive_on_can.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr std::size_t axes = 6;
constexpr Duration cycle = std::chrono::milliseconds(7);

class Cell {
 public:
  Cell() {
    good_ = bus_.driver().initialise().is_ok();
    for (std::size_t i = 0; i < axes; ++i) {
      const auto node = static_cast<std::uint8_t>(i + 1);
      drives_[i].emplace(nullptr, std::span<QueueSink* const>{}, &bus_.driver());
      auto& configuration = drives_[i]->configuration();
      configuration.node = node;
      configuration.lowest = -10;
      configuration.highest = 10;
      configuration.fastest = 20;
      far_ends_[i].emplace(SimulatedCia402Drive::Options{.node = node}, bus_.now());
      good_ = good_ && drives_[i]->driver().initialise().is_ok() &&
              bus_.driver().wire()->attach(*far_ends_[i]) != nullptr;
    }
  }
  ~Cell() {
    for (std::size_t i = 0; i < axes; ++i) {
      drives_[i]->driver().stop();
      bus_.driver().wire()->detach(*far_ends_[i]);
    }
    bus_.driver().stop();
  }

  // What each axis shall be at, offset a little from its neighbour.
  void step(std::optional<double> position) {
    bus_.receive(cycle);
    for (auto& drive : drives_) drive->receive(cycle);
    for (std::size_t i = 0; i < axes && position; ++i) {
      drives_[i]->driver().command_position(*position + 0.1 * static_cast<double>(i));
    }
    for (auto& drive : drives_) drive->send();
    bus_.send();
    for (auto& drive : drives_) {
      const auto state = drive->driver().state();
      good_ = good_ && drive->driver().fault().is_ok();
      if (state) worst_error_ = std::max(worst_error_, std::abs(state->following_error));
    }
  }
  bool all_enabled() {
    for (auto& drive : drives_) {
      const auto state = drive->driver().state();
      if (!state || !state->enabled) return false;
    }
    return true;
  }
  bool good() const { return good_; }
  void forget_error() { worst_error_ = 0; }
  double worst_error() const { return worst_error_; }
  const auto& counters() { return bus_.driver().counters(); }
  // SYNCs that drives acted on, and those before which a set-point had not come.
  std::uint64_t synchronised() {
    std::uint64_t sum = 0;
    for (auto& far_end : far_ends_) sum += far_end->drive().synchronised();
    return sum;
  }
  std::uint64_t missed() {
    std::uint64_t sum = 0;
    for (auto& far_end : far_ends_) sum += far_end->drive().missed();
    return sum;
  }

 private:
  DeviceBench<InProcessCanBus> bus_{nullptr};
  std::array<std::optional<DeviceBench<CanopenServoDrive>>, axes> drives_;
  std::array<std::optional<DriveOnCan>, axes> far_ends_;
  double worst_error_ = 0;
  bool good_ = false;
};

struct Outcome {
  bool enabled = false;
  bool good = false;
  double worst_error = 0;
  std::uint64_t frames = 0;
  std::uint64_t lost = 0;
  std::uint64_t synchronised = 0;
  std::uint64_t missed = 0;
};

constexpr int some_cycles = 3000;
constexpr int cycles_of_an_hour = 514'286;
int cycles_to_run = some_cycles;

// In here, so that a failing assertion jumps over no destructor.
Outcome run(int cycles) {
  const auto cell = std::make_unique<Cell>();
  for (int i = 0; i < 1000 && !cell->all_enabled(); ++i) cell->step(std::nullopt);
  Outcome outcome;
  outcome.enabled = cell->all_enabled();
  for (int i = 0; i < 300; ++i) cell->step(0.0);
  cell->forget_error();
  const std::uint64_t before = cell->counters().frames_received;
  const std::uint64_t synchronised = cell->synchronised();
  const std::uint64_t missed = cell->missed();
  for (int i = 0; i < cycles; ++i) cell->step(2 * std::sin(i * 0.007));
  outcome.frames = cell->counters().frames_received - before;
  outcome.lost =
      cell->counters().frames_missed + cell->counters().frames_refused + cell->counters().frames_discarded;
  outcome.good = cell->good() && cell->all_enabled();
  outcome.worst_error = cell->worst_error();
  outcome.synchronised = cell->synchronised() - synchronised;
  outcome.missed = cell->missed() - missed;
  return outcome;
}

void six_axes_follow_and_no_window_is_missed(void**) {
  const auto cycles = static_cast<std::uint64_t>(cycles_to_run);
  const Outcome outcome = run(cycles_to_run);
  assert_true(outcome.enabled);
  assert_true(outcome.good);
  assert_int_equal(outcome.lost, 0);
  assert_int_equal(outcome.missed, 0);
  // The last SYNC may still be on the wire.
  assert_true(outcome.synchronised >= (cycles - 1) * axes);
  // Two states of each axis in each cycle, and its heartbeats.
  assert_true(outcome.frames >= cycles * axes * 2);
  // At 2 unit/s, 0.014 in a cycle: a set-point waits for SYNC, is gone to, and is heard of at the SYNC after.
  assert_true(outcome.worst_error > 0 && outcome.worst_error <= 5 * 0.014 + 0.002);
}

}  // namespace
}  // namespace flexrf

int main(int count, char** arguments) {
  using namespace flexrf;
  if (count > 1 && std::strcmp(arguments[1], "hour") == 0) cycles_to_run = cycles_of_an_hour;
  const CMUnitTest tests[] = {cmocka_unit_test(six_axes_follow_and_no_window_is_missed)};
  return cmocka_run_group_tests_name("canopen six axes", tests, nullptr, nullptr);
}
