// What a cycle of six CANopen axes costs: receive, state machine, set-points, send and SYNC, over the
// in-process bus, against encoding and decoding the same process data in a bare loop.
#include <array>
#include <cmath>
#include <optional>
#include <thread>

#include "benchmarks/harness.hpp"
#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"
#include "hal/servo_drive/canopen/simulator/drive_on_can.hpp"
#include "runtime/realtime/realtime_scope.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t axes = 6;
constexpr Duration period = 7ms;
constexpr int most_cycles = 10'000;

// Says at each SYNC what six drives said at one, without being drives: what is measured is the master.
class Echo final : public CanNode {
 public:
  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    if (frame.identifier != canopen::sync_identifier) return;
    for (const CanFrame& answer : answers_) {
      if (answer.length > 0) port.send(answer);
    }
    CanFrame beat;
    beat.identifier = canopen::identifier_of(canopen::heartbeat_base, static_cast<std::uint8_t>(beats_ + 1));
    beat.length = 1;
    beat.data[0] = static_cast<std::uint8_t>(canopen::NmtState::operational);
    port.send(beat);
    beats_ = (beats_ + 1) % axes;
  }
  Time next_event() const noexcept override { return Time::max(); }
  void on_time(Time /*now*/, CanPort& /*port*/) noexcept override {}

  // The first is the state, the second the velocity of the drive with this node.
  void learn(const CanFrame& frame) noexcept {
    for (std::uint8_t axis = 0; axis < axes; ++axis) {
      const auto node = static_cast<std::uint8_t>(axis + 1);
      if (frame.identifier == canopen::transmit_pdo_identifier(1, node)) answers_[2U * axis] = frame;
      if (frame.identifier == canopen::transmit_pdo_identifier(2, node)) answers_[2U * axis + 1U] = frame;
    }
  }
  const std::array<CanFrame, 2 * axes>& answers() const { return answers_; }

 private:
  std::array<CanFrame, 2 * axes> answers_{};
  std::size_t beats_ = 0;
};

// Hears what the drives say.
struct Listener final : CanNode {
  explicit Listener(Echo& to) : echo(to) {}
  void on_frame(const CanFrame& frame, CanPort& /*port*/) noexcept override { echo.learn(frame); }
  Time next_event() const noexcept override { return Time::max(); }
  void on_time(Time /*now*/, CanPort& /*port*/) noexcept override {}
  Echo& echo;
};

class Cell {
 public:
  Cell() {
    good_ = bus_.driver().initialise().is_ok() && wire().attach(listener_) != nullptr;
    for (std::size_t i = 0; i < axes; ++i) {
      const auto node = static_cast<std::uint8_t>(i + 1);
      drives_[i].emplace(nullptr, std::span<QueueSink* const>{}, &bus_.driver());
      drives_[i]->configuration().node = node;
      drives_[i]->configuration().fastest = 20;
      far_ends_[i].emplace(SimulatedCia402Drive::Options{.node = node}, bus_.now());
      good_ = good_ && drives_[i]->driver().initialise().is_ok() && wire().attach(*far_ends_[i]) != nullptr;
    }
  }
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;
  ~Cell() {
    for (auto& drive : drives_) drive->driver().stop();
    bus_.driver().stop();
  }

  bool enable() {
    for (int i = 0; i < most_cycles && good_ && !all_enabled(); ++i) cycle();
    return good_ && all_enabled();
  }
  void cycle() {
    bus_.receive(period);
    step_drives();
    bus_.send();
  }
  /// A cycle, of which the bus's part is not counted.
  Duration cycle_without_bus() {
    bus_.receive(period);
    const Time begin = MonotonicClock::now();
    step_drives();
    const Duration taken = MonotonicClock::now() - begin;
    bus_.send();
    return taken;
  }
  /// From now on what the drives said last is all that is said.
  bool replace_drives() {
    for (int i = 0; i < 300; ++i) cycle();
    for (auto& far_end : far_ends_) wire().detach(*far_end);
    wire().detach(listener_);
    return wire().attach(echo_) != nullptr;
  }
  bool all_enabled() {
    for (auto& drive : drives_) {
      const auto state = drive->driver().state();
      if (!state || !state->enabled || !drive->driver().fault().is_ok()) return false;
    }
    return true;
  }
  const Echo& echo() const { return echo_; }

 private:
  void step_drives() {
    for (auto& drive : drives_) drive->receive(period);
    for (auto& drive : drives_) drive->driver().command_position(1);
    for (auto& drive : drives_) drive->send();
  }
  CanWire& wire() { return *bus_.driver().wire(); }

  DeviceBench<InProcessCanBus> bus_{nullptr};
  std::array<std::optional<DeviceBench<CanopenServoDrive>>, axes> drives_;
  std::array<std::optional<DriveOnCan>, axes> far_ends_;
  Echo echo_;
  Listener listener_{echo_};
  bool good_ = false;
};

