// A whole application, piped and scripted, on the wall clock and in virtual time: the arm must stand where
// the keys said. Linked with either of the two applications.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "hal/interfaces/robot_arm/pose_conversion.hpp"
#include "runtime/executive/executive.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::application {
extern const Application application;
}  // namespace flexrf::application

namespace {

using namespace flexrf;
using application::application;

constexpr double tolerance = 1e-3;  // m: the sensors' noise, and what the servos lag at the end
const std::string script = "/tmp/flexrf_keyboard_" + std::to_string(getpid()) + ".keys";

Options in_virtual_time() {
  Options options;
  options.virtual_time = std::chrono::seconds(60);
  options.keys_file = script;
  options.hardware = {{"keyboard", "script"}};
  options.digest = true;
  return options;
}

Options on_the_wall_clock() {
  Options options;
  options.realtime = false;  // the test must pass without the right
  return options;
}

/// What the tool's pose was last; null when it was never published.
const Pose* tool_pose() {
  for (const SlotRecord& slot : application.slots) {
    if (std::strcmp(slot.name, "tool_pose") != 0 || slot.observer == nullptr) continue;
    std::uint8_t held = SlotControl::none;
    slot.control->take(held);
    if (held == SlotControl::none) return nullptr;
    return static_cast<const Pose*>(static_cast<const void*>(slot.control->payload(held)));
  }
  return nullptr;
}

bool stands_at(double x, double y, double z) {
  const Pose home = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
  const Pose* pose = tool_pose();
  if (pose == nullptr) return false;
  const double off =
      std::hypot(pose->position[0] - home.position[0] - x, pose->position[1] - home.position[1] - y,
                 pose->position[2] - home.position[2] - z);
  if (off > tolerance) {
    std::fprintf(stderr, "the tool is %.1f mm away from where the keys send it\n", off * 1e3);
  }
  return off <= tolerance;
}

bool lost_no_key(std::uint64_t count) {
  for (const QueueRecord& queue : application.queues) {
    const QueueCounters counters = queue.sinks[0]->counters();
    if (counters.pushed != count || counters.popped != count || counters.dropped != 0) return false;
  }
  return true;
}

RunSummary run(const Options& options) {
  Executive executive(application, options);
  if (const Status status = executive.prepare(); !status) {
    std::fprintf(stderr, "%s\n", status.cause());
    RunSummary failed;
    failed.exit_code = 1;
    return failed;
  }
  return executive.run();
}

/// An application runs once in a process: each case has its own, which tells `answer` through a pipe.
struct Outcome {
  bool passed;
  std::uint64_t answer;
};
Outcome in_a_process(const std::function<Outcome()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    const Outcome outcome = work();
    const bool told = write(ends[1], &outcome, sizeof(outcome)) == sizeof(outcome);
    _exit(told ? 0 : 1);
  }
  close(ends[1]);
  Outcome outcome{};
  const bool told = read(ends[0], &outcome, sizeof(outcome)) == sizeof(outcome);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return told && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? outcome : Outcome{};
}

/// The keys are in the pipe, and it is closed, before the application starts.
void pipe_in(const std::string& keys) {
  int ends[2];
  if (pipe(ends) != 0 || write(ends[1], keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
    _exit(1);
  close(ends[1]);
  dup2(ends[0], STDIN_FILENO);
}

void write_script(const char* lines) {
  std::ofstream(script) << lines;
}

bool ended_with_its_input(const RunSummary& summary) {
  return summary.exit_code == 0 && summary.cause == EndCause::end_of_input && !summary.cut_short;
}

void piped_keys_move_the_arm(void**) {
  const bool passed =
      in_a_process([] {
        pipe_in("wwwwddd\n");
        const RunSummary summary = run(on_the_wall_clock());
        return Outcome{ended_with_its_input(summary) && stands_at(0.04, -0.03, 0) && lost_no_key(7), 0};
      }).passed;
  assert_true(passed);
}

// Far more than the queue holds, there and back.
void a_flood_of_keys_loses_none(void**) {
  const bool passed =
      in_a_process([] {
        std::string keys = "qq";
        for (int n = 0; n < 2000; ++n) keys += "wsad";
        pipe_in(keys);
        const RunSummary summary = run(on_the_wall_clock());
        return Outcome{ended_with_its_input(summary) && stands_at(0, 0, 0.02) && lost_no_key(8002), 0};
      }).passed;
  assert_true(passed);
}

void no_keys_no_motion(void**) {
  const bool passed = in_a_process([] {
                        pipe_in("");
                        const RunSummary summary = run(on_the_wall_clock());
                        return Outcome{summary.exit_code == 0 && stands_at(0, 0, 0), 0};
                      }).passed;
  assert_true(passed);
}

void a_script_moves_the_arm_in_virtual_time(void**) {
  write_script("0.5 w\n0.5 w\n0.7 w\n1.0 w\n1.2 d\n1.2 d\n2.5 d  # the last\n");
  const bool passed =
      in_a_process([] {
        const RunSummary summary = run(in_virtual_time());
        return Outcome{ended_with_its_input(summary) && summary.run_time > std::chrono::milliseconds(2500) &&
                           stands_at(0.04, -0.03, 0) && lost_no_key(7),
                       0};
      }).passed;
  assert_true(passed);
}

/// Digest of a run, and the bits of one joint-dependent number of it.
Outcome digest_of_seed(std::uint64_t seed, bool of_pose) {
  return in_a_process([seed, of_pose] {
    Options options = in_virtual_time();
    options.seed = seed;
    const RunSummary summary = run(options);
    std::uint64_t bits = 0;
    if (const Pose* pose = tool_pose(); pose != nullptr)
      std::memcpy(&bits, pose->position.data(), sizeof(bits));
    return Outcome{summary.digest.has_value(), of_pose ? bits : summary.digest.value_or(0)};
  });
}

void same_seed_same_run(void**) {
  write_script("0.5 w\n0.6 d\n");
  const Outcome first = digest_of_seed(1, false);
  assert_true(first.passed);
  assert_true(digest_of_seed(1, false).answer == first.answer);
  assert_true(digest_of_seed(2, false).answer != first.answer);
  assert_true(digest_of_seed(2, true).answer != digest_of_seed(1, true).answer);
}

void a_broken_script_is_cited(void**) {
  write_script("0.5 w\nlater d\n");
  const bool passed = in_a_process([] { return Outcome{run(in_virtual_time()).exit_code != 0, 0}; }).passed;
  assert_true(passed);
}

int remove_script(void**) {
  return std::remove(script.c_str()) == 0 ? 0 : 1;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(piped_keys_move_the_arm), cmocka_unit_test(a_flood_of_keys_loses_none),
      cmocka_unit_test(no_keys_no_motion),       cmocka_unit_test(a_script_moves_the_arm_in_virtual_time),
      cmocka_unit_test(same_seed_same_run),      cmocka_unit_test(a_broken_script_is_cited),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_script);
}
