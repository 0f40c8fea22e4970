// What the arm's unit does when the unit that tells it where to go is late, in fault or stopped, and when a
// person stops all motion.
#include <cmath>

#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

const Application& trial = application::application;
constexpr std::uint16_t speed = 0;  // number of the robot's runtime parameter, as in its table

std::string holding(Running& running) {
  const nlohmann::json feedback = running.newest("robot.feedback");
  return feedback.is_null() ? "?" : feedback.at("holding").get<std::string>();
}

bool is_moving(Running& running) {
  const nlohmann::json feedback = running.newest("robot.feedback");
  return !feedback.is_null() && feedback.at("moving").get<bool>();
}

bool is_at_rest(Running& running) {
  if (is_moving(running)) return false;
  const nlohmann::json velocities = running.newest("joints", "velocity");
  if (velocities.is_null()) return false;
  for (const nlohmann::json& velocity : velocities)
    if (std::abs(velocity.get<double>()) > 1e-3) return false;
  return true;
}

double way(Running& running, double from) {
  return running.newest("tool_pose").at("position").at(1).get<double>() - from;
}

/// Where the arm is. Its motions are slow: one that is to be ended on its way is under way for longer than
/// whoever looks for it may be kept from its CPU.
double wait_for_start(Running& running) {
  for (const char* slot : {"target", "tool_pose"})  // of two units
    CHECK(wait_until([&] { return !running.newest(slot).is_null(); }));
  ParameterRequest slow;
  slow.component = running.unit("robot");
  const double part = 0.02;
  CHECK(slow.add(speed, 0, &part, sizeof(part)));
  CHECK_EQUAL(running.ask(slow).kind, AnswerKind::accepted);
  return running.newest("tool_pose").at("position").at(1);
}

/// The arm is under way when its target becomes NULL: it stops short of it, and holds.
void check_holds(Running& running, double start, const char* reason) {
  CHECK(wait_until([&] { return holding(running) == reason; }));
  CHECK(wait_until([&] { return is_at_rest(running); }));
  CHECK(way(running, start) < 0.29);
  CHECK_EQUAL(running.state("robot").life.load(), Life::running);
}

void the_arm_holds_when_its_target_is_late() {
  Running running(trial);
  wait_for_start(running);
  CHECK(wait_until([&] { return holding(running).empty(); }));
  running.type("l");
  CHECK(wait_until([&] { return holding(running) == "too old"; }));
  CHECK_EQUAL(running.state("saboteur").life.load(), Life::running);
  CHECK_EQUAL(running.stop().exit_code, 0);
}

// [stop-35]
void the_arm_holds_when_the_writer_is_in_fault() {
  Running running(trial);
  const double start = wait_for_start(running);
  running.type("m");
  CHECK(wait_until([&] { return is_moving(running); }));
  running.type("f");
  check_holds(running, start, "writer in fault");
  CHECK_EQUAL(running.stop().exit_code, 2);
}

void the_arm_holds_when_the_writer_is_stopped() {
  Running running(trial);
  const double start = wait_for_start(running);
  running.type("m");
  CHECK(wait_until([&] { return is_moving(running); }));
  running.executive().lifecycle().post(
      [&running] { static_cast<void>(running.executive().lifecycle().stop(running.unit("saboteur"))); });
  // The writer owns a drive: when it is stopped, nothing moves before the next Start.
  check_holds(running, start, "motion is inhibited");
  CHECK(wait_until([&] { return running.state("saboteur").life.load() == Life::stopped; }));
  running.start_motion();
  check_holds(running, start, "writer stopped");
  CHECK_EQUAL(running.stop().exit_code, 0);
}

// [stop-3] [stop-5] [stop-8] [stop-11]
void stop_motion_is_a_latch() {
  Running running(trial);
  const double start = wait_for_start(running);
  running.type("m");
  CHECK(wait_until([&] { return is_moving(running); }));
  running.control().stop_motion();
  check_holds(running, start, "motion is inhibited");
  const double place = way(running, start);
  CHECK(!running.control().start_motion());
  running.control().clear_stop_motion();
  CHECK_EQUAL(holding(running), "motion is inhibited");
  running.start_motion();
  // What was wanted before the Start is not followed after it.
  CHECK(wait_until([&] { return holding(running).empty(); }));
  CHECK(wait_until([&] { return is_at_rest(running); }));
  CHECK(std::abs(way(running, start) - place) < 2e-3);
  running.type("m");
  CHECK(wait_until([&] { return is_moving(running); }));
  CHECK_EQUAL(running.stop().exit_code, 0);
}

/// Full of keys that nobody takes, the keyboard's thread must not go round without end.
void keys_that_nobody_takes_cost_no_time() {
  Running running(trial);
  wait_for_start(running);
  running.type("f" + std::string(1000, '.'));
  CHECK(wait_until([&] { return running.state("saboteur").life.load() == Life::fault; }));
  const QueueRecord& queue = running.application().queues[0];
  CHECK(wait_until([&] {
    return queue.sinks[0]->counters().pushed - queue.sinks[0]->counters().popped >= queue.capacity;
  }));
  const auto& threads = running.application().threads;
  std::size_t thread = 0;
  while (std::string{threads[thread].name} != "keyboard") ++thread;
  const std::atomic<std::uint64_t>& cycles = running.application().thread_states[thread].cycles;
  // All that is counted lies within the time that is measured, also where this thread stands still.
  const auto began = MonotonicClock::now();
  const std::uint64_t before = cycles;
  CHECK(wait_until([&] { return cycles > before + 20; }));
  const auto made = static_cast<double>(cycles - before);
  const std::chrono::duration<double> took = MonotonicClock::now() - began;
  // A thread that spins makes tens of thousands of them in this time.
  CHECK(made / took.count() < 2000);
  CHECK_EQUAL(running.stop().exit_code, 2);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(the_arm_holds_when_its_target_is_late),
      TEST_APART(the_arm_holds_when_the_writer_is_in_fault),
      TEST_APART(the_arm_holds_when_the_writer_is_stopped),
      TEST_APART(stop_motion_is_a_latch),
      TEST_APART(keys_that_nobody_takes_cost_no_time),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
