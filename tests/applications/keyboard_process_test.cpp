// The two keyboard applications as processes: keys in, the arm's pose out of the report; the digest; the
// exit codes; flooded input.
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

const std::string application = place::application;  // the executable
const std::string name = APPLICATION_NAME;

constexpr double tolerance = 1e-3;  // m: the sensors' noise, and what the servos lag at the end

using Place = std::array<double, 3>;

Place tool_in(const Report& report) {
  Place place{};
  const nlohmann::json& position = report.last("tool_pose").at("position");
  for (std::size_t i = 0; i < place.size(); ++i) place[i] = position.at(i);
  return place;
}

/// Where the tool is when no key was pressed.
const Place& home() {
  static const Place place = [] {
    const Folder folder;
    CHECK_EQUAL(run(folder, {application, "--no-realtime", "--standstill-limit", "10min", "--panel", "off",
                             "--report", "report"})
                    .exit_code,
                0);
    return tool_in(Report(folder / "report"));
  }();
  return place;
}

void check_moved(const Report& report, double x, double y, double z) {
  const Place place = tool_in(report);
  const double off = std::hypot(place[0] - home()[0] - x, place[1] - home()[1] - y, place[2] - home()[2] - z);
  CHECK(std::isfinite(off));
  if (off > tolerance)
    throw fixture::CheckFailed{"the tool is " + std::to_string(off) + " m from where it should be"};
}

std::uint64_t presses_in(const Report& report) {
  const char* unit = name == "keyboard" ? "jog.feedback" : "robot.feedback";
  return report.last(unit).at("presses");
}

void check_finished(const Ending& ending, const Report& report) {
  CHECK_EQUAL(ending.exit_code, 0);
  CHECK_EQUAL(report["run"].at("cause").get<std::string>(), "end of input");
  CHECK(!report["run"].at("cut_short").get<bool>());
  CHECK_CONTAINS(ending.output, "\nFinished: end of input after ");
}

// ---- the pose

// [stop-30] [stop-71]
void piped_keys_move_the_arm() {
  for (const bool realtime : {true, false}) {
    const Folder folder;
    std::vector<std::string> words{application, "--panel",  "off",   "--standstill-limit",
                                   "10min",     "--report", "report"};
    if (!realtime) words.push_back("--no-realtime");
    const Ending ending = run(folder, words, "wwwwddd");
    const Report report(folder / "report");
    check_finished(ending, report);
    check_moved(report, 0.04, -0.03, 0);
    CHECK_EQUAL(presses_in(report), 7U);
    // Without the rights both are the same.
    if (realtime && geteuid() == 0) CHECK(report["run"].at("realtime").get<bool>());
    if (!realtime) CHECK(!report["run"].at("realtime").get<bool>());
  }
}

