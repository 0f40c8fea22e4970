// What response times the declared budgets promise on this machine's CPUs.
#pragma once

#include <optional>
#include <vector>

#include "runtime/executive/application.hpp"
#include "runtime/realtime/machine_file.hpp"
#include "runtime/realtime/response_time.hpp"

namespace flexrf {

struct ThreadEstimate {
  ResponseTimeTask task;
  ResponseTimeResult result;
};

/// One per thread, in table order; none for threads that are not real-time or whose releases have no least
/// distance. An estimate: see response_time_label. Non-real-time threads; allocates.
std::vector<std::optional<ThreadEstimate>> estimate_response_times(const Application& application,
                                                                   const MachineFile& machine);

}  // namespace flexrf
