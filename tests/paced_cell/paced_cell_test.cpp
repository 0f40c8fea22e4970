// A cell whose control thread is paced by the answers of its arm's controller, in virtual time.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

#include "motion/pose_conversion.hpp"
#include "runtime/executive/executive.hpp"
#include "script_keyboard_driver.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::application {
extern const Application application;
}  // namespace flexrf::application

namespace {

using namespace flexrf;
using application::application;

struct Ending {
  int exit_code = -1;
  bool had_fault = true;
  double cycles = 0;  // of the control thread, each second
  double off = 1;     // m, of the tool from where the keys send it
};

double off_by(double x) {
  const Pose home = to_pose(forward_kinematics(six_axis, home_position(six_axis)));
  for (const SlotRecord& slot : application.slots) {
    if (std::strcmp(slot.name, "tool_pose") != 0) continue;
    std::uint8_t held = SlotControl::none;
    slot.control->take(held);
    if (held == SlotControl::none) return 1;
    const Pose* const pose = static_cast<const Pose*>(static_cast<const void*>(slot.control->payload(held)));
    return std::hypot(pose->position[0] - home.position[0] - x, pose->position[1] - home.position[1],
                      pose->position[2] - home.position[2]);
  }
  return 1;
}

Ending run(const std::string& keys) {
  Options options;
  options.virtual_time = std::chrono::seconds(60);
  options.given.push_back({script_keyboard_driver_options, keys.c_str()});
  Executive executive(application, options);
  if (const Status status = executive.prepare(); !status) {
    std::fprintf(stderr, "%s\n", status.cause());
    return {};
  }
  executive.control().permit_motion_at_power_on();  // a person's Start
  const RunSummary summary = executive.run();
  Ending ending{summary.exit_code, summary.had_fault};
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    if (std::strcmp(application.threads[i].name, "control") != 0) continue;
    ending.cycles =
        static_cast<double>(application.thread_states[i].cycles.load()) / seconds(summary.run_time);
  }
  ending.off = off_by(0.03);
  return ending;
}

void the_controllers_answers_release_the_thread(void**) {
  Ending ending;
  {
    const std::string keys = "/tmp/flexrf_paced_cell_" + std::to_string(getpid()) + ".keys";
    std::ofstream(keys) << "0.5 w\n1.0 w\n1.5 w\n5.0 w\n5.1 s\n";
    ending = run(keys);
    std::remove(keys.c_str());
  }
  assert_int_equal(ending.exit_code, 0);
  assert_false(ending.had_fault);
  // Each 7.11 ms; the timeout alone would be 66 each second.
  assert_true(ending.cycles > 138 && ending.cycles < 143);
  assert_true(ending.off < 1e-3);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(the_controllers_answers_release_the_thread)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
