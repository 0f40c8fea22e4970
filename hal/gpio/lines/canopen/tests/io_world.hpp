// A CAN bus in virtual time, a chip that is a module on it, some of its lines, and the far end.
#pragma once

#include <cstdlib>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/gpio/chip/canopen/canopen_gpio_chip.hpp"
#include "hal/gpio/lines/canopen/canopen_digital_io.hpp"
#include "hal/gpio/lines/conformance/virtual_world.hpp"

namespace flexrf {

/// `FarEnd`: a CanNode, made of its node's number and the time. The chip is initialised by begin().
template <class FarEnd>
class IoWorld {
 public:
  using Line = DeviceBench<CanopenDigitalIo>;
  static constexpr std::uint8_t node = 5;
  static constexpr Duration cycle = std::chrono::milliseconds(2);

  template <class... Options>
  explicit IoWorld(const Options&... options) : far_end_{options..., bus_.now()} {
    auto& configuration = chip_.configuration();
    configuration.node = node;
    initialised_ = bus_.driver().initialise().is_ok();
    bus_.driver().wire()->attach(far_end_);
  }
  ~IoWorld() {
    for (const auto& line : lines_) line->driver().stop();
    chip().stop();
    bus_.driver().wire()->detach(far_end_);
    bus_.driver().stop();
  }

  CanopenGpioChip::Configuration& configuration() { return chip_.configuration(); }
  Status begin() {
    return initialised_ ? chip().initialise() : Status::error(StatusCode::internal, "no bus");
  }
  Status add(const DigitalLineSettings& settings, std::string_view name, bool signal = false) {
    lines_.push_back(std::make_unique<Line>(nullptr, std::span<QueueSink* const>{}, &chip()));
    configure_line(*lines_.back(), settings, name, signal);
    return lines_.back()->driver().initialise();
  }

  FarEnd& far_end() { return far_end_; }
  InProcessCanBus& bus() { return bus_.driver(); }
  CanopenGpioChip& chip() { return chip_.driver(); }
  std::size_t lines() const { return lines_.size(); }
  DigitalIo& line(std::size_t index) { return lines_[index]->driver(); }
  const CanopenGpioChip::Feedback& told() { return chip_.feedback(); }
  const auto& told_of(std::size_t index) { return lines_[index]->feedback(); }
  Time now() const { return bus_.now(); }

  void receive(Duration elapsed = cycle) {
    bus_.receive(elapsed);
    chip_.receive(elapsed + ahead_);
    for (const auto& line : lines_) line->receive(elapsed + ahead_);
    ahead_ = {};
  }
  void send() {
    for (const auto& line : lines_) line->send();
    chip_.send();
    bus_.send();
  }
  /// What was sent arrives, before the next cycle begins.
  void let_arrive() {
    constexpr Duration time = std::chrono::milliseconds(1);
    bus_.receive(time);
    ahead_ += time;
  }
  /// A cycle in which nobody commands anything.
  void step() {
    receive();
    send();
  }
  void run(Duration time) {
    for (const Time begin = now(); now() - begin < time;) step();
  }
  /// Time passes, and this end neither receives nor sends.
  void stall(Duration time) {
    bus_.receive(time);
    ahead_ += time;
  }
  template <class Condition>
  bool until(const Condition& is_so, Duration patience = std::chrono::seconds(10)) {
    for (const Time begin = now(); now() - begin < patience;) {
      step();
      if (is_so()) return true;
    }
    return false;
  }
  void command(std::size_t index, bool on) {
    receive();
    line(index).command(on);
    send();
    let_arrive();
  }
  bool is_on(std::size_t index) {
    const auto state = line(index).state();
    return state && state->on;
  }

 private:
  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<CanopenGpioChip> chip_{nullptr, {}, &bus_.driver()};
  std::vector<std::unique_ptr<Line>> lines_;
  FarEnd far_end_;
  Duration ahead_{};
  bool initialised_ = false;
};

}  // namespace flexrf
