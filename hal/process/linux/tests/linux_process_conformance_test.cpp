// The driver with the machine's shell as its program.
#include <signal.h>
#include <time.h>

#include <cstdio>
#include <optional>
#include <string>

#include "hal/process/conformance/process_conformance.hpp"
#include "hal/process/linux/linux_process.hpp"

namespace {

using namespace flexrf;

const char* script_of(ProgramPart part) {
  switch (part) {
    case ProgramPart::echoes:
      return "exec cat";
    case ProgramPart::speaks_and_exits:
      return "echo one; echo three >&2; echo two; printf rest; exit 3";
    case ProgramPart::dies:
      return "kill -KILL $$";
    case ProgramPart::tells_itself:
      return "echo \"$1\"; echo \"$GREETING\"";
    case ProgramPart::disobeys:
      return "trap \"\" TERM; echo ready; while :; do sleep 1; done";
    case ProgramPart::floods:
      return "i=0; while [ $i -lt 1000 ]; do echo line $i; i=$((i+1)); done";
    case ProgramPart::reads_nothing:
      return "echo ready; exec sleep 1000";
    case ProgramPart::leaves_children:
      return "setsid sleep 2 & echo ready";
    case ProgramPart::is_missing:
      break;
  }
  return "";
}

class RealWorld final : public ProcessWorld {
 public:
  Status start(ProgramPart part, const ProcessWishes& wishes, std::span<QueueSink* const> sinks) override {
    bench_.emplace(nullptr, sinks);
    auto& configuration = bench_->configuration();
    configuration.set_executable(part == ProgramPart::is_missing ? "/nowhere/nothing" : "/bin/sh");
    configuration.set_arguments(std::string("-c '") + script_of(part) + "' name 'two words'");
    configuration.set_environment("GREETING='good day'");
    configuration.start = wishes.start;
    configuration.restart = wishes.restart;
    configuration.restart_shortest = 0.002;
    configuration.restart_longest = seconds(wishes.restart_longest);
    configuration.start_timeout = 30.0;
    configuration.stop_timeout = seconds(wishes.stop_timeout);
    return bench_->driver().initialise();
  }
  Process& process() override { return bench_->driver(); }
  const ProcessFeedback& feedback() override { return bench_->feedback(); }
  void receive() override {
    const timespec millisecond{0, 1'000'000};
    nanosleep(&millisecond, nullptr);
    bench_->receive(MonotonicClock::now() - bench_->now());
  }
  void send() override { bench_->send(); }
  /// One that has ended and that nobody has asked about is not there.
  bool is_there(int id) override {
    const std::string path = "/proc/" + std::to_string(id) + "/stat";
    std::FILE* file = std::fopen(path.c_str(), "r");
    if (file == nullptr) return false;
    char state = 'Z';
    const bool read = std::fscanf(file, "%*d (%*[^)]) %c", &state) == 1;
    std::fclose(file);
    return read && state != 'Z' && state != 'X';
  }
  bool lose_helper() override { return kill(bench_->driver().helper(), SIGKILL) == 0; }

 private:
  std::optional<DeviceBench<LinuxProcess>> bench_;
};

}  // namespace

int main() {
  return run_process_conformance(
      "linux process", []() -> std::unique_ptr<ProcessWorld> { return std::make_unique<RealWorld>(); });
}
