// How late the releases of a periodic real-time thread are, against cyclictest with the same period, priority
// and CPU.
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <new>
#include <thread>

#include "benchmarks/harness.hpp"
#include "runtime/executive/executive.hpp"
#include "runtime/realtime/machine_file.hpp"
#include "units/lateness_probe/lateness_probe.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

/// Releases at the begin of each block that are left out: page faults of the first, cold caches.
constexpr std::size_t warming_up = 100;

struct Lateness {
  double p50 = 0;  ///< us
  double p99 = 0;
};

Lateness of(std::vector<double> microseconds) {
  return {quantile(microseconds, 0.5), quantile(microseconds, 0.99)};
}

/// What the child that runs the application tells; the samples lie behind it.
struct alignas(cache_line) Shared {
  std::atomic<std::size_t> count;
  bool realtime;
};

/// An application is run once in a process, so each block has one of its own, as cyclictest has.
class OurBlocks {
 public:
  explicit OurBlocks(std::size_t releases)
      : releases_(releases), size_(sizeof(Shared) + releases * sizeof(std::int64_t)) {
    void* memory = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    shared_ = memory == MAP_FAILED ? nullptr : new (memory) Shared{};
  }
  OurBlocks(const OurBlocks&) = delete;
  OurBlocks& operator=(const OurBlocks&) = delete;
  ~OurBlocks() {
    if (shared_ != nullptr) munmap(shared_, size_);
  }

  /// Empty when it could not be run in real time; said why on standard error.
  std::vector<double> run() {
    if (shared_ == nullptr) return {};
    shared_->count = 0;
    const pid_t child = fork();
    if (child == 0) _exit(run_application());
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0 || !shared_->realtime) return {};
    std::vector<double> microseconds;
    for (std::size_t i = warming_up; i < shared_->count; ++i) {
      microseconds.push_back(static_cast<double>(samples()[i]) * 1e-3);
    }
    return microseconds;
  }

 private:
  std::span<std::int64_t> samples() const {
    return {reinterpret_cast<std::int64_t*>(shared_ + 1), releases_};
  }

  int run_application() {
    user::lateness_record = {samples(), &shared_->count};
    Options options;
    Executive executive(application::application, options);
    if (const Status status = executive.prepare(); !status) {
      std::fprintf(stderr, "lateness: %s\n", status.cause());
      return 1;
    }
    std::thread ending{[&] {
      while (shared_->count < releases_) std::this_thread::sleep_for(20ms);
      executive.control().set_cause(EndCause::requested);
      executive.control().rise_to(Mode::stopping);
    }};
    const RunSummary summary = executive.run();
    ending.join();
    shared_->realtime = summary.realtime;
    return summary.exit_code;
  }

  std::size_t releases_;
  std::size_t size_;
  Shared* shared_;
};

/// Lines "thread: cycle: nanoseconds". Empty when it is not there or may not be real-time.
std::vector<double> run_cyclictest(std::size_t releases, const ThreadRecord& ours, int cpu, int other_cpu) {
  const std::string command = text(
      "exec cyclictest -t1 -m -N -v -i %lld -p %d -a %d --mainaffinity=%d -l %zu 2>/dev/null",
      static_cast<long long>(ours.trigger.period.count() / 1000), ours.priority, cpu, other_cpu, releases);
  FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) return {};
  std::vector<double> microseconds;
  char line[256];
  while (std::fgets(line, sizeof(line), output) != nullptr) {
    std::size_t cycle = 0;
    double nanoseconds = 0;
    if (std::sscanf(line, "%*d: %zu: %lf", &cycle, &nanoseconds) == 2 && cycle >= warming_up) {
      microseconds.push_back(nanoseconds * 1e-3);
    }
  }
  if (pclose(output) != 0) return {};
  return microseconds;
}

int run(int argument_count, char** arguments) {
  Report report{"lateness", argument_count, arguments};
  const Result<MachineFile> machine = MachineFile::of_this_machine();
  if (!machine) {
    std::fprintf(stderr, "lateness: %s\n", machine.status().cause());
    return 1;
  }
  const ThreadRecord& thread = application::application.threads[0];
  const CpuSet cpus = machine->cpus_of(thread.role);
  const int cpu = cpus.lowest();
  const int other_cpu = machine->rest(cpus).lowest();
  const int blocks = 20;
  const std::size_t releases = report.choose<std::size_t>(10'000, 500) + warming_up;
  // cyclictest forbids deep idle states while it runs: they cost either side the same.
  const NoDeepIdle no_deep_idle;
  OurBlocks ours{releases};
  Pairs p50;
  Pairs p99;
  for (int block = 0; block < blocks; ++block) {
    std::vector<double> samples[2];  // ours, cyclictest's
    for (const int turn : {0, 1}) {
      const bool is_ours = (turn + block) % 2 == 0;
      samples[is_ours ? 0 : 1] = is_ours ? ours.run() : run_cyclictest(releases, thread, cpu, other_cpu);
    }
    for (const int side : {0, 1}) {
      if (samples[side].size() * 2 > releases) continue;
      std::fprintf(stderr,
                   "lateness: %s gave no measurement: are rt-tests installed, is real time permitted?\n",
                   side == 0 ? "the application" : "cyclictest");
      return 1;
    }
    const Lateness of_ours = of(std::move(samples[0]));
    const Lateness of_cyclictest = of(std::move(samples[1]));
    p50.add(of_ours.p50, of_cyclictest.p50);
    p99.add(of_ours.p99, of_cyclictest.p99);
  }
  const std::string conditions =
      text("%d blocks of %.1f s each, 1 ms, priority %d, CPU %d", blocks,
           static_cast<double>(releases - warming_up) * 1e-3, thread.priority, cpu);
  report.add_ratio("periodic 1 ms thread, lateness against cyclictest, p50", p50, 1.05, "us", conditions);
  report.add_ratio("periodic 1 ms thread, lateness against cyclictest, p99", p99, 1.2, "us", conditions);
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
