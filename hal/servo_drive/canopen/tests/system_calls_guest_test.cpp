// What a cycle of six axes asks of the kernel, on a real interface (vcan), as root: counted by the kernel.
// The drives are another process.
#include <fcntl.h>
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hal/servo_drive/canopen/tests/real_axis.hpp"
#include "places.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr std::size_t axes = 6;
constexpr int most_cycles = 5000;  // until all are enabled
constexpr int counted_cycles = 500;
constexpr std::uint64_t most_calls = 3;

/// The system calls of the thread that made it; `filter`: which, in the kernel's words, or null: all.
class SystemCalls {
 public:
  explicit SystemCalls(const char* filter) {
    constexpr const char* tracing = "/sys/kernel/tracing";
    constexpr const char* number = "/sys/kernel/tracing/events/raw_syscalls/sys_enter/id";
    if (::access(number, R_OK) != 0) ::mount("tracefs", tracing, "tracefs", 0, nullptr);
    std::FILE* const file = std::fopen(number, "r");
    if (file == nullptr) return;
    perf_event_attr event{};
    event.type = PERF_TYPE_TRACEPOINT;
    event.size = sizeof event;
    char text[24] = {};
    if (std::fgets(text, sizeof text, file) != nullptr) event.config = std::strtoull(text, nullptr, 10);
    std::fclose(file);
    counter_ = static_cast<int>(::syscall(SYS_perf_event_open, &event, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
    if (counter_ < 0 || filter == nullptr || ::ioctl(counter_, PERF_EVENT_IOC_SET_FILTER, filter) == 0)
      return;
    ::close(counter_);
    counter_ = -1;
  }
  ~SystemCalls() {
    if (counter_ >= 0) ::close(counter_);
  }
  SystemCalls(const SystemCalls&) = delete;
  SystemCalls& operator=(const SystemCalls&) = delete;

  bool is_counting() const { return counter_ >= 0; }
  /// Until now, this one included if it is counted.
  std::uint64_t count() const {
    std::uint64_t calls = 0;
    if (::read(counter_, &calls, sizeof calls) != sizeof calls) std::abort();
    return calls;
  }

 private:
  int counter_ = -1;
};

constexpr std::uint8_t node_of(std::size_t axis) {
  return static_cast<std::uint8_t>(axis + 1);
}

/// Of the simulator's command line.
std::vector<std::string> all_drives() {
  std::vector<std::string> words{can_interface};
  for (std::size_t i = 0; i < axes; ++i) {
    words.emplace_back("--node");
    words.push_back(std::to_string(node_of(i)));
  }
  return words;
}

class SixAxes {
 public:
  SixAxes() {
    bus_->configuration().set_interface(can_interface);
    good_ = interface_.is_ready() && far_end_.is_running() && bus_->driver().initialise().is_ok();
    for (std::size_t i = 0; i < axes && good_; ++i) {
      drives_[i] = std::make_unique<DeviceBench<CanopenServoDrive>>(nullptr, std::span<QueueSink* const>{},
                                                                    &bus_->driver());
      auto& configuration = drives_[i]->configuration();
      configuration.node = node_of(i);
      configuration.fastest = 20;
      good_ = drives_[i]->driver().initialise().is_ok();
    }
  }
  ~SixAxes() {
    for (auto& drive : drives_) {
      if (drive) drive->driver().stop();
    }
    bus_->driver().stop();
  }
  SixAxes(const SixAxes&) = delete;
  SixAxes& operator=(const SixAxes&) = delete;

  bool is_good() const { return good_; }
  void wait() {
    next_ = std::max(next_ + real_cycle, MonotonicClock::now() - real_cycle);
    std::this_thread::sleep_for(next_ - MonotonicClock::now());
  }
  void cycle(double position) {
    bus_->receive(real_cycle);
    for (auto& drive : drives_) drive->receive(real_cycle);
    for (auto& drive : drives_) drive->driver().command_position(position);
    for (auto& drive : drives_) drive->send();
    bus_->send();
  }
  bool all_enabled() {
    for (auto& drive : drives_) {
      const auto state = drive->driver().state();
      if (!state || !state->enabled) return false;
    }
    return true;
  }

 private:
  VirtualInterface interface_{true};
  SimulatorProcess far_end_{place::cia402_simulator, all_drives()};
  std::unique_ptr<DeviceBench<SocketCanBus>> bus_ = std::make_unique<DeviceBench<SocketCanBus>>(nullptr);
  std::array<std::unique_ptr<DeviceBench<CanopenServoDrive>>, axes> drives_;
  Time next_ = MonotonicClock::now();
  bool good_ = false;
};

// Where the kernel's page for it serves, reading the clock is none; a guest's clock may not be of that kind.
const std::string not_the_clock = "id != " + std::to_string(SYS_clock_gettime);

bool a_cycle_asks_little() {
  const SystemCalls all(nullptr);
  const SystemCalls calls(not_the_clock.c_str());
  SixAxes cell;
  if (!calls.is_counting() || !all.is_counting() || !cell.is_good()) {
    std::printf("the kernel counts: %d; the axes are there: %d\n", calls.is_counting(), cell.is_good());
    return false;
  }
  for (int i = 0; i < most_cycles && !cell.all_enabled(); ++i) {
    cell.wait();
    cell.cycle(1);
  }
  std::uint64_t sum = 0;
  std::uint64_t sum_with_clock = 0;
  std::uint64_t most = 0;
  for (int i = 0; i < counted_cycles && cell.all_enabled(); ++i) {
    cell.wait();
    const std::uint64_t all_before = all.count();
    const std::uint64_t before = calls.count();
    cell.cycle(1 + 0.001 * i);
    const std::uint64_t made = calls.count() - before - 1;
    sum_with_clock += all.count() - all_before - 3;  // less those that count
    sum += made;
    most = std::max(most, made);
  }
  std::printf("system calls in a cycle of %zu axes: %.2f, at most %llu; with readings of the clock %.2f\n",
              axes, static_cast<double>(sum) / counted_cycles, static_cast<unsigned long long>(most),
              static_cast<double>(sum_with_clock) / counted_cycles);
  return cell.all_enabled() && sum > 0 && most <= most_calls;
}

void system_calls(void**) {
  const bool good = a_cycle_asks_little();
  assert_true(good);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(system_calls)};
  return cmocka_run_group_tests_name("system calls of a cycle of six axes on vcan", tests, nullptr, nullptr);
}