// The same process data, and nothing about it: what each axis is told is encoded, what it said decoded.
class Codec {
 public:
  explicit Codec(const Echo& echo) : said_{echo.answers()} {
    for (std::size_t i = 0; i < axes; ++i) {
      const auto node = static_cast<std::uint8_t>(i + 1);
      Axis& axis = axes_[i];
      axis.command.identifier = canopen::receive_pdo_identifier(1, node);
      axis.command.add(canopen::cia402::objects::controlword, 16);
      axis.command.add(canopen::cia402::objects::target_position, 32);
      axis.command.add(canopen::cia402::objects::mode, 8);
      axis.state.identifier = canopen::transmit_pdo_identifier(1, node);
      axis.state.add(canopen::cia402::objects::statusword, 16);
      axis.state.add(canopen::cia402::objects::actual_position, 32);
      axis.state.add(canopen::cia402::objects::mode_display, 8);
      axis.motion.identifier = canopen::transmit_pdo_identifier(2, node);
      axis.motion.add(canopen::cia402::objects::actual_velocity, 32);
    }
  }
  void cycle() {
    for (std::size_t i = 0; i < axes; ++i) {
      std::uint64_t heard[3] = {};
      decode(axes_[i].state, said_[2 * i], heard);
      touch(heard);
      decode(axes_[i].motion, said_[2 * i + 1], heard);
      touch(heard);
      const std::uint64_t values[] = {canopen::cia402::command::enable_operation, heard[0], 8};
      send(pack(axes_[i].command, values));
    }
    send({canopen::sync_identifier, 0, {}});
  }

 private:
  struct Axis {
    canopen::PdoPlan command;
    canopen::PdoPlan state;
    canopen::PdoPlan motion;
  };
  static void decode(const canopen::PdoPlan& plan, const CanFrame& frame, std::span<std::uint64_t> values) {
    unpack(plan, {static_cast<std::uint16_t>(frame.identifier), frame.length, frame.data}, values);
  }
  static void send(const canopen::Message& message) {
    CanFrame frame;
    frame.identifier = message.identifier;
    frame.length = message.size;
    frame.data = message.data;
    touch(&frame);
  }

  std::array<CanFrame, 2 * axes> said_;
  std::array<Axis, axes> axes_;
};

int run(int argument_count, char** arguments) {
  Report report{"canopen_cycle", argument_count, arguments};
  settle_thread(static_cast<int>(std::thread::hardware_concurrency()) - 1, 50);
  Cell cell;
  if (!cell.enable()) {
    std::fprintf(stderr, "canopen_cycle: the drives were not enabled\n");
    return 1;
  }
  const auto cycle = [&] { cell.cycle(); };
  const Duration length = report.choose<Duration>(50ms, 10ms);
  std::vector<double> with_drives;
  const std::uint64_t simulated = calls_in(length, cycle);
  for (int block = 0; block < report.choose(20, 5); ++block) {
    with_drives.push_back(nanoseconds_per_call(simulated, cycle));
  }
  if (!cell.replace_drives()) {
    std::fprintf(stderr, "canopen_cycle: the bus has no place\n");
    return 1;
  }
  Codec codec{cell.echo()};
  const auto encode = [&] { codec.cycle(); };
  const std::uint64_t cycles = calls_in(length, cycle);
  const std::uint64_t encodings = calls_in(length, encode);
  AllocationCounter allocations{0};
  {
    const RealtimeScope scope{allocations};
    for (std::uint64_t i = 0; i < cycles; ++i) cycle();
  }
  const Pairs pairs = alternate(
      report.choose(40, 10), [&] { return nanoseconds_per_call(cycles, cycle); },
      [&] { return nanoseconds_per_call(encodings, encode); });
  const Pairs without_bus = alternate(
      report.choose(40, 10),
      [&] {
        Duration sum{};
        for (std::uint64_t i = 0; i < cycles; ++i) sum += cell.cycle_without_bus();
        return static_cast<double>(sum.count()) / static_cast<double>(cycles);
      },
      [&] { return nanoseconds_per_call(encodings, encode); });
  if (!cell.all_enabled()) {
    std::fprintf(stderr, "canopen_cycle: a drive was lost on the way\n");
    return 1;
  }
  report.add_ratio("6-axis CSP cycle over the in-process bus, against the bare codec", pairs, 3, "ns",
                   "SYNC, 6 set-points, 12 states, a heartbeat; the bus counts bit times");
  report.add_ratio("6-axis CSP cycle, the drives' part without the bus's", without_bus, 3, "ns",
                   "inboxes, state machines, set-points, the bus's queue; with a clock read");
  const auto allocated = static_cast<double>(allocations.load());
  report.add({"6-axis CSP cycle, allocations",
              "",
              {allocated, allocated, allocated},
              0,
              true,
              has_allocation_guard() ? "" : "not counted: no guard in this build"});
  report.add({"6-axis CSP cycle with six simulated drives at the other end", "ns", estimate(with_drives), 0,
              false, "what a simulation of it costs"});
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