void a_script_moves_the_arm_in_virtual_time() {
  const Folder folder;
  write_file(folder / "keys", "0.5 w\n0.5 w\n0.7 w\n1.0 w\n1.2 d\n1.2 d\n2.5 d\n3.0 q\n");
  const Ending ending =
      run(folder, {application, "--virtual-time", "60s", "--keys", "keys", "--report", "report"});
  const Report report(folder / "report");
  check_finished(ending, report);
  check_moved(report, 0.04, -0.03, 0.01);
  CHECK(report["run"].at("run_time_ns").get<std::int64_t>() > 3'000'000'000);
}

// ---- virtual time

struct VirtualRun {
  std::string digest;
  double first_joint;
};

VirtualRun run_with_seed(const std::string& seed) {
  const Folder folder;
  write_file(folder / "keys", "0.5 w\n0.6 d\n");
  const Ending ending = run(folder, {application, "--virtual-time", "60s", "--keys", "keys", "--seed", seed,
                                     "--digest", "--report", "report"});
  CHECK_EQUAL(ending.exit_code, 0);
  CHECK(ending.output.ends_with("\n"));
  const std::string text = ending.output.substr(0, ending.output.size() - 1);
  const Report report(folder / "report");
  VirtualRun result{text.substr(text.rfind('\n') + 1), report.last("arm.feedback").at("position").at(0)};
  CHECK_EQUAL(report["run"].at("digest").get<std::string>(), result.digest);
  return result;
}

// [exec-54]
void same_seed_same_digest_another_seed_another_joint() {
  const VirtualRun first = run_with_seed("1");
  const VirtualRun second = run_with_seed("1");
  const VirtualRun other = run_with_seed("2");
  CHECK_EQUAL(first.digest, second.digest);
  CHECK_EQUAL(first.first_joint, second.first_joint);
  CHECK(first.digest != other.digest);
  CHECK(first.first_joint != other.first_joint);
  CHECK_EQUAL(first.digest.size(), 16U);
  CHECK_EQUAL(first.digest.find_first_not_of("0123456789abcdef"), std::string::npos);
}

// [stop-71]
void virtual_time_ends_when_it_is_over_and_says_so() {
  const Folder folder;
  write_file(folder / "keys", "0.5 w\n5.0 w\n");
  const Ending ending =
      run(folder, {application, "--virtual-time", "2s", "--keys", "keys", "--report", "report"});
  CHECK_EQUAL(ending.exit_code, 0);
  CHECK_CONTAINS(ending.output, "\nFinished: the virtual time asked for is over after 2");
  const Report report(folder / "report");
  CHECK_EQUAL(report["run"].at("cause").get<std::string>(), "virtual time over");
  check_moved(report, 0.01, 0, 0);
}

// ---- the exit codes

// [stop-72]
void wrong_usage_is_1_and_names_the_nearest() {
  const Folder folder;
  const Ending unknown = run(folder, {application, "--virtual-tine", "2s"});
  CHECK_EQUAL(unknown.exit_code, 1);
  CHECK_CONTAINS(unknown.errors, "did you mean `--virtual-time`?");
  CHECK_EQUAL(run(folder, {application, "--keys"}).exit_code, 1);
  CHECK_CONTAINS(run(folder, {application, "--panel-edit-timeout", "5"}).errors, "with its unit");
  CHECK_EQUAL(run(folder, {application, "--hardware", "arm=real"}).exit_code, 1);
  const Ending no_file = run(folder, {application, "--virtual-time", "2s", "--keys", "not_there"});
  CHECK(no_file.exit_code != 0);
  CHECK_CONTAINS(no_file.errors, "not_there");
}

// [stop-17] [stop-75]
void a_signal_lets_the_arm_come_to_rest() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Folder folder;
    Process process(folder, {application, "--no-realtime", "--standstill-limit", "10min", "--panel", "off",
                             "--report", "report"});
    // The way is long enough to be under way still when the signal comes.
    process.type(std::string(30, 'a'));
    process.wait_for_error("autostart");
    process.send(signal);
    const Ending ending = process.wait();
    CHECK_EQUAL(ending.exit_code, 128 + signal);
    const Report report(folder / "report");
    CHECK_EQUAL(report["run"].at("cause").get<std::string>(), "signal");
    CHECK_EQUAL(report["run"].at("signal").get<int>(), signal);
    CHECK(!report["run"].at("cut_short").get<bool>());
    CHECK(!report["run"].at("fault").get<bool>());
  }
}

/// Whoever reads the panel's address may end it at once, before any of its threads runs.
void a_signal_at_the_start_is_a_controlled_stop() {
  for (int n = 0; n < 5; ++n) {
    const Folder folder;
    Process process(folder, {application, "--no-realtime", "--standstill-limit", "10min", "--panel",
                             "127.0.0.1:0", "--report", "report"});
    process.wait_for_error("Panel: ");
    process.send(SIGTERM);
    CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
    CHECK_EQUAL(Report(folder / "report")["run"].at("cause").get<std::string>(), "signal");
  }
}

