// Which CPUs of this machine the roles of the application's threads mean.
#pragma once

#include <string_view>

#include "base/cpu_role.hpp"
#include "runtime/realtime/cpu_set.hpp"

namespace flexrf {

/// Maps roles to CPUs. The machine's file has lines `control = 1`, `io = 0`, `any = 0-1`, `rest = 0`; `#`
/// starts a comment. A role that is not mentioned has its default. Non-real-time threads, at start.
///
/// Default: real time has the CPUs that the kernel isolates; with none isolated, the last of two CPUs, the
/// last two of more. `control` is the highest of them, `io` the lowest, `any` all; `rest` what no real-time
/// thread claims.
class MachineFile {
 public:
  static constexpr const char* default_path = "/etc/flexrf/machine.conf";

  /// What holds without a file. `allowed`: CPUs this process may use; `isolated`: CPUs the kernel isolates.
  static MachineFile by_default(const CpuSet& allowed, const CpuSet& isolated) noexcept;
  /// Reads a file over the defaults; errors name file and line. A file that is not there is not_found.
  static Result<MachineFile> read(const char* path, const CpuSet& allowed, const CpuSet& isolated);
  /// The machine's file where there is one, else the defaults, for this machine.
  static Result<MachineFile> of_this_machine(const char* path = default_path);

  /// CPUs of `control`, `io` and `any`, never empty. For `rest` see below.
  const CpuSet& cpus_of(CpuRole role) const noexcept;
  /// CPUs for everything that is not real-time: as the file says, else every allowed CPU outside `claimed`,
  /// or all when nothing would be left.
  CpuSet rest(const CpuSet& claimed) const noexcept;

  /// As read(), from text; `name` stands for the file in errors.
  static Result<MachineFile> parse(std::string_view text, const char* name, const CpuSet& allowed,
                                   const CpuSet& isolated);

 private:
  CpuSet allowed_;
  CpuSet control_;
  CpuSet io_;
  CpuSet any_;
  CpuSet rest_;  ///< empty: not said
};

/// CPUs that the kernel keeps free of other work (isolcpus); empty when none or not known.
CpuSet isolated_cpus(const char* path = "/sys/devices/system/cpu/isolated") noexcept;

}  // namespace flexrf
