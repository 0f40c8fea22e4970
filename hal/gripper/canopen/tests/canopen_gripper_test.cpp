// The gripper that is an axis and a simulated drive, on a simulated bus in virtual time.
#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/gripper/canopen/tests/gripper_faults.hpp"
#include "hal/gripper/conformance/gripper_cases.hpp"
#include "hal/servo_drive/canopen/simulator/drive_console.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::gripper_cases;
namespace objects = canopen::cia402::objects;

class InProcessWorld final : public AxisGripperWorld {
 public:
  explicit InProcessWorld(const FingerAxis& axis)
      : AxisGripperWorld{axis},
        far_end_{{.node = node, .first_position = opened * axis.increments}, bus_.now()} {}
  ~InProcessWorld() override {
    driver().stop();
    if (CanWire* wire = bus_.driver().wire()) wire->detach(far_end_);
    bus_.driver().stop();
  }

  Status start(const GripperSetting& setting) override {
    configure(gripper_.configuration(), setting);
    if (const Status status = bus_.driver().initialise(); !status) return status;
    bus_.driver().wire()->attach(far_end_);
    return driver().initialise();
  }
  CanopenGripper& driver() override { return gripper_.driver(); }
  void receive() override {
    bus_.receive(cycle);
    gripper_.receive(cycle);
  }
  void send() override {
    gripper_.send();
    bus_.send();
  }
  Time now() const override { return gripper_.now(); }
  void stall(Duration time) override {
    for (Duration passed{}; passed < time; passed += cycle) bus_.receive(cycle);
  }
  std::string ask(std::string_view line) override { return far_end_.obey(line); }
  bool set_cable(bool in) override { return tell(in ? "plug" : "unplug"); }

  CanopenGripper::Configuration& configuration() { return gripper_.configuration(); }
  DriveObjects& drive_objects() { return far_end_.drive().objects(); }

 private:
  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<CanopenGripper> gripper_{nullptr, {}, &bus_.driver()};
  DriveConsole far_end_;
};

constexpr FingerAxis absolute{};
constexpr FingerAxis homed{.increments = -2e5, .homes = true};
constexpr FingerAxis without_torque{.has_torque = false};

template <const FingerAxis& Axis>
int run(const char* name) {
  return run_gripper_conformance(
      name, []() -> std::unique_ptr<GripperWorld> { return std::make_unique<InProcessWorld>(Axis); });
}

bool force_is_the_limit_of_its_torque() {
  const auto world = std::make_unique<InProcessWorld>(absolute);
  if (!starts_active(*world) || !world->put_object(0.03)) return false;
  for (const auto& [force, torque] : {std::pair{60.0, 600U}, {1e6, 1000U}, {0.5, 100U}}) {
    if (!goes_to(*world, opened)) return false;
    const GripperGoal goal{.opening = closed, .force = force};
    act(*world, [&](Gripper& gripper) { gripper.command(goal); });
    if (!comes_to_rest(*world) || object(*world) != GripperObject::gripped) return false;
    idle_for(*world, std::chrono::milliseconds(50));
    if (world->drive_objects().get(objects::most_torque) != torque) return false;
    if (world->drive_objects().get_signed(objects::actual_torque) != -static_cast<int>(torque)) return false;
  }
  return world->gripper().trouble().is_ok();
}

bool its_force_is_limited_while_it_homes() {
  const auto world = std::make_unique<InProcessWorld>(homed);
  if (!world->start({}) || !until(*world, [&] { return world->gripper().state().has_value(); })) return false;
  act(*world, [](Gripper& gripper) { gripper.activate(); });
  return until(*world, [&] { return world->fingers() < opened - 0.005; }) && !is_activated(*world) &&
         world->drive_objects().get(objects::most_torque) == 400;
}

// In the midst of finding out that it grips.
bool what_it_presses_on_is_not_let_go_by_a_halt() {
  const auto world = std::make_unique<InProcessWorld>(absolute);
  if (!starts_active(*world) || !world->put_object(0.03)) return false;
  act(*world, [](Gripper& gripper) { gripper.close(); });
  const auto torque = [&] { return world->drive_objects().get_signed(objects::actual_torque); };
  if (!until(*world, [&] { return torque() == -400; })) return false;
  idle_for(*world, std::chrono::milliseconds(21));
  if (rests(*world)) return false;
  act(*world, [](Gripper& gripper) { gripper.halt(); });
  idle_for(*world, std::chrono::milliseconds(300));
  return object(*world) == GripperObject::gripped && torque() == -400 && rests(*world);
}

