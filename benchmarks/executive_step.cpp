// What one unit costs per step beside its own work: 500 units in one thread, each with one input, one output
// and feedback, stepped as the thread's loop steps them, without the clock reads that measure each step.
#include <thread>

#include "benchmarks/harness.hpp"
#include "runtime/executive/lifecycle.hpp"
#include "runtime/executive/stepper.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

/// The generated application with everything initialised, and its one thread's stepper.
class ManyUnits {
 public:
  ManyUnits() : cell_(application::application, options_), lifecycle_(cell_, false), stepper_(cell_, 0) {}

  Status start() {
    if (const Status status = cell_.construct(); !status) return status;
    cell_.keep_step_traces();  // as with a panel
    if (const Status status = lifecycle_.start_all(); !status) return status;
    cell_.control().permit_motion_at_power_on();
    cell_.control().rise_to(Mode::running);
    return {};
  }
  /// One release, with what the loop does before it.
  void release(Time now) {
    stepper_.serve(now);
    end_ = stepper_.run(Release{now, now, 0, false});
  }
  /// As while the panel shows who works when.
  void note_steps(bool on) { cell_.step_traces()->ask(on ? Time::max() : Time{}); }
  std::size_t units() const { return application::application.units.size(); }
  std::uint64_t steps() const { return application::application.unit_states.back().steps.load(); }

 private:
  Options options_;
  Cell cell_;
  Lifecycle lifecycle_;
  Stepper stepper_;
  Time end_{};
};

int run(int argument_count, char** arguments) {
  Report report{"executive_step", argument_count, arguments};
  settle_thread(static_cast<int>(std::thread::hardware_concurrency()) - 1, 50);
  ManyUnits cell;
  if (const Status status = cell.start(); !status) {
    std::fprintf(stderr, "executive_step: %s\n", status.cause());
    return 1;
  }
  const auto release = [&] { cell.release(MonotonicClock::now()); };
  const auto read_clock = [] {
    const Time now = MonotonicClock::now();
    touch(&now);
  };
  const int blocks = report.choose(40, 10);
  const std::uint64_t releases = calls_in(report.choose<Duration>(100ms, 20ms), release);
  const std::uint64_t clock_reads = calls_in(report.choose<Duration>(20ms, 5ms), read_clock);
  const auto units = static_cast<double>(cell.units());
  std::vector<double> apart;
  std::vector<double> clock;
  std::vector<double> whole;
  std::vector<double> noted;
  for (int block = 0; block < blocks; ++block) {
    clock.push_back(nanoseconds_per_call(clock_reads, read_clock));
    whole.push_back(nanoseconds_per_call(releases, release) / units);
    // One reading for each unit, and two for the release.
    const double clock_share = clock.back() * (units + 2) / units;
    apart.push_back(whole.back() - clock_share);
    cell.note_steps(true);
    noted.push_back(nanoseconds_per_call(releases, release) / units - clock_share);
    cell.note_steps(false);
  }
  if (cell.steps() < releases) {
    std::fprintf(stderr, "executive_step: the units did not step\n");
    return 1;
  }
  report.add({"per unit and step, clock reads apart", "ns", estimate(apart), 60, true,
              text("500 units in one thread, each one input, one output, feedback; %d blocks", blocks)});
  report.add({"while the panel shows who works when", "ns", estimate(noted), 0, false,
              "likewise, with each step noted"});
  report.add({"with the clock read", "ns", estimate(whole), 0, false, "what a step costs in the report"});
  report.add({"one clock read", "ns", estimate(clock), 0, false, ""});
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