/// The end of virtual time is a controlled stop like any other, at an instant that every run has alike.
void a_moving_arm_comes_to_rest_on_its_way() {
  const Folder folder;
  std::string keys;
  for (int n = 0; n < 30; ++n) keys += "0.1 a\n";
  write_file(folder / "keys", keys + "50 a\n");
  const Ending ending =
      run(folder, {application, "--virtual-time", "160ms", "--keys", "keys", "--report", "report"});
  CHECK_EQUAL(ending.exit_code, 0);
  const Report report(folder / "report");
  CHECK(!report["run"].at("cut_short").get<bool>());
  // It was under way, went on while it decelerated, and stands between start and target, where its servos
  // hold.
  const double way = tool_in(report)[1] - home()[1];
  CHECK(way > 0.005 && way < 0.15);
  CHECK(report["run"].at("run_time_ns").get<std::int64_t>() > 200'000'000);
  for (const nlohmann::json& error : report.last("arm.feedback").at("following_error"))
    CHECK(std::abs(error.get<double>()) < 2e-3);
}

/// The same keys, and nobody gives Start.
// [stop-91]
void without_autostart_no_key_moves_the_arm() {
  const Folder folder;
  write_file(folder / "keys", "0.1 a\n0.1 a\n");
  const Ending ending = run(folder, {application, "--virtual-time", "2s", "--keys", "keys", "--report",
                                     "report", "--no-autostart"});
  CHECK_EQUAL(ending.exit_code, 0);
  CHECK_CONTAINS(ending.errors, "nothing moves before a Start");
  check_moved(Report(folder / "report"), 0, 0, 0);
}

// [stop-7] [stop-66] [stop-70] [stop-73]
void a_second_start_names_the_holder() {
  const Folder folder;
  Process first(folder, {application, "--no-realtime", "--standstill-limit", "10min", "--panel", "off"});
  first.wait_for_error("autostart");
  const Ending second =
      run(folder, {application, "--no-realtime", "--standstill-limit", "10min", "--panel", "off"});
  CHECK_EQUAL(second.exit_code, 2);
  CHECK_CONTAINS(second.errors, "is run already by process " + std::to_string(first.id()) + " (");
  // Simulated, it touches nothing of the cell.
  write_file(folder / "keys", "0.1 w\n");
  CHECK_EQUAL(run(folder, {application, "--virtual-time", "1s", "--keys", "keys"}).exit_code, 0);
  first.end_input();
  CHECK_EQUAL(first.wait().exit_code, 0);
  CHECK_EQUAL(
      run(folder, {application, "--no-realtime", "--standstill-limit", "10min", "--panel", "off"}).exit_code,
      0);
}

// ---- floods

void ten_thousand_keys_are_all_counted() {
  const Folder folder;
  std::string keys;
  for (int n = 0; n < 2500; ++n) keys += "wsad";
  const Ending ending = run(
      folder,
      {application, "--no-realtime", "--standstill-limit", "10min", "--panel", "off", "--report", "report"},
      keys);
  const Report report(folder / "report");
  check_finished(ending, report);
  CHECK_EQUAL(presses_in(report), 10'000U);
  check_moved(report, 0, 0, 0);
  for (const nlohmann::json& queue : report["queues"]) {
    CHECK_EQUAL(queue.at("writers").at(0).at("pushed").get<int>(), 10'000);
    CHECK_EQUAL(queue.at("writers").at(0).at("dropped").get<int>(), 0);
  }
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(piped_keys_move_the_arm),
      CONTAINED_TEST(a_script_moves_the_arm_in_virtual_time),
      CONTAINED_TEST(same_seed_same_digest_another_seed_another_joint),
      CONTAINED_TEST(virtual_time_ends_when_it_is_over_and_says_so),
      CONTAINED_TEST(wrong_usage_is_1_and_names_the_nearest),
      CONTAINED_TEST(a_signal_lets_the_arm_come_to_rest),
      CONTAINED_TEST(a_signal_at_the_start_is_a_controlled_stop),
      CONTAINED_TEST(a_moving_arm_comes_to_rest_on_its_way),
      CONTAINED_TEST(without_autostart_no_key_moves_the_arm),
      CONTAINED_TEST(a_second_start_names_the_holder),
      CONTAINED_TEST(ten_thousand_keys_are_all_counted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
