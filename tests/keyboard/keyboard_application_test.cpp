// A whole application, piped and scripted, on the wall clock and in virtual time: the arm must stand where
// the keys said. Linked with either of the two applications.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "motion/pose_conversion.hpp"
#include "runtime/executive/executive.hpp"
#include "runtime/run/status_content.hpp"
#include "script_keyboard_driver.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"
#include "tests/waiting.hpp"

namespace flexrf::application {
extern const Application application;
}  // namespace flexrf::application

namespace {

using namespace flexrf;
using application::application;
using test::wait_until;

constexpr double tolerance = 1e-3;  // m: the sensors' noise, and what the servos lag at the end
const std::string script = "/tmp/flexrf_keyboard_" + std::to_string(getpid()) + ".keys";

Options in_virtual_time() {
  Options options;
  options.virtual_time = std::chrono::seconds(60);
  options.given.push_back({script_keyboard_driver_options, script.c_str()});
  options.hardware = {{"keyboard", "script"}};
  options.digest = true;
  return options;
}

Options on_the_wall_clock() {
  Options options;
  options.realtime = false;                             // the test must pass without the right
  options.standstill_limit = std::chrono::minutes{10};  // and on a machine that does much else
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

/// The number of a unit and of one of its runtime parameters; false: this application has no such unit.
bool find_hold(const char* unit, const char* parameter, ParameterRequest& request) {
  for (std::size_t i = 0; i < application.units.size(); ++i) {
    if (std::strcmp(application.units[i].name, unit) != 0) continue;
    request.component = static_cast<std::uint16_t>(i);
    const std::span<const ParameterDescriptor> all = application.units[i].type->runtime.parameters;
    for (std::size_t p = 0; p < all.size(); ++p) {
      if (std::strcmp(all[p].field->name, parameter) == 0)
        return request.add_name(static_cast<std::uint16_t>(p));
    }
  }
  return false;
}

/// As the observer, while it runs; 0 before it is known.
double tool_x() {
  for (const SlotRecord& slot : application.slots) {
    if (std::strcmp(slot.name, "tool_pose") != 0 || slot.observer->newest() == nullptr) continue;
    return static_cast<const Pose*>(slot.observer->payload())->position[0];
  }
  return 0;
}

bool is_held(const ParameterRequest& request) {
  const UnitRecord& unit = application.units[request.component];
  const FieldDescriptor& field = *unit.type->runtime.parameters[request.changes[0].parameter].field;
  for (const SlotRecord& slot : application.slots) {
    if (slot.control != unit.runtime_slot) continue;
    slot.observer->newest();
    return static_cast<const bool*>(slot.observer->payload())[field.offset];
  }
  return true;
}

/// Holds it on, or presses where it is not held, as a machine that stands still ends a hold. Waits for the
/// answer: what was asked last is not to begin a hold later. False when none comes.
bool keep_held(Cell& cell, AnswerQueue& answers, ParameterRequest& request) {
  const bool held = is_held(request);
  request.kind = held ? RequestKind::refresh : RequestKind::hold;
  if (!held) request.lease = new_lease_number();
  ++request.lease_sequence;
  cell.send(request);
  ParameterAnswer answer;
  return wait_until([&] { return answers.pop(answer); });
}

/// Until a step of this unit has begun and ended.
bool has_stepped(std::size_t unit) {
  const std::atomic<std::uint64_t>& steps = application.unit_states[unit].steps;
  const std::uint64_t before = steps.load();
  return wait_until([&] { return steps.load() >= before + 2; });
}

/// As somebody at the panel: holds an arrow until the arm has moved, is then lost, and looks on.
bool move_while_held(Executive& executive, AnswerQueue& answers, ParameterRequest request) {
  Cell& cell = executive.cell();
  if (!wait_until([&] { return cell.control().may_move() && tool_x() > 0; })) return false;
  const double begin = tool_x();
  const bool moved = wait_until([&] { return keep_held(cell, answers, request) && tool_x() > begin + 0.02; });
  // Nobody refreshes the lease: it ends, and so does the motion.
  const bool ended = wait_until([&] { return !is_held(request); });
  // The robot may not have seen yet what the last hold began.
  const bool rests = has_stepped(request.component) && has_stepped(1) &&
                     wait_until([] { return application.unit_states[1].idle.load(); });
  const double rest = tool_x();
  usleep(200'000);
  return moved && ended && rests && std::abs(tool_x() - rest) < tolerance;
}

void an_arrow_moves_the_arm_only_while_it_is_held(void**) {
  ParameterRequest request;
  if (!find_hold("jog", "plus_x", request)) skip();
  const bool passed = in_a_process([&request] {
                        int ends[2];
                        if (pipe(ends) != 0) _exit(1);
                        dup2(ends[0], STDIN_FILENO);  // a keyboard that nobody touches
                        Executive executive(application, on_the_wall_clock());
                        if (!executive.prepare()) return Outcome{};
                        static AnswerQueue answers;
                        request.requester = executive.cell().add_requester(answers);
                        bool as_expected = false;
                        std::thread person([&] {
                          as_expected = move_while_held(executive, answers, request);
                          executive.request_end();
                        });
                        const RunSummary summary = executive.run();
                        person.join();
                        return Outcome{as_expected && summary.exit_code == 0 && !summary.cut_short, 0};
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

void the_status_view_says_what_the_keys_do(void**) {
  write_script("0.5 w\n");
  const bool passed =
      in_a_process([] {
        Executive executive(application, in_virtual_time());
        if (!executive.prepare()) return Outcome{};
        std::string text;
        for (const StatusLine& line : StatusContent(executive.cell()).lines(MonotonicClock::now(), 100))
          if (line.text.starts_with("Ctrl-C ends.")) text = line.text;
        const std::size_t keys = text.find("w/s, a/d, q/e");
        return Outcome{keys != std::string::npos && text.find("w/s", keys + 1) == std::string::npos, 0};
      }).passed;
  assert_true(passed);
}

int remove_script(void**) {
  return std::remove(script.c_str()) == 0 ? 0 : 1;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(piped_keys_move_the_arm),
      cmocka_unit_test(a_flood_of_keys_loses_none),
      cmocka_unit_test(no_keys_no_motion),
      cmocka_unit_test(a_script_moves_the_arm_in_virtual_time),
      cmocka_unit_test(same_seed_same_run),
      cmocka_unit_test(a_broken_script_is_cited),
      cmocka_unit_test(the_status_view_says_what_the_keys_do),
      cmocka_unit_test(an_arrow_moves_the_arm_only_while_it_is_held),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_script);
}
