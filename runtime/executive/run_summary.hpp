// How a run went, for the report.
#pragma once

#include <cstdint>
#include <optional>

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/executive/control.hpp"

namespace flexrf {

struct RunSummary {
  EndCause cause = EndCause::none;
  int signal = 0;  ///< of EndCause::signal
  int exit_code = 0;
  Status start_failure;        ///< why nothing was started; ok when it was
  Status save_failure;         ///< why the configuration file does not hold what it should; ok when it does
  std::uint64_t writings = 0;  ///< of the configuration file
  bool had_fault = false;
  bool cut_short = false;  ///< finish_timeout or stop_timeout ended a phase
  bool stuck = false;      ///< a thread hangs: the process can only be left by _exit
  bool virtual_time = false;
  bool realtime = false;  ///< SCHED_FIFO and locked memory are in force
  Duration run_time{};    ///< simulated in virtual time
  Duration wall_time{};
  Duration start_time{};  ///< from main to the first step
  std::optional<std::uint64_t> digest;
};

}  // namespace flexrf
