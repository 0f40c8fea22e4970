// LinuxProcess: a program of this machine.
#pragma once

#include "hal/process/interface/hosted_process.hpp"
#include "hal/process/linux/linux_process_host.hpp"
#include "linux_process_driver.hpp"

namespace flexrf {

class LinuxProcess final : public HostedProcess<LinuxProcessDriver, LinuxProcessHost> {
 public:
  /// The process that starts programs for this one; for tests.
  pid_t helper() noexcept { return host().helper(); }
};

}  // namespace flexrf
