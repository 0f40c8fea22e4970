// LinuxProcess: a program of this machine.
#pragma once

#include "hal/interfaces/process/hosted_process.hpp"
#include "hal/linux/linux_process/linux_process_host.hpp"
#include "linux_process_driver.hpp"

namespace flexrf {

class LinuxProcess final : public HostedProcess<LinuxProcessDriver, LinuxProcessHost> {
 public:
  /// The process that starts programs for this one; for tests.
  pid_t helper() noexcept { return host().helper(); }
};

}  // namespace flexrf
