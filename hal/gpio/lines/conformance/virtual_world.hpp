// A world in memory: a chip whose lines the test drives, and a driver of DigitalIo on it.
#pragma once

#include <optional>

#include "base/text.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/gpio/lines/conformance/digital_io_conformance.hpp"

namespace flexrf {

template <class Driver>
void configure_line(DeviceBench<Driver>& bench, const DigitalLineSettings& settings, std::string_view name,
                    bool signal = false) {
  auto& configuration = bench.configuration();
  set_text(configuration.line, name);
  configuration.direction = settings.direction;
  configuration.bias = settings.bias;
  configuration.active_low = settings.active_low;
  configuration.debounce = seconds(settings.debounce);
  configuration.emergency_stop = settings.emergency_stop;
  configuration.safe_value = settings.safe_value;
  configuration.signal = signal;
}

template <class Chip, class Driver>
class VirtualDigitalIoWorld : public DigitalIoWorld {
 public:
  using DigitalIoWorld::start;
  Status start(const DigitalLineSettings& settings, bool signal) override {
    if (const Status status = chip_.driver().initialise(); !status) return status;
    line_.emplace(nullptr, std::span<QueueSink* const>{}, &chip_.driver());
    configure_line(*line_, settings, name, signal);
    return line_->driver().initialise();
  }
  DigitalIo& io() override { return line_->driver(); }
  void receive(Duration elapsed) override {
    chip_.receive(elapsed);
    line_->receive(elapsed);
  }
  void send() override {
    line_->send();
    chip_.send();
  }
  Time now() const override { return line_->now(); }
  void drive(bool high) override { chip().line(name).drive(high); }
  bool sees_high() override { return chip().line(name).is_high(); }
  bool unplug() override {
    chip().unplug();
    return true;
  }
  bool plug_in() override {
    chip().line(name).drive(false);
    chip().plug_in();
    return true;
  }
  bool occupy() override {
    const Result<GpioLine*> line = chip().request({.name = name});
    occupied_ = line ? *line : nullptr;
    return occupied_ != nullptr;
  }
  void let_go() override { chip().release(occupied_); }

 protected:
  Chip& chip() { return chip_.driver(); }

 private:
  static constexpr const char* name = "LINE";

  DeviceBench<Chip> chip_{nullptr};
  GpioLine* occupied_ = nullptr;
  std::optional<DeviceBench<Driver>> line_;
};

}  // namespace flexrf
