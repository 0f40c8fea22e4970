// The guest's watchdog, QEMU's i6300ESB, for tests of the driver.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>

#include "hal/watchdog/conformance/watchdog_conformance.hpp"
#include "hal/watchdog/linux/linux_watchdog.hpp"

namespace flexrf {

class KernelWatchdog final : public WatchdogBenchWorld<LinuxWatchdog> {
 public:
  ~KernelWatchdog() override {
    if (forbidden_ && seteuid(0) != 0) std::perror("seteuid");
    if (other_ >= 0 && write(other_, "V", 1) == 1) close(other_);
  }

  Status start(const WatchdogSettings& settings) override {
    if (forbidden_ && seteuid(nobody) != 0) return Status::error(StatusCode::internal, "seteuid");
    return WatchdogBenchWorld::start(settings);
  }
  bool counts() override {
    std::string state;
    std::ifstream("/sys/class/watchdog/watchdog0/state") >> state;
    return state == "active";
  }
  /// The chip's: 2 * 1023 s.
  std::optional<std::uint32_t> longest() override { return 2046; }
  bool occupy() override {
    other_ = open("/dev/watchdog", O_WRONLY | O_CLOEXEC);
    return other_ >= 0;
  }
  bool forbid() override {
    forbidden_ = true;
    return true;
  }
  bool take_away() override {
    set_text(bench().configuration().device, "/dev/watchdog9");
    return true;
  }

  /// As its thread would, by the clock.
  void live_by_the_clock(Duration time, const char* missed_by) {
    Time last = MonotonicClock::now();
    for (const Time end = last + time; last < end;) {
      const timespec pause{0, 100'000'000};
      nanosleep(&pause, nullptr);
      const Time now = MonotonicClock::now();
      cycle(now - last, missed_by);
      last = now;
    }
  }

 private:
  static constexpr uid_t nobody = 65534;

  bool forbidden_ = false;
  int other_ = -1;
};

}  // namespace flexrf