bool drive_that_cannot_limit_its_torque_says_so_and_grips() {
  const auto world = std::make_unique<InProcessWorld>(without_torque);
  if (!world->tell("lack 6072:00") || !world->tell("lack 6077:00") || !starts_active(*world)) return false;
  if (world->gripper().capabilities().force || !world->put_object(0.03)) return false;
  return goes_to(*world, closed) && object(*world) == GripperObject::gripped;
}

bool drive_without_an_object_that_is_needed_is_told() {
  const auto world = std::make_unique<InProcessWorld>(absolute);
  if (!world->tell("lack 6072:00") || !world->start({})) return false;
  return until(*world, [&] {
    const Status& trouble = world->gripper().trouble();
    return trouble.code() == StatusCode::device_fault &&
           std::string_view(trouble.cause()).find("1601:02") != std::string_view::npos;
  });
}

// What a drive lacks is a column here as it is of a servo drive.
bool drive_without_a_heartbeat_is_guarded_and_grips() {
  const auto world = std::make_unique<InProcessWorld>(absolute);
  if (!world->tell("lack 1017") || !world->tell("lack 1016:01")) return false;
  world->configuration().guarded = true;
  world->configuration().supervises_us = false;
  if (!starts_active(*world) || !world->put_object(0.03)) return false;
  return goes_to(*world, closed) && object(*world) == GripperObject::gripped &&
         world->drive_objects().get(canopen::objects::guard_time) == 100;
}

bool drive_whose_mode_is_in_no_pdo_is_homed_and_grips() {
  const auto world = std::make_unique<InProcessWorld>(homed);
  if (!world->tell("unmap 6060") || !world->tell("unmap 6061")) return false;
  world->configuration().maps_mode = false;
  if (!starts_active(*world) || !goes_to(*world, opened) || !world->put_object(0.03)) return false;
  return goes_to(*world, closed) && object(*world) == GripperObject::gripped;
}

// Fingers that are closed where the drive's position is 0 need not be at 0.
bool opening_is_counted_from_where_its_zero_is() {
  const auto world = std::make_unique<InProcessWorld>(homed);
  world->configuration().opening_at_zero = 0.01;
  if (!starts_active(*world) || !goes_to(*world, 0.05)) return false;
  const auto state = world->gripper().state();
  return state && near(*state->opening, 0.05) && near(world->fingers(), 0.04);
}

bool plans_that_make_no_sense() {
  const auto world = std::make_unique<InProcessWorld>(absolute);
  world->configuration().weakest = 200;
  if (world->start({}).code() != StatusCode::invalid_argument) return false;
  world->configuration().weakest = 10;
  world->configuration().closed_width = 0.1;
  return world->driver().initialise().code() == StatusCode::invalid_argument;
}

template <bool (*Run)()>
void holds(void**) {
  const bool good = Run();
  assert_true(good);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(holds<force_is_the_limit_of_its_torque>),
      cmocka_unit_test(holds<its_force_is_limited_while_it_homes>),
      cmocka_unit_test(holds<what_it_presses_on_is_not_let_go_by_a_halt>),
      cmocka_unit_test(holds<drive_that_cannot_limit_its_torque_says_so_and_grips>),
      cmocka_unit_test(holds<drive_without_an_object_that_is_needed_is_told>),
      cmocka_unit_test(holds<drive_without_a_heartbeat_is_guarded_and_grips>),
      cmocka_unit_test(holds<drive_whose_mode_is_in_no_pdo_is_homed_and_grips>),
      cmocka_unit_test(holds<opening_is_counted_from_where_its_zero_is>),
      cmocka_unit_test(holds<plans_that_make_no_sense>),
  };
  int failed = run<absolute>("gripper that is an axis, on a simulated bus");
  failed += run<homed>("gripper that is an axis, which is homed and counts up as it closes");
  failed += run<without_torque>("gripper that is an axis, which knows nothing of torque");
  failed += run_gripper_faults("faults of a gripper that is an axis, on a simulated bus",
                               [](const FingerAxis& axis) -> std::unique_ptr<AxisGripperWorld> {
                                 return std::make_unique<InProcessWorld>(axis);
                               });
  failed += cmocka_run_group_tests_name("gripper that is an axis", tests, nullptr, nullptr);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
