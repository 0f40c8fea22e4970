// A cell whose control thread is paced by a controller that is another process, over UDP: in the guest, where
// a real actuator gets the priority without which it is refused, and whose clock counts.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <thread>

#include "hal/robot_arm/melfa_mxt/tests/melfa_controller.hpp"
#include "places.hpp"
#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"
#include "tests/simulator_process.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

constexpr double rest = 1e-4;       // rad
constexpr double key_step = 0.01;   // m, of the tool
constexpr double tolerance = 1e-3;  // m
constexpr Duration longest_recovery = std::chrono::seconds(2);

/// Not at home: whoever did not ask the controller would have it jump.
JointAngles start() {
  JointAngles joints = melfa_home();
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) joints[i] += 0.05;
  return joints;
}

template <class Records>
std::size_t index_of(const Records& records, std::string_view name) {
  for (std::size_t i = 0; i < records.size(); ++i)
    if (name == records[i].name) return i;
  throw fixture::CheckFailed{"there is no " + std::string{name}};
}

class LedCell {
 public:
  LedCell() : running_(application::application, options(), RightsOfATest::real_time) {
    wait_for("the tool's pose", [this] { return !running_.newest("tool_pose").is_null(); });
  }

  Running& running() { return running_; }
  SimulatorProcess& controller() { return *controller_; }
  void switch_on() { controller_.emplace(place::mxt_simulator, arguments_of_controller(port_, start())); }

  void wait_for(const char* what, const std::function<bool()>& condition) {
    if (wait_until(condition)) return;
    throw fixture::CheckFailed{std::string{"it waits in vain for "} + what + ": " + fault()};
  }
  /// A person's, until it is accepted and the arm is led.
  void give_start() {
    const std::uint64_t before = moves();
    wait_for("Start", [this] {
      running_.control().clear_stop_motion();
      return running_.control().start_motion().is_ok();
    });
    wait_for("the arm being led", [&] { return moves() > before; });
  }
  /// A person's, on the arm's page.
  void initialise_arm() {
    std::atomic<int> outcome{0};
    const auto component = static_cast<ComponentIndex>(running_.application().units.size() + arm_);
    running_.executive().act(ComponentAction::initialise, component,
                             [&outcome](const Status& status) { outcome = status ? 1 : -1; });
    wait_for("the arm anew", [&outcome] { return outcome != 0; });
    CHECK_EQUAL(outcome.load(), 1);
  }
  /// By keys, from where it is.
  void move_tool(int steps) {
    const double before = tool();
    // The next key leads on from where the target is.
    wait_for("the target", [&] {
      const nlohmann::json target = running_.newest("target", "position");
      return !target.is_null() && std::abs(target.at(0).get<double>() - before) < tolerance;
    });
    running_.type(std::string(static_cast<std::size_t>(steps), 'w'));
    wait_for("the tool", [&] { return std::abs(tool() - before - steps * key_step) < tolerance; });
  }

  /// Forward, m.
  double tool() { return running_.newest("tool_pose").at("position").at(0).get<double>(); }
  /// What the operator reads of the arm; empty while it is well.
  std::string fault() {
    const DeviceState& arm = running_.application().device_states[arm_];
    return arm.life.load() == Life::fault ? arm.fault.read().cause() : "";
  }
  std::uint64_t moves() { return static_cast<std::uint64_t>(std::atoll(controller_->ask("moves").c_str())); }
  bool stands_at_start() {
    std::istringstream told(controller_->ask("joints"));
    for (const double wanted : start()) {
      double joint = 0;
      if (!(told >> joint) || std::abs(joint - wanted) > rest) return false;
    }
    return true;
  }
  std::uint64_t cycles() { return running_.application().thread_states[control_].cycles.load(); }

