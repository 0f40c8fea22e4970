#include "benchmarks/visual_servoing/wall_cell.hpp"

#include <sched.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "runtime/realtime/machine_file.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::bench {
namespace {

[[noreturn]] void give_up(const char* what, std::string_view name) {
  std::fprintf(stderr, "visual_servoing: the application has no %s %.*s\n", what,
               static_cast<int>(name.size()), name.data());
  std::exit(1);
}

}  // namespace

WallCell::WallCell()
    : application_(&flexrf::application::application),
      executive_(flexrf::application::application, Options{}) {}

bool WallCell::run(const std::function<void()>& beside) {
  const Result<MachineFile> machine = MachineFile::of_this_machine();
  if (const Status status = machine ? executive_.prepare() : machine.status(); !status) {
    std::fprintf(stderr, "visual_servoing: %s\n", status.cause());
    return false;
  }
  control_ = machine->cpus_of(CpuRole::control);
  rest_ = machine->rest(control_);
  realtime_ = executive_.options().realtime;
  executive_.cell().keep_step_traces();
  std::atomic<bool> ended{false};
  std::thread measuring{[&] {
    sched_setaffinity(0, sizeof(cpu_set_t), &rest_.mask());
    const ThreadState& control = state(threads("control").front());
    while (control.cycles == 0 && !ended) pause(0.01);
    if (!ended) beside();
    executive_.request_end();
  }};
  const RunSummary summary = executive_.run();
  ended = true;
  measuring.join();
  if (summary.exit_code != 0) std::fprintf(stderr, "visual_servoing: it ended with %d\n", summary.exit_code);
  return summary.exit_code == 0;
}

std::vector<std::size_t> WallCell::threads(std::string_view name) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < application().threads.size(); ++i)
    if (std::string_view{application().threads[i].name}.starts_with(name)) found.push_back(i);
  if (found.empty()) give_up("thread", name);
  return found;
}

Duration WallCell::cpu_time(std::string_view name) const {
  Duration sum{};
  for (const std::size_t thread : threads(name)) {
    std::ifstream file{"/proc/self/task/" + std::to_string(state(thread).thread_id) + "/schedstat"};
    std::int64_t nanoseconds = 0;
    if (file >> nanoseconds) sum += Duration{nanoseconds};
  }
  return sum;
}

const SlotRecord& WallCell::slot(const char* name) const {
  for (const SlotRecord& slot : application().slots)
    if (std::strcmp(slot.name, name) == 0) return slot;
  give_up("slot", name);
}

std::uint64_t WallCell::published(std::string_view name) const {
  std::uint64_t sum = 0;
  for (const SlotRecord& slot : application().slots)
    if (std::string_view{slot.name}.starts_with(name)) sum += slot.control->published();
  return sum;
}

std::uint16_t WallCell::unit(std::string_view name) const {
  for (std::size_t i = 0; i < application().units.size(); ++i)
    if (name == application().units[i].name) return static_cast<std::uint16_t>(i);
  give_up("unit", name);
}

void pause(double seconds) {
  std::this_thread::sleep_for(duration_of(seconds));
}

}  // namespace flexrf::bench
