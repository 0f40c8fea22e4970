// The real drivers of line and chip, their messages on a simulated bus, and a simulated module at the other
// end.
#include "hal/gpio/chip/canopen/simulator/module_on_can.hpp"
#include "hal/gpio/lines/canopen/tests/io_world.hpp"

namespace {

using namespace flexrf;

class CanopenWorld final : public DigitalIoWorld {
 public:
  using DigitalIoWorld::start;

  CanopenWorld() {
    ready_ = world_.begin().is_ok() && world_.until([&] { return world_.told().present; });
  }

  Status start(const DigitalLineSettings& settings, bool signal) override {
    if (!ready_) return Status::error(StatusCode::internal, "the module did not come up");
    world_.run(std::chrono::milliseconds(10));  // what was driven before has been told
    const char* const name = settings.direction == LineDirection::output ? "DO3" : "DI3";
    const Status status = world_.add(settings, name, signal);
    started_ = status.is_ok();
    return status;
  }
  DigitalIo& io() override { return world_.line(world_.lines() - 1); }
  void receive(Duration elapsed) override { world_.receive(elapsed); }
  void send() override { world_.send(); }
  Time now() const override { return world_.now(); }
  void drive(bool high) override { world_.far_end().drive(2, high); }
  bool sees_high() override {
    world_.let_arrive();
    return world_.far_end().sees_high(2);
  }
  // A module that is switched on later is awaited: of that canopen_io_fault_test.
  bool unplug() override {
    if (started_) world_.far_end().set_plugged(false);
    return started_;
  }
  bool plug_in() override {
    drive(false);
    world_.far_end().set_plugged(true);
    return true;
  }
  bool occupy() override {
    const Result<GpioLine*> line = world_.chip().request({.name = "DI3"});
    occupied_ = line ? *line : nullptr;
    return occupied_ != nullptr;
  }
  void let_go() override { world_.chip().release(occupied_); }

 private:
  IoWorld<ModuleOnCan> world_{SimulatedCia401Module::Options{.node = IoWorld<ModuleOnCan>::node}};
  GpioLine* occupied_ = nullptr;
  bool ready_ = false;
  bool started_ = false;
};

}  // namespace

int main() {
  return run_digital_io_conformance("line of a CANopen module", []() -> std::unique_ptr<DigitalIoWorld> {
    return std::make_unique<CanopenWorld>();
  });
}
