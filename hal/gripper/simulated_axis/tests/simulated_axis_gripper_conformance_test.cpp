#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/gripper/conformance/gripper_cases.hpp"
#include "hal/gripper/simulated_axis/simulated_axis_gripper.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::gripper_cases;

class SimulatedAxisWorld final : public GripperWorld {
 public:
  ~SimulatedAxisWorld() override {
    gripper_.driver().stop();
    bus_.driver().stop();
  }

  Status start(const GripperSetting& setting) override {
    configure_gripper(gripper_.configuration(), setting);
    gripper_.configuration().node = 3;
    if (const Status status = bus_.driver().initialise(); !status) return status;
    return gripper_.driver().initialise();
  }
  SimulatedAxisGripper::Configuration& configuration() { return gripper_.configuration(); }
  SimulatedAxisGripper& driver() { return gripper_.driver(); }
  Gripper& gripper() override { return gripper_.driver(); }
  void receive() override {
    constexpr Duration cycle = std::chrono::milliseconds(7);
    bus_.receive(cycle);
    gripper_.receive(cycle);
  }
  void send() override {
    gripper_.send();
    bus_.send();
  }
  Time now() const override { return gripper_.now(); }
  double fingers() override { return drive().motion().position() / SimulatedAxisGripper::increments; }

  bool put_object(double width) override { return block(width, std::nullopt); }
  bool put_around(double room) override { return block(std::nullopt, room); }
  bool take_away() override { return block(std::nullopt, std::nullopt); }
  bool make(GripperFarEnd behaviour) override {
    switch (behaviour) {
      case GripperFarEnd::well:
        drive().silence_heartbeat(false);
        drive().cut_motor(false);
        drive().heal();
        if (is_off_) drive().power_on(bus_.now());
        is_off_ = false;
        return true;
      case GripperFarEnd::silent:
        drive().silence_heartbeat(true);
        return true;
      case GripperFarEnd::off:
        drive().power_off();
        is_off_ = true;
        return true;
      case GripperFarEnd::stuck:
        drive().cut_motor(true);
        return true;
      case GripperFarEnd::tripped:
        drive().trip(0x2310, false, gripper_.driver().far_end().said());
        return true;
      case GripperFarEnd::unplugged:
      case GripperFarEnd::damaged:
      case GripperFarEnd::switch_broken:
        break;
    }
    return false;
  }

 private:
  SimulatedCia402Drive& drive() { return gripper_.driver().far_end().drive(); }
  bool block(std::optional<double> closing, std::optional<double> opening) {
    constexpr double scale = SimulatedAxisGripper::increments;
    drive().block(closing ? std::optional(*closing * scale) : std::nullopt,
                  opening ? std::optional(*opening * scale) : std::nullopt);
    return true;
  }

  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<SimulatedAxisGripper> gripper_{nullptr, {}, &bus_.driver()};
  bool is_off_ = false;
};

// As an application's table has it.
bool grips_what_the_table_puts_between() {
  const auto world = std::make_unique<SimulatedAxisWorld>();
  world->configuration().object_width = 0.02;
  if (!starts_active(*world)) return false;
  for (int i = 0; i < 2; ++i) {
    if (!goes_to(*world, closed) || object(*world) != GripperObject::gripped) return false;
    if (!fingers_at(*world, 0.02) || !goes_to(*world, opened)) return false;
  }
  // Stopped and begun again, the fingers are where they were.
  if (!goes_to(*world, 0.05)) return false;
  world->driver().stop();
  return world->driver().initialise() && fingers_at(*world, 0.05) && becomes_active(*world) &&
         fingers_at(*world, 0.05);
}

void an_object_of_the_table(void**) {
  const bool good = grips_what_the_table_puts_between();
  assert_true(good);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(an_object_of_the_table)};
  return run_gripper_conformance(
             "simulated gripper that is an axis",
             []() -> std::unique_ptr<GripperWorld> { return std::make_unique<SimulatedAxisWorld>(); }) +
         cmocka_run_group_tests_name("simulated gripper that is an axis, in a table", tests, nullptr,
                                     nullptr);
}