 private:
  Options options() {
    switch_on();
    port_ = static_cast<std::uint16_t>(std::atoi(controller_->first_line().c_str()));
    write_file(folder_ / "cell.xml",
               R"(<flexrf application="paced_cell" format="1" descriptor="0123456789abcdef" checksum="edited">
  <device name="arm" driver="melfa_mxt"><configuration><port>)" +
                   std::to_string(port_) + "</port></configuration></device></flexrf>\n");
    Options options;
    options.hardware.push_back({"", "real"});
    options.configuration_file = folder_ / "cell.xml";
    return options;
  }

  Folder folder_;
  std::uint16_t port_ = 0;
  std::optional<SimulatorProcess> controller_;
  Running running_;
  std::size_t arm_ = index_of(running_.application().devices, "arm");
  std::size_t control_ = index_of(running_.application().threads, "control");
};

/// Each 7.11 ms; the trigger's timeout alone would be 66 each second.
void check_pace(LedCell& cell) {
  const Time since = MonotonicClock::now();
  const std::uint64_t before = cell.cycles();
  std::this_thread::sleep_for(std::chrono::seconds(2));
  const double rate = static_cast<double>(cell.cycles() - before) / seconds(MonotonicClock::now() - since);
  std::fprintf(stderr, "%.1f cycles each second\n", rate);
  CHECK(rate > 138 && rate < 143);
}

void the_controllers_answers_release_the_thread() {
  LedCell cell;
  CHECK_EQUAL(cell.moves(), 0U);  // nobody gave Start
  cell.give_start();
  const std::uint64_t begin = cell.moves();
  cell.wait_for("a hundred packets", [&] { return cell.moves() > begin + 100; });
  CHECK(cell.stands_at_start());
  cell.move_tool(3);
  check_pace(cell);
  CHECK_EQUAL(cell.controller().ask("ends"), "0");
  CHECK_EQUAL(cell.running().stop().exit_code, 0);
  CHECK_EQUAL(cell.controller().ask("session"), "ended");
  CHECK_EQUAL(cell.controller().ask("alarm"), "none");
}

/// What the operator reads, and that the arm is led again in time once the controller is back and the
/// operator has seen to it.
void check_loss(LedCell& cell, const std::function<void()>& lose, const std::function<void()>& restore) {
  cell.give_start();
  cell.move_tool(1);
  lose();
  cell.wait_for("the fault", [&] { return !cell.fault().empty(); });
  CHECK_CONTAINS(cell.fault(), "no answer from the controller at 127.0.0.1:");
  CHECK_CONTAINS(cell.fault(), "does its program still run, without an alarm, and is the cable in?");
  std::this_thread::sleep_for(std::chrono::seconds(5));
  restore();
  const Time since = MonotonicClock::now();
  cell.initialise_arm();
  cell.give_start();
  const Duration recovery = MonotonicClock::now() - since;
  std::fprintf(stderr, "led again after %lld ms\n", static_cast<long long>(recovery.count() / 1'000'000));
  CHECK(recovery < longest_recovery);
  // Not once: the very pose of before is what was wanted before, which is not done after a Start.
  cell.move_tool(2);
  CHECK_EQUAL(cell.running().stop().exit_code, 2);  // it had a fault
  CHECK_EQUAL(cell.controller().ask("session"), "ended");
  CHECK_EQUAL(cell.controller().ask("alarm"), "none");
}

void a_controller_that_stands_still_is_a_fault_until_it_is_back() {
  LedCell cell;
  check_loss(
      cell, [&] { cell.controller().pause(); }, [&] { cell.controller().resume(); });
}

void a_controller_without_power_is_a_fault_until_it_is_back() {
  LedCell cell;
  check_loss(
      cell, [&] { cell.controller().kill(); }, [&] { cell.switch_on(); });
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(the_controllers_answers_release_the_thread),
      TEST_APART(a_controller_that_stands_still_is_a_fault_until_it_is_back),
      TEST_APART(a_controller_without_power_is_a_fault_until_it_is_back),
  };
  return cmocka_run_group_tests_name("a cell paced by a MELFA controller", tests, nullptr, nullptr);
}
