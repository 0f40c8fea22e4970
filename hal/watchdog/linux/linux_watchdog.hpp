// LinuxWatchdog: a watchdog of the machine, through the kernel's watchdog interface
// (Documentation/watchdog/watchdog-api.rst of the kernel).
#pragma once

#include "hal/watchdog/interface/watchdog_feeding.hpp"
#include "linux_watchdog_driver.hpp"

namespace flexrf {

class LinuxWatchdog final : public WatchdogFeeding<LinuxWatchdogDriver> {
 public:
  /// Leaves it armed, unless stop() came before: whatever ends the process so is no orderly end.
  ~LinuxWatchdog() override;

  void stop() override;

 private:
  Status arm() override;
  bool feed(Time now) noexcept override;

  Status set_up(const char* path);
  Status set_timeout(const char* path);
  void set_pretimeout(const char* path);
  void let_go(bool disarm) noexcept;

  int descriptor_ = -1;
};

}  // namespace flexrf
