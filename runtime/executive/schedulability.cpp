#include "runtime/executive/schedulability.hpp"

namespace flexrf {
namespace {

/// Least time between two releases.
Duration interval_of(const TriggerRecord& trigger) noexcept {
  if (trigger.kind == TriggerKind::period) return trigger.period;
  if (trigger.kind == TriggerKind::backoff) return trigger.shortest;
  return trigger.min_interval;
}

}  // namespace

std::vector<std::optional<ThreadEstimate>> estimate_response_times(const Application& application,
                                                                   const MachineFile& machine) {
  std::vector<std::optional<ThreadEstimate>> estimates(application.threads.size());
  std::vector<ResponseTimeTask> tasks;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    const ThreadRecord& thread = application.threads[i];
    const Duration interval = interval_of(thread.trigger);
    if (thread.priority == 0 || interval.count() <= 0) continue;
    const auto cpu = static_cast<std::uint16_t>(machine.cpus_of(thread.role).highest());
    const Duration deadline = thread.deadline.count() > 0 ? thread.deadline : interval;
    tasks.push_back({thread.name, cpu, thread.priority, thread.budget, interval, Duration{}, deadline});
    places.push_back(i);
  }
  std::vector<ResponseTimeResult> results(tasks.size());
  analyse_response_times(tasks, results);
  for (std::size_t i = 0; i < tasks.size(); ++i) estimates[places[i]] = ThreadEstimate{tasks[i], results[i]};
  return estimates;
}

}  // namespace flexrf
