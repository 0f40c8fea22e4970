#include <deque>

#include "hal/can/conformance/can_bus_conformance.hpp"
#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"

namespace {

using namespace flexrf;

/// Says what it is told to, and keeps what it hears.
class FarEnd final : public CanNode {
 public:
  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    heard_.push_back(frame);
    say_more(port);
  }
  Time next_event() const noexcept override { return now_ + pause; }
  void on_time(Time now, CanPort& port) noexcept override {
    now_ = now;
    say_more(port);
  }

  void say(const CanFrame& frame) { to_say_.push_back(frame); }
  std::optional<CanFrame> hear() {
    if (heard_.empty()) return std::nullopt;
    const CanFrame frame = heard_.front();
    heard_.pop_front();
    return frame;
  }

 private:
  static constexpr Duration pause = std::chrono::microseconds(50);
  void say_more(CanPort& port) {
    while (!to_say_.empty() && port.send(to_say_.front())) to_say_.pop_front();
  }

  std::deque<CanFrame> to_say_;
  std::deque<CanFrame> heard_;
  Time now_{};
};

class InProcessWorld final : public CanBusWorld {
 public:
  InProcessWorld() {
    bench_.configuration().restart_after = 0.05;
    if (!bench_.driver().initialise()) return;
    station_ = bench_.driver().wire()->attach(far_end_);
  }
  ~InProcessWorld() override {
    bench_.driver().wire()->detach(far_end_);
    bench_.driver().stop();
  }

  CanBus& bus() override { return bench_.driver(); }
  void receive() override { bench_.receive(std::chrono::milliseconds(1)); }
  void send() override { bench_.send(); }
  Time now() const override { return bench_.now(); }

  void say(const CanFrame& frame) override {
    // At once, so that identifiers keep the order in which they are said.
    far_end_.say(frame);
    far_end_.on_time(bench_.now(), *station_);
  }
  std::optional<CanFrame> hear() override { return far_end_.hear(); }

  bool set_down() override { return pretend(CanBusState::down); }
  bool set_up() override { return pretend(CanBusState::error_active); }
  bool take_away() override { return pretend(CanBusState::gone); }
  bool put_back() override { return pretend(CanBusState::error_active); }
  // Each counts 8.
  bool cause_bus_off() override { return fail(32); }
  bool cause_error_passive() override { return fail(20); }

 private:
  bool pretend(CanBusState state) {
    bench_.driver().pretend(state);
    return true;
  }
  bool fail(unsigned transmissions) {
    bench_.driver().station().corrupt_next(transmissions);
    CanFrame frame;
    frame.identifier = 0x100;
    return bus().queue(frame);
  }

  DeviceBench<InProcessCanBus> bench_{nullptr};
  FarEnd far_end_;
  CanStation* station_ = nullptr;
};

}  // namespace

int main() {
  return run_can_bus_conformance("in-process CAN bus", []() -> std::unique_ptr<CanBusWorld> {
    return std::make_unique<InProcessWorld>();
  });
}
